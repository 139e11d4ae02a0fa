// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include <support/clouds.h>
#include <support/surfaces.h>
#include <umbilic/nurbs/area.h>
#include <umbilic/points/point_weights.h>

namespace umbilic {
namespace {

TEST(PointWeights, SumToTheArea) {
    // A closed cloud has no border; the disc up to the k-th neighbour is an unbiased estimate for a Poisson process.
    const PointCloud sphere = support::sphere_cloud(4000, 2.0, 0.0, 3);
    const std::vector<double> on_sphere = point_weights(sphere, Neighbours(sphere.points));
    const double area = 16.0 * std::numbers::pi;
    EXPECT_NEAR(std::accumulate(on_sphere.begin(), on_sphere.end(), 0.0), area, 0.05 * area);

    const PointCloud plane = support::mesh_of(support::graph_patch(1, 1, [](double, double) { return 0.0; }), 9);
    const std::vector<double> on_plane = point_weights(plane, Neighbours(plane.points));
    EXPECT_NEAR(std::accumulate(on_plane.begin(), on_plane.end(), 0.0), 4.0, 1e-12);
}

TEST(PointWeights, APointThatLiesApartStandsForFewOthers) {
    PointCloud sphere = support::sphere_cloud(4000, 2.0, 0.0, 3);
    sphere.points.emplace_back(1e6, 0.0, 0.0);
    const std::vector<double> weights = point_weights(sphere, Neighbours(sphere.points));
    const double area = 16.0 * std::numbers::pi;
    EXPECT_LT(weights.back(), 15.0 * area / 4000.0);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), area, 0.05 * area);
}

}  // namespace
}  // namespace umbilic
