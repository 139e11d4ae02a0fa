// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <support/random_faces.h>
#include <support/surfaces.h>
#include <umbilic/curvature_points/curvature_gradient.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {
namespace {

TEST(CurvatureGradient, AgreesWithDifferenceQuotients) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const NurbsSurface surface = support::random_surface(4, 5, 6, 7, seed, 0.3, seed % 2 ? 1.0 : 2.0);
        const double u = 0.31, v = 0.57, step = 1e-6;
        const SurfaceDerivatives d = surface.derivatives(u, v, 3);
        const CurvatureGradient gradient = curvature_gradient(d);
        const Curvature here = curvature(surface, u, v);
        EXPECT_NEAR(gradient.gaussian, here.gaussian(), 1e-10 * (1 + std::abs(here.gaussian())));
        EXPECT_NEAR(gradient.mean, here.mean(), 1e-10 * (1 + std::abs(here.mean())));
        const Vector3 x = d.r_u().normalized(), y = unit_normal(d).cross(x);
        for (const Vector2& along : {Vector2(1, 0), Vector2(0, 1)}) {
            const Curvature ahead = curvature(surface, u + step * along.x(), v + step * along.y());
            const Curvature behind = curvature(surface, u - step * along.x(), v - step * along.y());
            const Vector3 tangent = along.x() * d.r_u() + along.y() * d.r_v();
            const Vector2 in_frame(tangent.dot(x), tangent.dot(y));
            const double gaussian = (ahead.gaussian() - behind.gaussian()) / (2 * step);
            const double mean = (ahead.mean() - behind.mean()) / (2 * step);
            EXPECT_NEAR(gradient.gaussian_slope.dot(in_frame), gaussian, 1e-5 * (1 + std::abs(gaussian))) << seed;
            EXPECT_NEAR(gradient.mean_slope.dot(in_frame), mean, 1e-5 * (1 + std::abs(mean))) << seed;
        }
    }
}

}  // namespace
}  // namespace umbilic
