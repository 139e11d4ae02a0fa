// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/foot_point.h>

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {
namespace {

TEST(FootPoint, IsTheRadialOneOnASphere) {
    const NurbsSurface sphere = support::full_sphere(2.0);
    for (const double distance : {0.5, 1.9, 2.0, 5.0}) {
        const Vector3 direction = sphere.value(0.7, 1.2).normalized();
        const std::optional<Vector2> foot = foot_point(sphere, distance * direction, {0.75, 1.1});
        ASSERT_TRUE(foot.has_value());
        EXPECT_LE((sphere.value(foot->x(), foot->y()) - 2 * direction).norm(), 1e-12);
    }
    // The foot beyond the border of a patch is none of the patch.
    EXPECT_FALSE(foot_point(support::smooth_bicubic(4, 1), Vector3(3, 3, 0), {0.9, 0.9}).has_value());
    EXPECT_THROW(foot_point(sphere, Vector3(std::nan(""), 0, 0), {0.5, 0.5}), InvalidInput);
}

TEST(FootPoint, AllFeetAreFound) {
    const Model torus = support::model_of({support::full_torus(3.0, 1.0)});
    // A point in the plane y = x has its feet on both circles that the plane cuts out: two on each.
    const Vector3 point(2.5, 2.5, 0.4);
    const std::vector<StationaryPoint> all = feet(torus.faces[0], point);
    ASSERT_EQ(all.size(), 4u);
    const double r = std::hypot(2.5, 2.5);
    const double near = std::hypot(r - 3, 0.4), far = std::hypot(r + 3, 0.4);
    EXPECT_NEAR(all[0].distance, std::abs(near - 1), 1e-9);
    EXPECT_NEAR(all[1].distance, near + 1, 1e-9);
    EXPECT_NEAR(all[2].distance, far - 1, 1e-9);
    EXPECT_NEAR(all[3].distance, far + 1, 1e-9);
}

TEST(FootPoint, MovesAtTheRatesOfTheDifferenceOfTwoFeet) {
    const NurbsSurface surface = support::smooth_bicubic(7, 3);
    const Vector2 at(0.4, 0.55);
    const SurfaceDerivatives d = surface.derivatives(at.x(), at.y(), 2);
    constexpr double h = 1e-5;
    for (const double height : {-0.05, 0.0, 0.08}) {
        const Vector3 point = d.r() + height * unit_normal(d);
        const double sign = evolute_margin(d, point) > 0.0 ? 1.0 : -1.0;
        for (const Vector3& velocity : {Vector3(1, 0, 0), Vector3(0.3, -0.8, 0.2), Vector3(0, 0, 1)}) {
            const std::optional<Vector2> rate = foot_rates(d, point, velocity, sign);
            ASSERT_TRUE(rate.has_value());
            const auto before = foot_point(surface, point - h * velocity, at);
            const auto after = foot_point(surface, point + h * velocity, at);
            ASSERT_TRUE(before && after);
            EXPECT_LT((*rate - (*after - *before) / (2 * h)).norm(), 1e-7);
            EXPECT_FALSE(foot_rates(d, point, velocity, -sign).has_value());
        }
    }
}

TEST(FootPoint, HasNoRatesAtTheEvolute) {
    // All of a sphere's normals meet in its centre; at the share t of the radius the margin is t^2.
    const NurbsSurface sphere = support::full_sphere(2.0);
    const SurfaceDerivatives d = sphere.derivatives(0.7, 1.2, 2);
    for (const double share : {0.0, 0.25, 0.5, 1.5})
        EXPECT_NEAR(evolute_margin(d, share * d.r()), share * share, 1e-12);
    EXPECT_TRUE(foot_rates(d, 0.5 * d.r(), Vector3::UnitX(), 1.0).has_value());
    EXPECT_FALSE(foot_rates(d, Vector3::Zero(), Vector3::UnitX(), 1.0).has_value());
}

}  // namespace
}  // namespace umbilic
