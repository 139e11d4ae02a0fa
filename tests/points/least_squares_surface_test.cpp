// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/points/least_squares_surface.h>
#include <umbilic/points/multilevel_spline.h>

namespace umbilic {
namespace {

std::vector<double> even(int count) {
    std::vector<double> parameters;
    for (int i = 0; i < count; ++i) parameters.push_back(static_cast<double>(i) / (count - 1));
    return parameters;
}

PointGrid sampled(const NurbsSurface& surface, const std::vector<double>& u, const std::vector<double>& v) {
    PointGrid grid{static_cast<int>(u.size()), static_cast<int>(v.size()), {}};
    for (const double a : u)
        for (const double b : v) grid.points.push_back(surface.value(a, b));
    return grid;
}

double pole_error(const NurbsSurface& a, const NurbsSurface& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.poles().size(); ++i) worst = std::max(worst, (a.poles()[i] - b.poles()[i]).norm());
    return worst;
}

TEST(LeastSquaresSurface, ASampledSplineComesBackOnItsOwnKnots) {
    const NurbsSurface surface = support::smooth_bicubic(9, 7, 0.3);
    const std::vector<double> u = even(40), v = even(31);
    const PointGrid grid = sampled(surface, u, v);
    const NurbsSurface back = fit_grid(grid, u, v, surface.u_knots(), surface.v_knots());
    EXPECT_LT(pole_error(back, surface), 1e-10);

    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<ParametrisedPoint> scattered;
    for (int i = 0; i < 3000; ++i) {
        const double a = uniform(random), b = uniform(random);
        scattered.push_back({a, b, surface.value(a, b)});
    }
    EXPECT_LT(pole_error(fit_scattered(scattered, surface.u_knots(), surface.v_knots(), 0.0), surface), 1e-10);
}

TEST(LeastSquaresSurface, GridsWithFewerPointsThanPolesTakeTheLeastMotion) {
    const NurbsSurface surface = support::smooth_bicubic(12, 3, 0.2);
    const std::vector<double> few = even(6);
    const NurbsSurface fit = fit_grid(sampled(surface, few, few), few, few, surface.u_knots(), surface.v_knots());
    for (const double a : few)
        for (const double b : few) EXPECT_LT((fit.value(a, b) - surface.value(a, b)).norm(), 1e-10);
}

TEST(LeastSquaresSurface, ChordLengthsOfAnUnevenGrid) {
    const PointGrid grid{3, 2, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {4, 0, 0}, {4, 1, 0}}};
    EXPECT_EQ(chord_length_u(grid), (std::vector<double>{0.0, 0.25, 1.0}));
    EXPECT_EQ(chord_length_v(grid), (std::vector<double>{0.0, 1.0}));
    EXPECT_THROW(chord_length_u({2, 2, std::vector<Vector3>(4, Vector3::Zero())}), InvalidInput);
    EXPECT_THROW(chord_length_u({2, 3, std::vector<Vector3>(4, Vector3::Zero())}), InvalidInput);
    EXPECT_THROW(chord_length_u({1, 4, std::vector<Vector3>(4, Vector3::Zero())}), InvalidInput);
}

TEST(LeastSquaresSurface, EverySpanOfFittingKnotsHoldsParameters) {
    std::vector<double> parameters;
    for (int i = 0; i < 30; ++i) parameters.push_back(std::pow(i / 29.0, 3));
    const KnotVector knots = fitting_knots(3, 12, parameters);
    EXPECT_EQ(knots.pole_count(), 12);
    for (std::size_t b = 0; b + 1 < knots.breaks().size(); ++b) {
        int inside = 0;
        for (const double u : parameters) inside += knots.breaks()[b] <= u && u <= knots.breaks()[b + 1];
        EXPECT_GT(inside, 0);
    }
    EXPECT_THROW(fitting_knots(3, 3, parameters), InvalidInput);
    EXPECT_THROW(fitting_knots(3, 31, parameters), InvalidInput);
    EXPECT_THROW(uniform_knots(0, 5), InvalidInput);
}

TEST(LeastSquaresSurface, PlacesWithoutPointsAreCarriedOver) {
    std::vector<ParametrisedPoint> points;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    while (points.size() < 800) {
        const double u = uniform(random), v = uniform(random);
        if (std::hypot(u - 0.5, v - 0.5) < 0.3) continue;
        points.push_back({u, v, Vector3(u, v, 0.5 * u - v)});
    }
    const NurbsSurface plane = fit_scattered(points, uniform_knots(3, 15), uniform_knots(3, 15), 1e-9);
    EXPECT_LT((plane.value(0.5, 0.5) - Vector3(0.5, 0.5, -0.25)).norm(), 1e-6);
    EXPECT_THROW(fit_scattered(points, uniform_knots(3, 15), uniform_knots(3, 15), 0.0), NumericFailure);
    EXPECT_THROW(fit_scattered({}, uniform_knots(3, 5), uniform_knots(3, 5), 0.0), InvalidInput);
    points.front().u = 1.5;
    EXPECT_THROW(fit_scattered(points, uniform_knots(3, 5), uniform_knots(3, 5), 0.0), InvalidInput);
}

TEST(MultilevelSpline, EveryLevelComesCloserAndTheLastMeetsThePoints) {
    std::vector<ParametrisedPoint> points;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 150; ++i) {
        const double u = uniform(random), v = uniform(random);
        points.push_back({u, v, Vector3(u, v, std::sin(5 * u) * std::cos(4 * v))});
    }
    const MultilevelSpline spline = multilevel_spline(points, {.levels = 8});
    ASSERT_EQ(spline.rms.size(), 8u);
    for (std::size_t k = 1; k < spline.rms.size(); ++k) EXPECT_LT(spline.rms[k], spline.rms[k - 1]);
    EXPECT_LT(spline.maximum.back(), 1e-3);
    // The surface that is returned is the one that was measured.
    double worst = 0.0;
    for (const ParametrisedPoint& p : points)
        worst = std::max(worst, (spline.surface.value(p.u, p.v) - p.point).norm());
    EXPECT_NEAR(worst, spline.maximum.back(), 1e-12);
    EXPECT_EQ(multilevel_spline(points, {.levels = 12, .tolerance = 0.05}).maximum.back() <= 0.05, true);
    EXPECT_THROW(multilevel_spline({}), InvalidInput);
    EXPECT_THROW(multilevel_spline(points, {.levels = 0}), InvalidInput);
    EXPECT_THROW(multilevel_spline(points, {.u_start = 0}), InvalidInput);
}

}  // namespace
}  // namespace umbilic
