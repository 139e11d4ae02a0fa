// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <umbilic/core/errors.h>
#include <umbilic/nurbs/trimming.h>

namespace umbilic {
namespace {

TrimmingCurve segment(Vector2 from, Vector2 to) {
    return {.curve = NurbsCurve2(KnotVector::bezier(1), {from, to})};
}

/// Full circle as four rational quadratic arcs.
TrimmingCurve circle(Vector2 centre, double radius) {
    const double w = std::numbers::sqrt2 / 2;
    std::vector<Vector2> poles;
    const std::array<std::array<int, 2>, 9> at = {
        {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}};
    std::vector<double> weights;
    for (std::size_t i = 0; i < at.size(); ++i) {
        poles.emplace_back(centre + radius * Vector2(at[i][0], at[i][1]));
        weights.push_back(i % 2 ? w : 1.0);
    }
    return {.curve = NurbsCurve2(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}), poles, weights)};
}

TrimmingLoop rectangle(Vector2 low, Vector2 high) {
    const Vector2 a = low, b(high.x(), low.y()), c = high, d(low.x(), high.y());
    return {segment(a, b), segment(b, c), segment(c, d), segment(d, a)};
}

constexpr ParameterBox unit_square{{0, 1}, {0, 1}};

TEST(TrimmingRegion, RectangleAroundTheDomainTrimsNothing) {
    const TrimmingRegion region(unit_square, {rectangle({0, 0}, {1, 1})}, {}, {});
    EXPECT_TRUE(region.whole_domain());
    EXPECT_EQ(region.classify(0.5, 0.5), Containment::inside);
    EXPECT_EQ(region.classify(1.0, 0.5), Containment::boundary);
    EXPECT_EQ(region.classify(1.1, 0.5), Containment::outside);
    EXPECT_EQ(region.classify(0.95, 0.5, 0.1), Containment::boundary);
}

TEST(TrimmingRegion, DiscWithAHole) {
    const TrimmingRegion region(unit_square, {{circle({0.5, 0.5}, 0.4)}, {circle({0.4, 0.5}, 0.1)}}, {}, {});
    EXPECT_FALSE(region.whole_domain());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 5000; ++i) {
        const Vector2 p(uniform(random), uniform(random));
        const double outer = (p - Vector2(0.5, 0.5)).norm() - 0.4, inner = (p - Vector2(0.4, 0.5)).norm() - 0.1;
        if (std::min(std::abs(outer), std::abs(inner)) < 2 * TrimmingRegion::polyline_deviation) continue;
        EXPECT_EQ(region.classify(p.x(), p.y()), outer < 0 && inner > 0 ? Containment::inside : Containment::outside);
    }
    EXPECT_EQ(region.classify(0.9, 0.5), Containment::boundary);
    EXPECT_EQ(region.classify(0.5, 0.5, 0.01), Containment::boundary);
    EXPECT_NEAR(region.box().u.low, 0.1, 1e-9);
    EXPECT_NEAR(region.box().v.high, 0.9, 1e-9);
}

TEST(TrimmingRegion, ReversedCurvesCloseALoop) {
    const Vector2 a(0.1, 0.1), b(0.9, 0.1), c(0.5, 0.9);
    TrimmingLoop loop = {segment(a, b), segment(c, b), segment(c, a)};
    loop[1].reversed = true;
    const TrimmingRegion region(unit_square, {loop}, {}, {});
    EXPECT_EQ(region.classify(0.5, 0.4), Containment::inside);
    EXPECT_EQ(region.classify(0.1, 0.8), Containment::outside);
}

TEST(TrimmingRegion, OpenLoopIsAnError) {
    const Vector2 a(0.1, 0.1), b(0.9, 0.1), c(0.5, 0.9);
    EXPECT_THROW(TrimmingRegion(unit_square, {{segment(a, b), segment(b, c)}}, {}, {}), InvalidInput);
    EXPECT_THROW(TrimmingRegion(unit_square, {{segment(a, b), segment(c, a)}}, {}, {}), InvalidInput);
}

TEST(ParameterMap, AngularMapIsTheAngleOnARationalCircle) {
    const double third = 2 * std::numbers::pi / 3;
    const ParameterMap map = ParameterMap::angular({0, third, 2 * third, 3 * third});
    for (double u = 0.0; u < 2 * std::numbers::pi; u += 0.1) {
        // Point of the rational quadratic arc of angle `third` at the local parameter of u.
        const int span = static_cast<int>(u / third);
        const double t = u / third - span, w = std::cos(third / 2);
        const auto corner = [&](double angle) { return Vector2(std::cos(angle), std::sin(angle)); };
        const Vector2 p0 = corner(span * third), p2 = corner((span + 1) * third);
        const Vector2 p1 = corner((span + 0.5) * third) / w;
        const Vector2 sum = (1 - t) * (1 - t) * p0 + 2 * t * (1 - t) * w * p1 + t * t * p2;
        double angle = std::atan2(sum.y(), sum.x());
        if (angle < 0) angle += 2 * std::numbers::pi;
        EXPECT_NEAR(map.native(u), angle, 1e-14);
        EXPECT_NEAR(map.surface(map.native(u)), u, 1e-14);
    }
    EXPECT_THROW(ParameterMap::angular({0, 3.2}), InvalidInput);
    EXPECT_THROW(ParameterMap::angular({0}), InvalidInput);
}

}  // namespace
}  // namespace umbilic
