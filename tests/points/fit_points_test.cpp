// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <support/clouds.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/curves/closest_point.h>
#include <umbilic/points/fit_points.h>

namespace umbilic {
namespace {

double waves(double x, double y) {
    return 0.15 * std::sin(2.5 * x) * std::cos(2 * y) + 0.1 * x * y;
}

TEST(FitPoints, ReachesTheNoiseAndComesCloserToTheTruthThanIt) {
    const double noise = 2e-3;
    const PointCloud cloud = support::graph_cloud(4000, waves, noise, 1);
    const FitResult fit = fit_points(cloud);
    EXPECT_EQ(fit.method, FitMethod::scattered);
    EXPECT_TRUE(fit.reached_noise);
    EXPECT_NEAR(fit.noise, noise, 0.15 * noise);
    EXPECT_NEAR(fit.rms, noise, 0.15 * noise);
    EXPECT_LE(fit.mean, fit.rms);
    EXPECT_GE(fit.maximum, fit.rms);
    ASSERT_FALSE(fit.steps.empty());
    for (std::size_t i = 1; i < fit.steps.size(); ++i) EXPECT_GE(fit.steps[i].u_poles, fit.steps[i - 1].u_poles);
    // The true surface, away from the border, where noise lets the fit float.
    const ClosestPointTree tree(fit.surface);
    for (double x = -0.8; x <= 0.8; x += 0.1)
        for (double y = -0.8; y <= 0.8; y += 0.1) EXPECT_LT(tree.closest(Vector3(x, y, waves(x, y)))->distance, noise);
    // Distances are those from the surface.
    for (std::size_t i = 0; i < cloud.points.size(); i += 97)
        EXPECT_NEAR(std::abs(fit.distances[i]), tree.closest(cloud.points[i])->distance, 1e-3 * noise);
}

TEST(FitPoints, ResidualsFallWithTheNetAndWithReprojection) {
    const PointCloud cloud = support::graph_cloud(3000, waves, 0.0, 2);
    double last = INFINITY;
    for (const int poles : {5, 8, 12, 18}) {
        const FitResult fit = fit_points(cloud, {.poles = std::pair(poles, poles)});
        EXPECT_LT(fit.rms, 0.5 * last);
        last = fit.rms;
        EXPECT_LE(fit.rms, fit_points(cloud, {.poles = std::pair(poles, poles), .reprojections = 0}).rms);
    }
    EXPECT_LT(last, 1e-4);
}

TEST(FitPoints, GridsComeBack) {
    // A tube that no plane could carry.
    PointCloud cloud;
    const int rows = 60, columns = 20;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double a = 6.0 * i / (rows - 1);
            cloud.points.emplace_back(std::cos(a), std::sin(a), 0.2 * j);
        }
    const FitResult fit =
        fit_points(cloud, {.method = FitMethod::grid, .poles = std::pair(20, 6), .grid = std::pair(rows, columns)});
    EXPECT_LT(fit.maximum, 1e-4);
    EXPECT_THROW(fit_points(cloud), Unsupported);
    EXPECT_THROW(fit_points(cloud, {.method = FitMethod::grid, .grid = std::pair(7, 7)}), InvalidInput);
    EXPECT_THROW(fit_points(cloud, {.method = FitMethod::grid}), InvalidInput);
}

TEST(FitPoints, MultilevelAndFilter) {
    const PointCloud cloud = support::graph_cloud(4000, waves, 3e-3, 4);
    const FitResult multilevel = fit_points(cloud, {.method = FitMethod::multilevel});
    EXPECT_LT(multilevel.rms, 3 * 3e-3);
    EXPECT_GT(multilevel.steps.size(), 1u);
    const FitResult filtered = fit_points(cloud, {.smooth = 0.06});
    EXPECT_GT(filtered.filter_rms_change, 1e-3);
    EXPECT_LT(filtered.noise, 0.6 * fit_points(cloud).noise);
}

TEST(FitPoints, RefusesNonsense) {
    const PointCloud cloud = support::graph_cloud(200, waves, 0.0, 5);
    EXPECT_THROW(fit_points(PointCloud{}), InvalidInput);
    EXPECT_THROW(fit_points(cloud, {.degree = 0}), InvalidInput);
    EXPECT_THROW(fit_points(cloud, {.poles = std::pair(2, 9)}), InvalidInput);
    EXPECT_THROW(fit_points(cloud, {.poles = std::pair(40, 40)}), InvalidInput);
    EXPECT_THROW(fit_points(cloud, {.smooth = -1.0}), InvalidInput);
    EXPECT_THROW(fit_points(cloud, {.reprojections = -1}), InvalidInput);
    PointCloud line;
    for (int i = 0; i < 50; ++i) line.points.emplace_back(i, 2 * i, 0);
    EXPECT_THROW(fit_points(line), InvalidInput);
    EXPECT_THROW(fit_points(support::sphere_cloud(500, 1.0, 0.0, 1)), Unsupported);
    Progress progress;
    progress.cancel();
    EXPECT_THROW(fit_points(cloud, {}, progress), Cancelled);
}

}  // namespace
}  // namespace umbilic
