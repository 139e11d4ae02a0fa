// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <support/surfaces.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/differential/monge_form.h>

namespace umbilic {
namespace {

TEST(FundamentalForms, TorusClosedForm) {
    const double R = 3.0, r = 1.0;
    const NurbsSurface torus = support::torus_quarter(R, r);
    for (double u = 0.1; u < 1.0; u += 0.2)
        for (double v = 0.1; v < 1.0; v += 0.2) {
            const Curvature c = curvature(torus, u, v);
            const double rho = std::hypot(c.point.x(), c.point.y());
            const double cosine = (rho - R) / r;
            const double outward = c.normal.dot(c.point - R * Vector3(c.point.x() / rho, c.point.y() / rho, 0));
            ASSERT_NEAR(std::abs(outward), r, 1e-12);
            const double sign = outward > 0 ? 1 : -1;
            EXPECT_NEAR(c.gaussian(), cosine / (r * (R + r * cosine)), 1e-12);
            // Thesis sign: positive on the outside of a sphere or tube whose normal points outward.
            const double tube = sign / r, around = sign * cosine / (R + r * cosine);
            EXPECT_NEAR(c.kappa_max, std::max(tube, around), 1e-12);
            EXPECT_NEAR(c.kappa_min, std::min(tube, around), 1e-12);
        }
}

TEST(Curvature, SphereIsPositiveOutside) {
    const NurbsSurface sphere = support::ellipsoid_octant(2, 2, 2);
    const Curvature c = curvature(sphere, 0.3, 0.4);
    const double sign = c.normal.dot(c.point) > 0 ? 1.0 : -1.0;
    EXPECT_NEAR(c.kappa_max, sign * 0.5, 1e-12);
    EXPECT_NEAR(c.kappa_min, sign * 0.5, 1e-12);
}

TEST(Curvature, EulersFormulaHoldsInEveryDirection) {
    const NurbsSurface surface = support::random_surface(4, 3, 7, 6, 11, 0.4, 4.0);
    for (const auto& [u, v] : {std::pair{0.2, 0.3}, {0.55, 0.71}, {0.9, 0.15}}) {
        const SurfaceDerivatives d = surface.derivatives(u, v, 2);
        const Curvature c = curvature(d);
        EXPECT_NEAR(c.direction_max.dot(c.direction_min), 0.0, 1e-14);
        EXPECT_NEAR((c.direction_max.cross(c.direction_min) - c.normal).norm(), 0.0, 1e-14);
        EXPECT_GE(c.kappa_max, c.kappa_min);
        for (double angle = 0.0; angle < 3.1; angle += 0.3) {
            const double du = std::cos(angle), dv = std::sin(angle);
            const Vector3 tangent = (du * d.r_u() + dv * d.r_v()).normalized();
            const double co = tangent.dot(c.direction_max);
            const double euler = c.kappa_max * co * co + c.kappa_min * (1 - co * co);
            EXPECT_NEAR(normal_curvature(d, du, dv), euler, 1e-9 * (1 + std::abs(euler)));
        }
    }
}

TEST(Curvature, FollowsRigidMotionScaleAndSwap) {
    const NurbsSurface surface = support::random_surface(3, 3, 6, 6, 5, 0.3, 2.0);
    const SimilarityTransform t = support::random_similarity(3, 4.0, false);
    const Curvature before = curvature(surface, 0.37, 0.61);
    const Curvature after = curvature(support::transformed(surface, t), 0.37, 0.61);
    EXPECT_NEAR(after.kappa_max, before.kappa_max / 4, 1e-10 * std::abs(before.kappa_max));
    EXPECT_NEAR(std::abs(after.direction_max.dot(t.apply_direction(before.direction_max))), 1.0, 1e-12);
    const Curvature swapped = curvature(surface.swapped(), 0.61, 0.37);
    EXPECT_NEAR(swapped.kappa_max, -before.kappa_min, 1e-10 * std::abs(before.kappa_min));
    const Curvature back = flipped(swapped);
    EXPECT_NEAR(back.kappa_max, before.kappa_max, 1e-10 * std::abs(before.kappa_max));
    EXPECT_NEAR(std::abs(back.direction_max.dot(before.direction_max)), 1.0, 1e-12);
    EXPECT_LT((back.direction_max.cross(back.direction_min) - back.normal).norm(), 1e-12);
}

TEST(Curvature, CollapsedEdgeIsSingular) {
    EXPECT_FALSE(curvature(support::ellipsoid_octant(3, 2, 1), 0.4, 1.0).regular);
    EXPECT_TRUE(curvature(support::ellipsoid_octant(3, 2, 1), 0.4, 0.99).regular);
}

/// An oblique parametrisation, where the two printed signs of (2.15) would show: r_ij - gamma^k r_k must be normal to
/// the surface.
TEST(FundamentalForms, ChristoffelSymbolsLeaveTheNormalPart) {
    const NurbsSurface surface = support::random_surface(3, 4, 6, 6, 21, 0.5, 3.0);
    for (const auto& [u, v] : {std::pair{0.3, 0.3}, {0.62, 0.81}}) {
        const SurfaceDerivatives d = surface.derivatives(u, v, 2);
        const Christoffel g = christoffel(d);
        const auto [L, M, N] = second_form(d);
        const Vector3 n = unit_normal(d);
        ASSERT_GT(std::abs(first_form(d).F), 1e-3);
        EXPECT_LT((d.r_uu() - g.u_uu * d.r_u() - g.v_uu * d.r_v() - L * n).norm(), 1e-11 * d.r_uu().norm());
        EXPECT_LT((d.r_uv() - g.u_uv * d.r_u() - g.v_uv * d.r_v() - M * n).norm(), 1e-11 * d.r_uu().norm());
        EXPECT_LT((d.r_vv() - g.u_vv * d.r_u() - g.v_vv * d.r_v() - N * n).norm(), 1e-11 * d.r_vv().norm());
    }
}

TEST(FundamentalForms, ChristoffelSymbolsAgreeWithTheMetricsDerivatives) {
    const NurbsSurface surface = support::random_surface(3, 4, 6, 6, 22, 0.5, 3.0);
    const double u = 0.41, v = 0.33, h = 1e-6;
    const FirstForm I = first_form(surface.derivatives(u, v, 1));
    const FirstForm u1 = first_form(surface.derivatives(u + h, v, 1)),
                    u0 = first_form(surface.derivatives(u - h, v, 1));
    const FirstForm v1 = first_form(surface.derivatives(u, v + h, 1)),
                    v0 = first_form(surface.derivatives(u, v - h, 1));
    const double E_u = (u1.E - u0.E) / (2 * h), F_u = (u1.F - u0.F) / (2 * h), E_v = (v1.E - v0.E) / (2 * h);
    const double G_u = (u1.G - u0.G) / (2 * h), G_v = (v1.G - v0.G) / (2 * h), F_v = (v1.F - v0.F) / (2 * h);
    const double D = I.determinant();
    const Christoffel g = christoffel(surface.derivatives(u, v, 2));
    EXPECT_NEAR(g.v_uu, (2 * I.E * F_u - I.E * E_v - I.F * E_u) / (2 * D), 1e-6 * (1 + std::abs(g.v_uu)));
    EXPECT_NEAR(g.u_vv, (2 * I.G * F_v - I.G * G_u - I.F * G_v) / (2 * D), 1e-6 * (1 + std::abs(g.u_vv)));
}

TEST(MongeForm, RecoversTheCubicOfAGraph) {
    const MongeForm m = monge_form(support::monge_patch(0.7, 1.5, -2.0, 0.25, 3.0).derivatives(0.5, 0.5, 3));
    EXPECT_NEAR(m.cubic.a, 1.5, 1e-11);
    EXPECT_NEAR(m.cubic.b, -2.0, 1e-11);
    EXPECT_NEAR(m.cubic.c, 0.25, 1e-11);
    EXPECT_NEAR(m.cubic.d, 3.0, 1e-11);
}

/// Principal curvatures' derivatives along the surface, in the thesis's sign, are minus the cubic in the principal
/// frame.
TEST(MongeForm, IsTheDerivativeOfTheSecondForm) {
    const NurbsSurface surface = support::random_surface(5, 4, 7, 7, 8, 0.4, 2.0);
    const double u = 0.44, v = 0.58, h = 1e-5;
    const SurfaceDerivatives d = surface.derivatives(u, v, 3);
    const Curvature c = curvature(d);
    const MongeForm m = monge_form(d);
    const double angle = std::atan2(c.direction_max.dot(m.y), c.direction_max.dot(m.x));
    const Cubic principal = m.cubic.rotated(angle);
    // Parameter step that moves by h along direction_max.
    const FirstForm I = first_form(d);
    const double a = c.direction_max.dot(d.r_u()), b = c.direction_max.dot(d.r_v());
    const double du = (I.G * a - I.F * b) / I.determinant(), dv = (I.E * b - I.F * a) / I.determinant();
    const Curvature ahead = curvature(surface, u + h * du, v + h * dv),
                    behind = curvature(surface, u - h * du, v - h * dv);
    const double scale = std::abs(principal.a) + std::abs(principal.c) + 1;
    EXPECT_NEAR(-(ahead.kappa_max - behind.kappa_max) / (2 * h), principal.a, 1e-5 * scale);
    EXPECT_NEAR(-(ahead.kappa_min - behind.kappa_min) / (2 * h), principal.c, 1e-5 * scale);
}

TEST(Cubic, RotationKeepsTheNormAndComposes) {
    const Cubic cubic{1.0, -0.5, 2.0, 0.7};
    const Cubic once = cubic.rotated(0.4), back = once.rotated(-0.4);
    EXPECT_NEAR(once.squared_norm(), cubic.squared_norm(), 1e-13);
    EXPECT_NEAR(back.a, cubic.a, 1e-14);
    EXPECT_NEAR(back.d, cubic.d, 1e-14);
    EXPECT_NEAR(cubic.rotated(M_PI).a, -cubic.a, 1e-14);
}

}  // namespace
}  // namespace umbilic
