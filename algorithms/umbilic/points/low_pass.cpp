// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/points/low_pass.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/points/neighbours.h>

namespace umbilic {

namespace {

/// Neighbours beyond this many widths weigh less than 1 %.
constexpr double reach = 3.0;
/// A plane needs three points; with fewer a point stays where it is.
constexpr std::size_t fewest_neighbours = 4;

/// Displacement of one point: along the normal of its neighbours' plane, to their mean height over the linear trend.
double height_change(const Vector3& point, std::span<const Vector3> points, const std::vector<Neighbour>& near,
                     double width, Vector3& normal) {
    Vector3 mean = Vector3::Zero();
    double total = 0.0;
    std::vector<double> weights;
    for (const Neighbour& n : near) {
        weights.push_back(std::exp(-0.5 * n.squared_distance / (width * width)));
        mean += weights.back() * points[n.index];
        total += weights.back();
    }
    mean /= total;
    Matrix3 scatter = Matrix3::Zero();
    for (std::size_t k = 0; k < near.size(); ++k) {
        const Vector3 d = points[near[k].index] - mean;
        scatter += weights[k] * d * d.transpose();
    }
    normal = Eigen::SelfAdjointEigenSolver<Matrix3>(scatter).eigenvectors().col(0);
    // The regression plane passes through the mean: at the point it is the mean height plus the trend.
    return normal.dot(mean - point);
}

}  // namespace

LowPass low_pass(const PointCloud& cloud, double width, const Progress& progress) {
    if (!(std::isfinite(width) && width > 0.0))
        throw InvalidInput("low-pass filter: the width must be a positive length in mm");
    const Neighbours neighbours(cloud.points);
    LowPass result{.points = cloud.points, .width = width};
    std::vector<double> changes(cloud.points.size(), 0.0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.points.size(), 256), [&](const auto& range) {
        progress.check();
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const std::vector<Neighbour> near = neighbours.within(cloud.points[i], reach * width);
            if (near.size() < fewest_neighbours) continue;
            Vector3 normal;
            changes[i] = height_change(cloud.points[i], cloud.points, near, width, normal);
            result.points[i] += changes[i] * normal;
            changes[i] = std::abs(changes[i]);
        }
    });
    double square = 0.0;
    for (const double change : changes) {
        square += change * change;
        result.max_change = std::max(result.max_change, change);
    }
    if (!changes.empty()) result.rms_change = std::sqrt(square / static_cast<double>(changes.size()));
    return result;
}

}  // namespace umbilic
