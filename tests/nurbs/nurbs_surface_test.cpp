// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {
namespace {

std::vector<Vector3> flat_poles(int count) {
    return std::vector<Vector3>(count, Vector3::Zero());
}

TEST(NurbsSurface, SaysWhatIsWrong) {
    const KnotVector bilinear = KnotVector::bezier(1);
    EXPECT_THROW(NurbsSurface(bilinear, bilinear, flat_poles(3)), InvalidInput);
    EXPECT_THROW(NurbsSurface(bilinear, bilinear, flat_poles(4), {1, 1, 1}), InvalidInput);
    EXPECT_THROW(NurbsSurface(bilinear, bilinear, flat_poles(4), {1, 1, 0, 1}), InvalidInput);
    EXPECT_THROW(NurbsSurface(bilinear, bilinear, flat_poles(4), {1, 1, -2, 1}), InvalidInput);
    std::vector<Vector3> poles = flat_poles(4);
    poles[2].y() = std::numeric_limits<double>::infinity();
    EXPECT_THROW(NurbsSurface(bilinear, bilinear, poles), InvalidInput);
}

TEST(NurbsSurface, EqualWeightsArePolynomial) {
    const NurbsSurface plain = support::smooth_bicubic(6, 1);
    const NurbsSurface weighted(plain.u_knots(), plain.v_knots(), plain.poles(), std::vector<double>(36, 2.5));
    EXPECT_FALSE(weighted.rational());
}

TEST(NurbsSurface, GraphPatchReproducesItsPolynomial) {
    const auto f = [](double x, double y) { return 1 + x - 2 * y + x * x * y - 3 * x * y * y * y; };
    const NurbsSurface surface = support::graph_patch(3, 4, f);
    for (double u = 0.0; u <= 1.0; u += 0.125)
        for (double v = 0.0; v <= 1.0; v += 0.125) {
            const SurfaceDerivatives d = surface.derivatives(u, v, 4);
            const double x = 2 * u - 1, y = 2 * v - 1;
            EXPECT_NEAR(d.r().z(), f(x, y), 1e-13);
            EXPECT_NEAR(d.r_u().z(), 2 * (1 + 2 * x * y - 3 * y * y * y), 1e-12);
            EXPECT_NEAR(d(2, 1).z(), 8 * 2.0, 1e-11);
            EXPECT_NEAR(d(1, 3).z(), 16 * -18.0, 1e-10);
            EXPECT_NEAR(d(0, 4).z(), 0.0, 1e-10);
        }
}

TEST(NurbsSurface, EllipsoidOctantLiesOnTheEllipsoid) {
    const NurbsSurface surface = support::ellipsoid_octant(3, 2, 1);
    for (double u = 0.0; u <= 1.0; u += 0.1)
        for (double v = 0.0; v <= 1.0; v += 0.1) {
            const Vector3 p = surface.value(u, v);
            EXPECT_NEAR(p.x() * p.x() / 9 + p.y() * p.y() / 4 + p.z() * p.z(), 1.0, 1e-14);
        }
}

TEST(NurbsSurface, RationalDerivativesAgreeWithDifferences) {
    const NurbsSurface surface = support::random_surface(4, 3, 7, 6, 3, 0.3, 5.0);
    const double h = 1e-5;
    for (const auto& [u, v] : {std::pair{0.11, 0.47}, {0.5, 0.9}, {0.83, 0.21}}) {
        const SurfaceDerivatives d = surface.derivatives(u, v, 4);
        const SurfaceDerivatives u1 = surface.derivatives(u + h, v, 4), u0 = surface.derivatives(u - h, v, 4);
        const SurfaceDerivatives v1 = surface.derivatives(u, v + h, 4), v0 = surface.derivatives(u, v - h, 4);
        for (int k = 0; k <= 3; ++k)
            for (int l = 0; k + l <= 3; ++l) {
                EXPECT_LT(((u1(k, l) - u0(k, l)) / (2 * h) - d(k + 1, l)).norm(), 1e-6 * (1 + d(k + 1, l).norm()));
                EXPECT_LT(((v1(k, l) - v0(k, l)) / (2 * h) - d(k, l + 1)).norm(), 1e-6 * (1 + d(k, l + 1).norm()));
            }
    }
}

TEST(NurbsSurface, SidesOfAKnotDiffer) {
    // Quadratic with a simple knot: the second derivative jumps there, the first does not.
    const KnotVector u(2, {0, 0, 0, 0.5, 1, 1, 1}), v = KnotVector::bezier(1);
    std::vector<Vector3> poles;
    for (const double z : {0.0, 1.0, -1.0, 2.0})
        for (const double y : {0.0, 1.0}) poles.emplace_back(z * z, y, z);
    const NurbsSurface surface(u, v, poles);
    const SurfaceDerivatives left = surface.derivatives(0.5, 0.3, 2, Side::left);
    const SurfaceDerivatives right = surface.derivatives(0.5, 0.3, 2, Side::right);
    EXPECT_LT((left.r_u() - right.r_u()).norm(), 1e-13);
    EXPECT_GT((left.r_uu() - right.r_uu()).norm(), 1.0);
}

TEST(NurbsSurface, SwapAndReversalKeepThePoints) {
    const NurbsSurface surface = support::random_surface(3, 2, 6, 5, 9, 0.3, 3.0);
    for (double a = 0.05; a < 1; a += 0.2)
        for (double b = 0.05; b < 1; b += 0.2) {
            EXPECT_LT((surface.value(a, b) - surface.swapped().value(b, a)).norm(), 1e-14);
            EXPECT_LT((surface.value(a, b) - surface.u_reversed().value(1 - a, b)).norm(), 1e-14);
        }
}

TEST(NurbsSurface, EveryPairOfDegreesEvaluatesToItsPolynomialForm) {
    // Away from knots both sides are the same piece; low degrees take another way on the right side than on the left.
    for (int p = 1; p <= 7; ++p)
        for (int q = 1; q <= 7; ++q)
            for (const double weight_ratio : {1.0, 5.0}) {
                const NurbsSurface surface = support::random_surface(p, q, p + 3, q + 2, p + 10 * q, 0.3, weight_ratio);
                const SurfaceDerivatives right = surface.derivatives(0.41, 0.77, 2);
                const SurfaceDerivatives left = surface.derivatives(0.41, 0.77, 2, Side::left, Side::left);
                for (int n = 0; n <= 2; ++n)
                    for (int l = 0; l <= n; ++l)
                        EXPECT_LT((right(n - l, l) - left(n - l, l)).norm(), 1e-11 * (1 + left(n - l, l).norm()))
                            << p << ' ' << q << ' ' << n << ' ' << l;
            }
}

TEST(NurbsSurface, AffineInvariance) {
    const NurbsSurface surface = support::random_surface(3, 3, 8, 8, 2, 0.3, 4.0);
    const SimilarityTransform t = support::random_similarity(5, 2.5, true);
    const NurbsSurface moved = support::transformed(surface, t);
    for (double a = 0.0; a <= 1; a += 0.25)
        EXPECT_LT((moved.value(a, 1 - a) - t.apply(surface.value(a, 1 - a))).norm(), 1e-13);
}

TEST(NurbsSurface, BatchEqualsSingleEvaluation) {
    const NurbsSurface surface = support::smooth_bicubic(8, 4);
    const std::vector<Vector2> parameters = {{0.1, 0.2}, {0.5, 0.5}, {0.99, 0.01}, {0.0, 1.0}};
    std::vector<SurfaceDerivatives> batch(parameters.size());
    surface.derivatives(parameters, 3, batch);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const SurfaceDerivatives single = surface.derivatives(parameters[i].x(), parameters[i].y(), 3);
        for (int n = 0; n <= 3; ++n)
            for (int l = 0; l <= n; ++l) EXPECT_EQ(batch[i](n - l, l), single(n - l, l));
    }
}

}  // namespace
}  // namespace umbilic
