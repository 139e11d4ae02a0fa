// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include <support/clouds.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/points/point_jets.h>

namespace umbilic {
namespace {

std::vector<int> every(const PointCloud& cloud, int step) {
    std::vector<int> indices;
    for (int i = 0; i < static_cast<int>(cloud.points.size()); i += step) indices.push_back(i);
    return indices;
}

/// Mean of errors relative to the curvature 1, and the standard deviation of errors in units of the error bar.
struct Quality {
    double bias = 0.0, spread = 0.0;
    int count = 0;

    void add(double error, double bar) {
        bias += error;
        spread += error * error / (bar * bar);
        ++count;
    }
    double mean() const { return bias / count; }
    double in_bars() const { return std::sqrt(spread / count); }
};

TEST(PointJets, AQuarticGraphIsFoundExactly) {
    const auto f = [](double x, double y) {
        return 0.2 * x * x - 0.4 * x * y + 0.1 * y * y * x - 0.05 * x * x * y * y;
    };
    PointCloud cloud = support::graph_cloud(400, f, 0.0, 2);
    cloud.points.emplace_back(0, 0, 0);  // where the frame of the graph is the frame of the jet
    const std::vector<int> last = {400};
    const PointJet jet = point_jets(cloud, Neighbours(cloud.points), last, {.radius = 0.5}).front();
    ASSERT_TRUE(jet.valid);
    EXPECT_TRUE(jet.interior);
    // Second derivatives (0.4, -0.4, 0): curvatures of either sign, for the normal may look either way.
    const double mean = 0.2, root = std::hypot(0.2, 0.4);
    const double sign = jet.frame.normal.z() > 0 ? -1.0 : 1.0;
    const double high = std::max(sign * (mean + root), sign * (mean - root));
    EXPECT_NEAR(jet.frame.kappa_max, high, 1e-9);
    EXPECT_LT(jet.residual, 1e-12);
    EXPECT_NEAR(jet.frame.point.norm(), 0.0, 1e-12);
}

TEST(PointJets, NoisySphereHasItsCurvatureWithinErrorBars) {
    const double radius = 2.0, noise = 0.004;
    const PointCloud cloud = support::sphere_cloud(6000, radius, noise, 11);
    const auto jets = point_jets(cloud, Neighbours(cloud.points), every(cloud, 40), {.radius = 0.5});
    double mean = 0.0;
    for (const PointJet& jet : jets) {
        ASSERT_TRUE(jet.valid && jet.interior);
        mean += std::abs(jet.frame.mean()) / static_cast<double>(jets.size());
        EXPECT_LT(std::abs(std::abs(jet.frame.mean()) - 1.0 / radius), 5.0 * jet.kappa_max_error);
    }
    EXPECT_NEAR(mean, 1.0 / radius, 0.02 / radius);
    EXPECT_NEAR(estimated_noise(jets), noise, 0.15 * noise);
}

TEST(PointJets, ErrorBarsOfANoisyTorusAreTheSpread) {
    const double major = 3.0, minor = 1.0, noise = 0.003;
    const PointCloud cloud = support::torus_cloud(12000, major, minor, noise, 12);
    const auto jets = point_jets(cloud, Neighbours(cloud.points), every(cloud, 40), {.radius = 0.45});
    Quality greater, smaller;
    for (const PointJet& jet : jets) {
        ASSERT_TRUE(jet.valid);
        const Vector3& p = jet.frame.point;
        const double around = std::hypot(p.x(), p.y());
        const Vector3 outward = (p - major / around * Vector3(p.x(), p.y(), 0)).normalized();
        const bool out = jet.frame.normal.dot(outward) > 0;
        const Curvature c = out ? jet.frame : flipped(jet.frame);
        greater.add(c.kappa_max - 1.0 / minor, out ? jet.kappa_max_error : jet.kappa_min_error);
        smaller.add(c.kappa_min - (around - major) / (minor * around), out ? jet.kappa_min_error : jet.kappa_max_error);
    }
    EXPECT_NEAR(greater.mean(), 0.0, 0.01);
    EXPECT_NEAR(smaller.mean(), 0.0, 0.01);
    // The bars hold the noise alone; what the polynomial misses adds to the spread.
    EXPECT_GT(greater.in_bars(), 0.7);
    EXPECT_LT(greater.in_bars(), 1.4);
    EXPECT_GT(smaller.in_bars(), 0.7);
    EXPECT_LT(smaller.in_bars(), 1.4);
}

TEST(PointJets, MeshOfThePatchWithFiveUmbilics) {
    const NurbsSurface patch = support::table_3_1_patch();
    const int n = 61;
    const PointCloud mesh = support::mesh_of(patch, n);
    std::vector<int> inner;
    for (int i = 10; i < n - 10; i += 5)
        for (int j = 10; j < n - 10; j += 5) inner.push_back(i * n + j);
    const auto worst = [&](double radius) {
        const auto jets = point_jets(mesh, Neighbours(mesh.points), inner, {.radius = radius, .most_neighbours = 5000});
        double error = 0.0;
        for (std::size_t k = 0; k < inner.size(); ++k) {
            EXPECT_TRUE(jets[k].valid && jets[k].interior);
            const Curvature truth = curvature(patch, (inner[k] / n) / (n - 1.0), (inner[k] % n) / (n - 1.0));
            EXPECT_GT(jets[k].frame.normal.dot(truth.normal), 0.99);  // triangles give the side
            const double size = 1.0 + std::hypot(truth.kappa_max, truth.kappa_min);
            error = std::max({error, std::abs(jets[k].frame.kappa_max - truth.kappa_max) / size,
                              std::abs(jets[k].frame.kappa_min - truth.kappa_min) / size});
        }
        return error;
    };
    // Second derivatives of a fit of degree 4 to even neighbourhoods err with the fourth power of the radius.
    const double coarse = worst(0.16), fine = worst(0.08);
    EXPECT_LT(fine, 5e-3);
    EXPECT_LT(fine, coarse / 8.0);
}

TEST(PointJets, BordersSheetsAndNonsense) {
    const PointCloud patch = support::graph_cloud(
        2000, [](double x, double y) { return 0.1 * x * y; }, 0.0, 3);
    int corner = 0, middle = 0;
    for (int i = 0; i < 2000; ++i) {
        if (patch.points[i].head<2>().sum() > patch.points[corner].head<2>().sum()) corner = i;
        if (patch.points[i].norm() < patch.points[middle].norm()) middle = i;
    }
    const Neighbours near(patch.points);
    const std::vector<int> two = {corner, middle};
    const auto jets = point_jets(patch, near, two);
    EXPECT_FALSE(jets[0].interior);
    EXPECT_TRUE(jets[1].interior);

    // Points on a line and equal distances determine nothing.
    PointCloud line;
    for (int i = 0; i < 100; ++i) line.points.emplace_back(i, 0, 0);
    const std::vector<int> some = {50};
    EXPECT_FALSE(point_jets(line, Neighbours(line.points), some).front().valid);
    PointCloud few;
    few.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<int> first = {0};
    EXPECT_FALSE(point_jets(few, Neighbours(few.points), first).front().valid);
    EXPECT_THROW(point_jets(few, Neighbours(few.points), first, {.radius = -1.0}), InvalidInput);
    Progress progress;
    progress.cancel();
    EXPECT_THROW(point_jets(patch, near, two, {}, progress), Cancelled);

    // Two sheets that lie closer together than the neighbourhood: normals tell them apart.
    PointCloud sheets;
    for (const PointCloud& sheet : {support::graph_cloud(
                                        1500, [](double x, double) { return 0.25 * x * x; }, 0.0, 4),
                                    support::graph_cloud(
                                        1500, [](double x, double) { return 0.25 * x * x - 0.05; }, 0.0, 5)}) {
        const double side = sheets.points.empty() ? 1.0 : -1.0;
        for (const Vector3& p : sheet.points) {
            sheets.points.push_back(p);
            sheets.normals.push_back(side * Vector3(-0.5 * p.x(), 0, 1).normalized());
        }
    }
    for (const PointJet& jet : point_jets(sheets, Neighbours(sheets.points), every(sheets, 100), {.radius = 0.3})) {
        ASSERT_TRUE(jet.valid);
        EXPECT_LT(jet.residual, 1e-3);
        EXPECT_GT(jet.frame.normal.dot(sheets.normals[jet.index]), 0.99);
    }
}

}  // namespace
}  // namespace umbilic
