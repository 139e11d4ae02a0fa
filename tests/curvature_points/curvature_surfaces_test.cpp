// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/curvature_surfaces.h>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>

namespace umbilic {
namespace {

TEST(CurvatureSurfaces, ComeNearerWithMoreSamples) {
    const NurbsSurface surface = support::smooth_bicubic(8, 3);
    double before_gaussian = INFINITY, before_mean = INFINITY;
    for (const int samples : {20, 60, 180}) {
        const CurvatureSurfaces surfaces(surface, {.samples = samples});
        EXPECT_LT(surfaces.gaussian_error(), 0.5 * before_gaussian) << samples;
        EXPECT_LT(surfaces.mean_error(), 0.5 * before_mean) << samples;
        before_gaussian = surfaces.gaussian_error();
        before_mean = surfaces.mean_error();
    }
}

TEST(CurvatureSurfaces, FindTheProvedPointsWithinTheirRadius) {
    const NurbsSurface surface = support::smooth_bicubic(8, 3);
    const CurvatureSurfaces surfaces(surface);
    int sought = 0, found = 0;
    for (const auto& [u, v] : {std::pair(0.23, 0.41), std::pair(0.52, 0.68), std::pair(0.79, 0.33)}) {
        const Curvature there = curvature(surface, u, v);
        const CurvatureQuery query{there.gaussian(), there.mean()};
        const std::vector<CurvaturePosition> positions = surfaces.find(query);
        for (const CurvaturePoint& exact : find_curvature_points(surface, {&query, 1}).points) {
            ++sought;
            found += std::any_of(positions.begin(), positions.end(), [&](const CurvaturePosition& position) {
                // Slopes are those at the approximate place: twice the linear estimate.
                return position.opposite == exact.opposite &&
                       std::abs(position.u - exact.at.u) <= 2 * position.radius.x() + 1e-12 &&
                       std::abs(position.v - exact.at.v) <= 2 * position.radius.y() + 1e-12;
            });
        }
        // The seed itself is among them.
        EXPECT_TRUE(std::any_of(positions.begin(), positions.end(), [&](const CurvaturePosition& position) {
            return !position.opposite && std::hypot(position.u - u, position.v - v) < 0.01;
        }));
        for (const CurvaturePosition& position : positions) EXPECT_FALSE(position.certified);
    }
    EXPECT_GE(sought, 3);
    EXPECT_EQ(found, sought);
}

TEST(CurvatureSurfaces, ParametersAreThoseOfTheSurface) {
    // Domain [2, 5] x [-1, 7] instead of the unit square: the same points, the same parameters relative to it.
    const NurbsSurface unit = support::smooth_bicubic(7, 5);
    const auto stretched = [](const KnotVector& knots, double low, double high) {
        std::vector<double> values = knots.knots();
        for (double& value : values) value = low + (high - low) * value;
        return KnotVector(knots.degree(), values);
    };
    const NurbsSurface other(stretched(unit.u_knots(), 2, 5), stretched(unit.v_knots(), -1, 7), unit.poles());
    const Curvature there = curvature(unit, 0.4, 0.3);
    const CurvatureQuery query{there.gaussian(), there.mean()};
    const auto a = CurvatureSurfaces(unit).find(query), b = CurvatureSurfaces(other).find(query);
    ASSERT_EQ(a.size(), b.size());
    ASSERT_FALSE(a.empty());
    for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_NEAR(2 + 3 * a[k].u, b[k].u, 1e-6);
        EXPECT_NEAR(-1 + 8 * a[k].v, b[k].v, 1e-6);
    }
}

TEST(CurvatureSurfaces, BadInputIsRefused) {
    const NurbsSurface surface = support::table_3_1_patch();
    EXPECT_THROW(CurvatureSurfaces(surface, {.samples = 1}), InvalidInput);
    EXPECT_THROW(CurvatureSurfaces(surface, {.levels = 0}), InvalidInput);
    EXPECT_THROW(CurvatureSurfaces(surface, {.samples = 10, .levels = 3}).find({1.0, 1.0, 0.1, 0.1}), InvalidInput);
}

}  // namespace
}  // namespace umbilic
