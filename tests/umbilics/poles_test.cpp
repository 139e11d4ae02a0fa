// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <support/surfaces.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

/// Full surface of revolution about z of a rational profile (radius, z, weight) with the given knots: nine poles
/// around.
NurbsSurface revolved(const KnotVector& profile_knots, const std::vector<Vector3>& profile) {
    const double w = std::numbers::sqrt2 / 2;
    constexpr double square[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < 9; ++i)
        for (const Vector3& p : profile) {
            poles.emplace_back(square[i][0] * p.x(), square[i][1] * p.x(), p.y());
            weights.push_back(p.z() * (i % 2 ? w : 1.0));
        }
    return NurbsSurface(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}), profile_knots, poles, weights);
}

/// Ellipsoid about the origin with half axes a, b, c, poles at z = -c and c.
NurbsSurface ellipsoid(double a, double b, double c) {
    const double w = std::numbers::sqrt2 / 2;
    const NurbsSurface sphere =
        revolved(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 2}), {{0, -1, 1}, {1, -1, w}, {1, 0, 1}, {1, 1, w}, {0, 1, 1}});
    std::vector<Vector3> poles;
    for (const Vector3& pole : sphere.poles()) poles.emplace_back(a * pole.x(), b * pole.y(), c * pole.z());
    return NurbsSurface(sphere.u_knots(), sphere.v_knots(), poles, sphere.weights());
}

/// Graph z = f(x, y), f a polynomial of degree 3, over the square |x| + |y| <= size in polar parameters: a pole at the
/// origin, v = 0 (or v = 1 if `outward` is false), and the meridians' directions along a square. `sectors` of four.
NurbsSurface polar_graph(const std::function<double(double, double)>& f, double size, int sectors, bool outward) {
    constexpr double corner[5][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    Eigen::Matrix4d bernstein;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k)
            bernstein(i, k) = std::array{1, 3, 3, 1}[k] * std::pow(i / 3.0, k) * std::pow(1 - i / 3.0, 3 - k);
    std::vector<std::array<Vector3, 4>> rows;
    for (int sector = 0; sector < sectors; ++sector) {
        const auto place = [&](int i, int j) {
            const double t = i / 3.0, r = size * (outward ? j / 3.0 : 1 - j / 3.0);
            return Vector2(r * ((1 - t) * corner[sector][0] + t * corner[sector + 1][0]),
                           r * ((1 - t) * corner[sector][1] + t * corner[sector + 1][1]));
        };
        Eigen::Matrix4d values;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) values(i, j) = f(place(i, j).x(), place(i, j).y());
        const Eigen::Matrix4d heights = bernstein.inverse() * values * bernstein.inverse().transpose();
        for (int i = sector == 0 ? 0 : 1; i < 4; ++i) {
            std::array<Vector3, 4> row;
            for (int j = 0; j < 4; ++j) row[j] << place(i, j), heights(i, j);
            rows.push_back(row);
        }
    }
    // Exactly collapsed, whatever the interpolation's rounding.
    std::vector<Vector3> poles;
    for (auto& row : rows) {
        row[outward ? 0 : 3] = Vector3(0, 0, f(0, 0));
        poles.insert(poles.end(), row.begin(), row.end());
    }
    std::vector<double> knots = {0};
    for (int k = 0; k <= sectors; ++k) knots.insert(knots.end(), 3, k);
    knots.push_back(sectors);
    return NurbsSurface(KnotVector(3, knots), KnotVector::bezier(3), poles);
}

const Umbilic* pole_of(const FaceUmbilics& found, double v) {
    for (const Umbilic& umbilic : found.umbilics)
        if (umbilic.pole != PoleKind::none && umbilic.at.v == v) return &umbilic;
    return nullptr;
}

void expect_certified(const FaceUmbilics& found, double sum) {
    EXPECT_TRUE(found.undecided.empty());
    EXPECT_TRUE(found.lines.empty());
    EXPECT_TRUE(found.regions.empty());
    ASSERT_TRUE(found.certificate.complete) << found.certificate.why;
    EXPECT_TRUE(*found.certificate.complete) << found.certificate.why;
    EXPECT_EQ(found.certificate.index_sum, sum);
    EXPECT_EQ(found.certificate.boundary_winding, sum);
    EXPECT_FALSE(found.certificate.why.empty());
}

TEST(Poles, BothPolesOfASpheroidAreUmbilicsOfIndexOne) {
    // Principal curvatures at the pole of x^2/a^2 + y^2/a^2 + z^2/c^2 = 1: both c / a^2.
    const std::array<std::array<double, 2>, 3> axes = {{{2, 1}, {1, 3}, {5, 4}}};
    for (const auto& [a, c] : axes)
        for (const double scale : {1e-3, 1.0, 25.4}) {
            const SimilarityTransform move = support::random_similarity(7, scale, false, 10 * scale);
            const FaceUmbilics found = find_umbilics(support::transformed(ellipsoid(a, a, c), move));
            ASSERT_EQ(found.umbilics.size(), 2u);
            expect_certified(found, 2.0);
            for (const Umbilic& umbilic : found.umbilics) {
                EXPECT_EQ(umbilic.pole, PoleKind::inner);
                EXPECT_EQ(umbilic.index, 1.0);
                EXPECT_TRUE(umbilic.certified);
                EXPECT_EQ(umbilic.kind.type, UmbilicType::non_generic);
                EXPECT_NEAR(umbilic.kappa * scale, c / (a * a), 1e-9);
                const double side = umbilic.at.v == 0.0 ? -c : c;
                EXPECT_LT((umbilic.point - move.apply(Vector3(0, 0, side))).norm(), 1e-9 * scale);
                EXPECT_LE(umbilic.radius, 1e-10);
            }
        }
}

TEST(Poles, TriaxialEllipsoidHasFourLemonsAndNoUmbilicAtItsPoles) {
    // The umbilics lie in the plane of the longest and the shortest axis, which holds a seam (y = 0) or knots of the
    // circles: every one is listed once, whichever axis carries the poles.
    const std::array<std::array<double, 3>, 4> axes = {{{3, 2, 1}, {2, 3, 1}, {3, 1, 2}, {1, 2, 3}}};
    for (const auto& [a, b, c] : axes) {
        const FaceUmbilics found = find_umbilics(ellipsoid(a, b, c));
        EXPECT_EQ(found.umbilics.size(), 4u);
        expect_certified(found, 2.0);
        std::array<double, 3> sorted = {a, b, c};
        std::sort(sorted.begin(), sorted.end());
        for (const Umbilic& umbilic : found.umbilics) {
            EXPECT_EQ(umbilic.kind.type, UmbilicType::lemon);
            EXPECT_NEAR(umbilic.kappa, sorted[0] * sorted[2] / std::pow(sorted[1], 3), 1e-9);
            EXPECT_EQ(umbilic.pole, PoleKind::none);
        }
    }
}

TEST(Poles, UmbilicsOfAnEllipsoidBesideItsPole) {
    // Nearly a spheroid, a little longer in x: the pole is no umbilic, but there are two near it in the plane y = 0.
    const double b = 1.0, c = 0.7;
    for (const double longer : {1e-3, 1e-4, 5e-5, 2e-5, 1e-5}) {
        SCOPED_TRACE(longer);
        const double a = b + longer, base = a * a - c * c;
        const Vector3 expected(a * std::sqrt((a * a - b * b) / base), 0.0, c * std::sqrt((b * b - c * c) / base));
        const FaceUmbilics found = find_umbilics(support::ellipsoid_octant(a, b, c));
        EXPECT_TRUE(found.undecided.empty());
        ASSERT_EQ(found.umbilics.size(), 1u);
        EXPECT_EQ(found.umbilics[0].index, 0.5);
        EXPECT_LE(found.umbilics[0].radius, 1e-12);
        // The weights are rounded, too, and the nearer to a spheroid the more that moves the umbilic.
        EXPECT_LE((found.umbilics[0].point - expected).norm(), 1e-17 / longer + 1e-13);
    }
}

TEST(Poles, OctantHasItsPoleAtACorner) {
    const FaceUmbilics found = find_umbilics(support::ellipsoid_octant(2, 2, 1));
    expect_certified(found, 0.0);
    ASSERT_EQ(found.umbilics.size(), 1u);
    EXPECT_EQ(found.umbilics[0].pole, PoleKind::border);
    EXPECT_EQ(found.umbilics[0].containment, Containment::boundary);
    EXPECT_EQ(found.umbilics[0].index, 1.0);
    EXPECT_NEAR(found.umbilics[0].kappa, 0.25, 1e-12);
    EXPECT_LT((found.umbilics[0].point - Vector3(0, 0, 1)).norm(), 1e-12);
    expect_certified(find_umbilics(support::ellipsoid_octant(3, 2, 1)), 0.5);
}

TEST(Poles, GenericUmbilicAtAPoleHasItsTypeAndIndex) {
    struct Case {
        double a, b, c, d;
        UmbilicType type;
        double index;
    };
    // The cubics of omega = 0.8 (elliptic star), -0.8, -1.7 (monstar), 1.7 (lemon) with alpha = 1.
    const auto cubic = [](double omega, UmbilicType type, double index) {
        return Case{6 * omega + 2, 0, 2 * omega - 2, 0, type, index};
    };
    for (const Case& form : {cubic(0.8, UmbilicType::star, -0.5), cubic(-0.8, UmbilicType::star, -0.5),
                             cubic(-1.7, UmbilicType::monstar, 0.5), cubic(1.7, UmbilicType::lemon, 0.5),
                             Case{0.3, -1.1, 0.4, 0.7, UmbilicType::star, -0.5}})
        for (const bool outward : {true, false})
            for (const int sectors : {4, 1}) {
                const auto f = [&](double x, double y) {
                    return -0.35 * (x * x + y * y) +
                           (form.a * x * x * x + 3 * form.b * x * x * y + 3 * form.c * x * y * y + form.d * y * y * y) /
                               6;
                };
                const FaceUmbilics found = find_umbilics(polar_graph(f, 0.05, sectors, outward));
                const Umbilic* pole = pole_of(found, outward ? 0.0 : 1.0);
                ASSERT_NE(pole, nullptr);
                EXPECT_EQ(pole->kind.type, form.type);
                EXPECT_EQ(pole->index, form.index);
                EXPECT_EQ(pole->pole, sectors == 4 ? PoleKind::inner : PoleKind::border);
                // r_u x r_v points down where v runs outward.
                const double side = outward ? -1.0 : 1.0;
                EXPECT_NEAR(pole->kappa, side * 0.7, 1e-9);
                EXPECT_NEAR(std::sqrt(pole->cubic.squared_norm()),
                            std::sqrt(Cubic{form.a, form.b, form.c, form.d}.squared_norm()), 1e-7);
                ASSERT_TRUE(found.certificate.complete) << found.certificate.why;
                EXPECT_TRUE(*found.certificate.complete);
                EXPECT_EQ(found.certificate.index_sum, sectors == 4 ? form.index : 0.0);
            }
}

TEST(Poles, NonUmbilicPoleIsNoUmbilic) {
    const FaceUmbilics found = find_umbilics(
        polar_graph([](double x, double y) { return -0.5 * x * x - 0.7 * y * y + 0.1 * x * x * x; }, 0.1, 4, true));
    EXPECT_TRUE(found.umbilics.empty());
    expect_certified(found, 0.0);
}

TEST(Poles, VaseTipAndConeApex) {
    // The profile z = r^2 meets the axis at a right angle: a smooth tip, umbilic with both curvatures 2. A straight one
    // makes a cone's apex, no point of a smooth surface.
    const NurbsSurface vase =
        revolved(KnotVector::bezier(3), {{0, 0, 1}, {1.0 / 3, 0, 1}, {2.0 / 3, 1.0 / 3, 1}, {1, 1, 1}});
    const FaceUmbilics tip = find_umbilics(vase);
    ASSERT_EQ(tip.umbilics.size(), 1u);
    EXPECT_EQ(tip.umbilics[0].index, 1.0);
    EXPECT_NEAR(std::abs(tip.umbilics[0].kappa), 2.0, 1e-12);
    expect_certified(tip, 1.0);
    const FaceUmbilics apex = find_umbilics(revolved(KnotVector::bezier(1), {{0, 0, 1}, {1, 2, 1}}));
    EXPECT_TRUE(apex.umbilics.empty());
    expect_certified(apex, 0.0);
}

TEST(Poles, SphereStaysARegion) {
    const FaceUmbilics found = find_umbilics(ellipsoid(2, 2, 2));
    EXPECT_TRUE(found.umbilics.empty());
    EXPECT_TRUE(found.undecided.empty());
    ASSERT_EQ(found.regions.size(), 1u);
    EXPECT_EQ(found.regions[0].kind, UmbilicRegionKind::spherical);
    EXPECT_NEAR(found.regions[0].area, 16 * std::numbers::pi, 1e-5);
}

}  // namespace
}  // namespace umbilic
