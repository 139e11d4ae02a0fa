// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/points/point_weights.h>

#include <algorithm>
#include <cstddef>
#include <numbers>

#include <oneapi/tbb/parallel_for.h>

namespace umbilic {

namespace {

constexpr int disc_neighbours = 8;

}  // namespace

std::vector<double> point_weights(const PointCloud& cloud, const Neighbours& neighbours) {
    std::vector<double> weights(cloud.points.size(), 0.0);
    if (cloud.is_mesh()) {
        for (const auto& triangle : cloud.triangles) {
            const double third = triangle_area(cloud, triangle) / 3.0;
            for (const int corner : triangle) weights[corner] += third;
        }
        return weights;
    }
    tbb::parallel_for(std::size_t{0}, cloud.points.size(), [&](std::size_t i) {
        // The nearest neighbour is the point itself.
        const std::vector<Neighbour> near = neighbours.nearest(cloud.points[i], disc_neighbours + 1);
        if (near.size() > 1)
            weights[i] = std::numbers::pi * near.back().squared_distance / static_cast<double>(near.size() - 1);
    });
    std::vector<double> sorted = weights;
    if (sorted.empty()) return weights;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    for (double& weight : weights) weight = std::min(weight, greatest_point_weight * *middle);
    return weights;
}

}  // namespace umbilic
