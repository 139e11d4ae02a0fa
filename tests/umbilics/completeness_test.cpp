// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <support/surfaces.h>
#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

/// The traceless part of the shape operator in the frame r_u / |r_u|, n x r_u / |r_u|: both components vanish at
/// umbilics. Another formulation than the polynomials of the search.
Vector2 traceless_shape(const NurbsSurface& surface, double u, double v) {
    const SurfaceDerivatives d = surface.derivatives(u, v, 2);
    const Vector3 x = d.r_u().normalized();
    const Vector3 n = unit_normal(d);
    const Vector3 y = n.cross(x);
    // Tangent vectors x = s r_u, y = p r_u + q r_v.
    const double s = 1.0 / d.r_u().norm(), q = 1.0 / d.r_v().dot(y), p = -d.r_v().dot(x) * q * s;
    const double L = n.dot(d.r_uu()), M = n.dot(d.r_uv()), N = n.dot(d.r_vv());
    const double xx = s * s * L, xy = s * (p * L + q * M), yy = p * p * L + 2 * p * q * M + q * q * N;
    return {0.5 * (xx - yy), xy};
}

/// Newton's method with difference quotients from every local minimum of |traceless_shape| on a grid.
std::vector<Vector2> dense_search(const NurbsSurface& surface, int grid) {
    const ParameterBox domain = surface.domain();
    std::vector<double> size((grid + 1) * (grid + 1));
    const auto place = [&](int i, int j) {
        // Off the knots by an irrational-looking share of a step.
        return Vector2(domain.u.low + (i + 0.37) / (grid + 1) * domain.u.length(),
                       domain.v.low + (j + 0.41) / (grid + 1) * domain.v.length());
    };
    for (int i = 0; i <= grid; ++i)
        for (int j = 0; j <= grid; ++j) {
            const Vector2 at = place(i, j);
            size[i * (grid + 1) + j] = traceless_shape(surface, at.x(), at.y()).norm();
        }
    std::vector<Vector2> result;
    for (int i = 0; i <= grid; ++i)
        for (int j = 0; j <= grid; ++j) {
            bool least = true;
            for (int a = std::max(0, i - 1); a <= std::min(grid, i + 1); ++a)
                for (int b = std::max(0, j - 1); b <= std::min(grid, j + 1); ++b)
                    least = least && size[i * (grid + 1) + j] <= size[a * (grid + 1) + b];
            if (!least) continue;
            Vector2 at = place(i, j);
            bool converged = false;
            for (int step = 0; step < 40 && !converged; ++step) {
                const double h = 1e-7;
                const Vector2 f = traceless_shape(surface, at.x(), at.y());
                Matrix2 jacobian;
                jacobian.col(0) = (traceless_shape(surface, at.x() + h, at.y()) - f) / h;
                jacobian.col(1) = (traceless_shape(surface, at.x(), at.y() + h) - f) / h;
                Vector2 change = -jacobian.fullPivLu().solve(f);
                const double longest = 2.0 / grid;
                if (change.norm() > longest) change *= longest / change.norm();
                at += change;
                if (!domain.contains(at.x(), at.y())) break;
                converged = change.norm() < 1e-12;
            }
            if (!converged) continue;
            const bool known = std::any_of(result.begin(), result.end(),
                                           [&](const Vector2& other) { return (other - at).norm() < 1e-7; });
            if (!known) result.push_back(at);
        }
    return result;
}

void expect_complete(const NurbsSurface& surface) {
    const FaceUmbilics found = find_umbilics(surface);
    EXPECT_TRUE(found.undecided.empty());
    EXPECT_TRUE(found.lines.empty());
    EXPECT_TRUE(found.regions.empty());
    ASSERT_TRUE(found.certificate.complete) << found.certificate.why;
    EXPECT_TRUE(*found.certificate.complete);
    EXPECT_EQ(found.certificate.index_sum, found.certificate.boundary_winding);
    for (const Vector2& at : dense_search(surface, 80)) {
        const bool listed = std::any_of(found.umbilics.begin(), found.umbilics.end(), [&](const Umbilic& umbilic) {
            return std::abs(umbilic.at.u - at.x()) < 1e-8 && std::abs(umbilic.at.v - at.y()) < 1e-8;
        });
        EXPECT_TRUE(listed) << "missed the umbilic at " << at.transpose();
    }
    for (const Umbilic& umbilic : found.umbilics) {
        EXPECT_TRUE(umbilic.certified);
        EXPECT_LE(umbilic.radius, 1e-10);
        // The second formulation vanishes there to rounding, beside its own change over the radius and 1e-9 of the
        // domain.
        const double change = (std::sqrt(umbilic.cubic.squared_norm()) + std::abs(umbilic.kappa)) * 1e-8;
        EXPECT_LE(traceless_shape(surface, umbilic.at.u, umbilic.at.v).norm(), change);
        EXPECT_TRUE(umbilic.box.contains(umbilic.at.u, umbilic.at.v));
        EXPECT_EQ(umbilic.index, umbilic.kind.delta > 0.0 ? -0.5 : 0.5);
    }
}

TEST(Completeness, SmoothBicubics) {
    for (unsigned seed = 0; seed < 6; ++seed) expect_complete(support::smooth_bicubic(8, seed));
}

TEST(Completeness, RoughBicubics) {
    for (unsigned seed = 0; seed < 6; ++seed) expect_complete(support::rough_bicubic(8, seed));
}

TEST(Completeness, RationalBicubics) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        expect_complete(support::random_surface(3, 3, 6, 6, seed, 0.1, 3.0));
        expect_complete(support::random_surface(3, 4, 4, 6, seed, 0.1, 10.0));
    }
}

TEST(Completeness, BiquadraticsArePiecewise) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        expect_complete(support::random_surface(2, 2, 6, 6, seed, 0.1));
        expect_complete(support::random_surface(2, 2, 5, 5, seed, 0.1, 3.0));
    }
}

TEST(Completeness, HigherDegrees) {
    for (unsigned seed = 0; seed < 2; ++seed) {
        expect_complete(support::random_surface(5, 5, 7, 7, seed, 0.1));
        expect_complete(support::random_surface(4, 2, 6, 5, seed, 0.1));
    }
}

TEST(Completeness, FarFromTheOriginTheSamePoints) {
    // Multiples of 2^-30 stay exact when 2^11 is added: the surface is exactly the same, only elsewhere.
    const NurbsSurface near = support::rough_bicubic(8, 3);
    std::vector<Vector3> rounded, moved;
    for (const Vector3& pole : near.poles()) {
        rounded.push_back((pole * 0x1p30).array().round() * 0x1p-30);
        moved.push_back(rounded.back() + Vector3(2048, -2048, 2048));
    }
    const FaceUmbilics here = find_umbilics(NurbsSurface(near.u_knots(), near.v_knots(), rounded));
    const FaceUmbilics there = find_umbilics(NurbsSurface(near.u_knots(), near.v_knots(), moved));
    ASSERT_FALSE(here.umbilics.empty());
    ASSERT_EQ(here.umbilics.size(), there.umbilics.size());
    for (std::size_t k = 0; k < here.umbilics.size(); ++k) {
        EXPECT_NEAR(here.umbilics[k].at.u, there.umbilics[k].at.u, here.umbilics[k].radius + there.umbilics[k].radius);
        EXPECT_NEAR(here.umbilics[k].at.v, there.umbilics[k].at.v, here.umbilics[k].radius + there.umbilics[k].radius);
        EXPECT_LE(there.umbilics[k].radius, 1e-9);
    }
}

}  // namespace
}  // namespace umbilic
