// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <support/clouds.h>
#include <umbilic/core/errors.h>
#include <umbilic/points/low_pass.h>

namespace umbilic {
namespace {

/// Root mean square departure of the inner points from the height f.
double departure(const std::vector<Vector3>& points, const std::function<double(double, double)>& f) {
    double square = 0.0;
    int count = 0;
    for (const Vector3& p : points) {
        if (std::max(std::abs(p.x()), std::abs(p.y())) > 0.8) continue;
        square += std::pow(p.z() - f(p.x(), p.y()), 2);
        ++count;
    }
    return std::sqrt(square / count);
}

TEST(LowPass, NoiseFallsAndAPlaneStays) {
    const auto plane = [](double x, double y) { return 0.3 * x - 0.1 * y; };
    const double noise = 0.01;
    const PointCloud cloud = support::graph_cloud(8000, plane, noise, 5);
    const LowPass filtered = low_pass(cloud, 0.08);
    // 4 pi width^2 density points share in each mean: the noise of independent points falls by the root of that.
    const double averaged = 4.0 * M_PI * 0.08 * 0.08 * 8000 / 4.0;
    EXPECT_LT(departure(filtered.points, plane), 1.5 * noise / std::sqrt(averaged));
    EXPECT_GT(filtered.rms_change, 0.5 * noise);
    EXPECT_LT(filtered.rms_change, 1.5 * noise);
    EXPECT_GE(filtered.max_change, filtered.rms_change);
    const PointCloud exact = support::graph_cloud(3000, plane, 0.0, 6);
    EXPECT_LT(low_pass(exact, 0.1).max_change, 1e-13);
}

TEST(LowPass, MovesACurvedSurfaceByItsMeanCurvatureTimesTheSquaredWidth) {
    const double radius = 2.0, width = 0.15;
    const PointCloud sphere = support::sphere_cloud(20000, radius, 0.0, 7);
    const LowPass filtered = low_pass(sphere, width);
    double mean = 0.0;
    for (const Vector3& p : filtered.points) mean += (radius - p.norm()) / static_cast<double>(filtered.points.size());
    // The weight ends at three widths, which takes 9/2 e^(-9/2) / (1 - e^(-9/2)) from its second moment.
    const double expected = width * width / radius * (1.0 - 4.5 * std::exp(-4.5) / (1.0 - std::exp(-4.5)));
    EXPECT_NEAR(mean, expected, 0.03 * expected);
}

TEST(LowPass, RefusesWidthsThatMeanNothing) {
    const PointCloud cloud = support::sphere_cloud(100, 1.0, 0.0, 1);
    EXPECT_THROW(low_pass(cloud, 0.0), InvalidInput);
    EXPECT_THROW(low_pass(cloud, -1.0), InvalidInput);
    EXPECT_THROW(low_pass(cloud, NAN), InvalidInput);
    EXPECT_EQ(low_pass(PointCloud{}, 1.0).points.size(), 0u);
    // Too few neighbours: nothing moves.
    EXPECT_EQ(low_pass(support::sphere_cloud(3, 1.0, 0.0, 1), 1.0).max_change, 0.0);
}

}  // namespace
}  // namespace umbilic
