// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <support/surfaces.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

/// Umbilics of x^2/a^2 + y^2/b^2 + z^2/c^2 = 1, a > b > c: y = 0, x^2 = a^2 (a^2 - b^2) / (a^2 - c^2), curvature
/// a c / b^3, all lemons with alpha = 0 (Ko's thesis leaves alpha = 0 out).
void expect_lemon_of(double a, double b, double c, const NurbsSurface& octant, const SimilarityTransform& back,
                     double largest_radius = 1e-10) {
    const FaceUmbilics found = find_umbilics(octant);
    ASSERT_EQ(found.umbilics.size(), 1u);
    EXPECT_TRUE(found.undecided.empty());
    EXPECT_TRUE(found.lines.empty());
    const Umbilic& umbilic = found.umbilics[0];
    const Vector3 wanted(a * std::sqrt((a * a - b * b) / (a * a - c * c)), 0.0,
                         c * std::sqrt((b * b - c * c) / (a * a - c * c)));
    EXPECT_NEAR((back.apply(umbilic.point) - wanted).norm(), 0.0, 1e-10 * a);
    EXPECT_NEAR(umbilic.kappa / back.scale, a * c / (b * b * b), 1e-10);
    EXPECT_EQ(umbilic.kind.type, UmbilicType::lemon);
    EXPECT_EQ(umbilic.index, 0.5);
    EXPECT_TRUE(umbilic.certified);
    EXPECT_LE(umbilic.radius, largest_radius);
    EXPECT_FALSE(umbilic.kind.omega);
    EXPECT_NEAR(umbilic.kind.delta, -1.0, 1e-12);
    EXPECT_NEAR(std::abs(umbilic.kind.alpha) / std::abs(umbilic.kind.beta), 0.0, 1e-8);
    EXPECT_EQ(umbilic.directions.size(), 1u);
}

TEST(Ellipsoid, OneLemonOnTheOctantsEdge) {
    expect_lemon_of(3, 2, 1, support::ellipsoid_octant(3, 2, 1), {});
    expect_lemon_of(1.2, 1.1, 1.0, support::ellipsoid_octant(1.2, 1.1, 1.0), {});
    // A disc of ten to one: its curvatures hardly differ around the umbilic, and rounding weighs more.
    expect_lemon_of(10, 9, 1, support::ellipsoid_octant(10, 9, 1), {}, 1e-9);
}

TEST(Ellipsoid, CubicOfTheGraph) {
    const FaceUmbilics found = find_umbilics(support::ellipsoid_octant(3, 2, 1));
    ASSERT_EQ(found.umbilics.size(), 1u);
    const Umbilic& umbilic = found.umbilics[0];
    EXPECT_NEAR(umbilic.point.x(), 2.371708, 5e-7);
    EXPECT_NEAR(umbilic.point.z(), 0.612372, 5e-7);
    EXPECT_NEAR(umbilic.kappa, 0.375, 1e-12);
    // (a, b, c, d) = (-0.544638, 0, -0.181546, 0) up to the frame: the norm and the ratio do not depend on it.
    EXPECT_NEAR(std::sqrt(umbilic.cubic.squared_norm()), std::hypot(0.544638, std::sqrt(3.0) * 0.181546), 1e-6);
    EXPECT_NEAR(std::abs(umbilic.kind.beta), (0.544638 + 0.181546) / 8, 1e-6);
}

TEST(Ellipsoid, MovedAndScaled) {
    for (const double scale : {0.1, 25.4}) {
        const SimilarityTransform t = support::random_similarity(8, scale, false);
        expect_lemon_of(3, 2, 1, support::transformed(support::ellipsoid_octant(3, 2, 1), t), t.inverse());
    }
}

}  // namespace
}  // namespace umbilic
