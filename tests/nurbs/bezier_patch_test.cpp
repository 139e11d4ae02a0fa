// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include <support/surfaces.h>
#include <umbilic/nurbs/bezier_patch.h>

namespace umbilic {
namespace {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>>;
using WideVector = std::array<Wide, 4>;

/// Polar form of the homogeneous surface in 60 digits by repeated de Boor steps: the reference for one Bezier
/// coefficient.
WideVector reference_pole(const NurbsSurface& surface, const BezierPatch& patch, int i, int j) {
    const auto blossom = [](const KnotVector& knots, int span, int high_count, std::vector<WideVector> points) {
        const int p = knots.degree();
        for (int level = 1; level <= p; ++level) {
            const double argument = level <= p - high_count ? knots.knots()[span] : knots.knots()[span + 1];
            for (int k = p; k >= level; --k) {
                const Wide low = knots.knots()[span - p + k], high = knots.knots()[span + 1 + k - level];
                const Wide alpha = (Wide(argument) - low) / (high - low);
                for (int c = 0; c < 4; ++c) points[k][c] = (1 - alpha) * points[k - 1][c] + alpha * points[k][c];
            }
        }
        return points[p];
    };
    const int u_span = surface.u_knots().span(patch.domain.u.middle());
    const int v_span = surface.v_knots().span(patch.domain.v.middle());
    std::vector<WideVector> column;
    for (int a = 0; a <= patch.u_degree; ++a) {
        std::vector<WideVector> row;
        for (int b = 0; b <= patch.v_degree; ++b) {
            const int pi = u_span - patch.u_degree + a, pj = v_span - patch.v_degree + b;
            const Wide w = surface.weight(pi, pj);
            WideVector point;
            for (int c = 0; c < 3; ++c) point[c] = w * (Wide(surface.pole(pi, pj)[c]) - Wide(patch.origin[c]));
            point[3] = w;
            row.push_back(point);
        }
        column.push_back(blossom(surface.v_knots(), v_span, j, row));
    }
    return blossom(surface.u_knots(), u_span, i, column);
}

TEST(BezierPatch, NoCoefficientLeavesItsErrorBound) {
    int checked = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        const int p = 1 + seed % 5, q = 1 + (seed / 5) % 4;
        NurbsSurface surface = support::random_surface(p, q, p + 4, q + 3, seed, 0.4, seed % 2 ? 100.0 : 1.0);
        SimilarityTransform far;
        far.translation = Vector3(1234.5, -2000.25, 777.125) * (seed % 3);
        surface = support::transformed(surface, far);
        for (const BezierPatch& patch : bezier_patches(surface).patches)
            for (int i = 0; i <= p; ++i)
                for (int j = 0; j <= q; ++j) {
                    const WideVector exact = reference_pole(surface, patch, i, j);
                    for (int c = 0; c < 3; ++c)
                        ASSERT_LE(abs(exact[c] - Wide(patch.pole(i, j)[c])), Wide(patch.position_error));
                    ASSERT_LE(abs(exact[3] - Wide(patch.pole(i, j)[3])), Wide(patch.weight_error));
                    ++checked;
                }
    }
    EXPECT_GT(checked, 5000);
}

TEST(BezierPatch, PatchesReproduceTheSurface) {
    // The knots of the thesis's example (6.2): an 8 x 8 bicubic splits into 25 patches.
    const NurbsSurface surface = support::smooth_bicubic(8, 7);
    const BezierPatches split = bezier_patches(surface);
    EXPECT_EQ(split.u_count, 5);
    EXPECT_EQ(split.v_count, 5);
    ASSERT_EQ(split.patches.size(), 25u);
    for (const BezierPatch& patch : split.patches)
        for (const double s : {0.0, 0.3, 1.0})
            for (const double t : {0.0, 0.6, 1.0}) {
                Vector4 sum = Vector4::Zero();
                for (int i = 0; i <= 3; ++i)
                    for (int j = 0; j <= 3; ++j) {
                        const auto b = [](int k, double x) {
                            return std::array{1.0, 3.0, 3.0, 1.0}[k] * std::pow(x, k) * std::pow(1 - x, 3 - k);
                        };
                        sum += b(i, s) * b(j, t) * patch.pole(i, j);
                    }
                const Vector3 point = patch.origin + sum.head<3>() / sum[3];
                const Vector3 expected = surface.value(patch.domain.u.low + s * patch.domain.u.length(),
                                                       patch.domain.v.low + t * patch.domain.v.length());
                EXPECT_LT((point - expected).norm(), 1e-14);
            }
}

TEST(BezierPatch, UnclampedKnotsAreSplitToo) {
    const KnotVector u(3, {-3, -2, -1, 0, 1, 2, 3, 4, 5}), v = KnotVector::bezier(1);
    std::vector<Vector3> poles;
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 2; ++j) poles.emplace_back(i, j, i * i - j);
    const NurbsSurface surface(u, v, poles);
    const BezierPatches split = bezier_patches(surface);
    ASSERT_EQ(split.u_count, 2);
    for (const BezierPatch& patch : split.patches) {
        const Vector3 corner = patch.origin + patch.pole(0, 0).head<3>();
        EXPECT_LT((corner - surface.value(patch.domain.u.low, patch.domain.v.low)).norm(), 1e-14);
    }
}

}  // namespace
}  // namespace umbilic
