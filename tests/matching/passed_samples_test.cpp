// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <support/clouds.h>
#include <support/surfaces.h>
#include <umbilic/matching/passed_samples.h>

namespace umbilic {
namespace {

constexpr double radius = 2.0;

/// Sides of the triangles of an n x n mesh of the full sphere are at most this long.
double longest_side(int n) {
    const double along = M_PI / (n - 1);
    return radius * std::hypot(along, 2.0 * along);
}

class MeshOfASphere : public ::testing::TestWithParam<int> {
protected:
    static PointCloud mesh(const SimilarityTransform& original_mesh) {
        PointCloud cloud = support::mesh_of(support::full_sphere(radius), GetParam());
        for (Vector3& p : cloud.points) p = original_mesh.inverse().apply(p);
        clean(cloud);
        return cloud;
    }
    const Model sphere = support::model_of({support::full_sphere(radius)});
    const std::vector<AreaSample> samples = area_samples(sphere, {.count = 2000});
};

/// The sphere falls x^2 / 2r below its tangent plane over x, and x^4 / 8r^3 more: what is left of a chord of half the
/// side h, which is h^2 / 8r deep.
TEST_P(MeshOfASphere, PassesItWhateverItsChords) {
    const SimilarityTransform pose = support::random_similarity(3, 1.7, true);
    const PointCloud cloud = mesh(pose);
    const PreparedPoints suspect = prepare(cloud);
    const double side = longest_side(GetParam());
    double deepest = 0.0;
    for (const PassedSample& passed : passed_samples(samples, suspect, pose)) {
        EXPECT_FALSE(passed.past_border);
        EXPECT_LT(passed.distance, std::pow(side, 4) / (8.0 * std::pow(radius, 3)));
        EXPECT_EQ(std::abs(passed.signed_distance), passed.distance);
        deepest = std::max(deepest, passed.chord);
    }
    EXPECT_GT(deepest, 0.3 * side * side / (8.0 * radius));
    EXPECT_LT(deepest, side * side / (2.0 * radius));
}

/// A sphere that is greater by 1 % lies 0.01 r outside, whatever the mesh.
TEST_P(MeshOfASphere, KeepsADifferenceOfTheShapes) {
    SimilarityTransform greater;
    greater.scale = 1.01;
    const PointCloud cloud = mesh({});
    const PreparedPoints suspect = prepare(cloud);
    const double error = 1.1 * std::pow(longest_side(GetParam()), 4) / (8.0 * std::pow(radius, 3));
    for (const PassedSample& passed : passed_samples(samples, suspect, greater))
        EXPECT_NEAR(passed.signed_distance, 0.01 * radius, error + 1e-3 * radius);
}

INSTANTIATE_TEST_SUITE_P(CoarseAndFine, MeshOfASphere, ::testing::Values(17, 33, 65));

/// The corners of two triangles lie on the foot of a hill that nothing tells of: almost nowhere is it covered. Where
/// the mesh knows the hill, all of it is.
TEST(PassedSamples, AHillThatTheCornersDoNotKnowOfIsNotCovered) {
    const NurbsSurface hill = support::graph_patch(4, 4, [](double x, double y) {
        const double a = 1.0 - x * x, b = 1.0 - y * y;
        return 0.2 * a * a * b * b;
    });
    const PointCloud whole = support::mesh_of(hill, 17);
    PointCloud spanned = whole;
    const auto inside = [&](int i) { return whole.points[i].head<2>().cwiseAbs().maxCoeff() < 0.7; };
    std::erase_if(spanned.triangles, [&](const auto& t) { return inside(t[0]) || inside(t[1]) || inside(t[2]); });
    const int near = 2, far = 14, n = 17;
    spanned.triangles.push_back({near * n + near, far * n + near, far * n + far});
    spanned.triangles.push_back({near * n + near, far * n + far, near * n + far});
    for (int i = 0; i < n * n; ++i)
        if (inside(i)) spanned.points[i].setConstant(NAN);
    clean(spanned);

    std::vector<AreaSample> samples;
    for (const AreaSample& sample : area_samples(support::model_of({hill}), {.count = 5000}))
        if (sample.curvature.point.head<2>().cwiseAbs().maxCoeff() < 0.7) samples.push_back(sample);
    const auto covered = [&](const PointCloud& mesh) {
        const PreparedPoints suspect = prepare(mesh);
        std::size_t count = 0;
        for (const PassedSample& passed : passed_samples(samples, suspect, {})) count += passed.distance < 5e-3;
        return static_cast<double>(count) / static_cast<double>(samples.size());
    };
    EXPECT_EQ(covered(whole), 1.0);
    EXPECT_LT(covered(spanned), 0.1);
}

TEST(PassedSamples, WhatLiesBeyondAMeshIsAsFarAsItsBorder) {
    const Model square = support::model_of({support::graph_patch(1, 1, [](double, double) { return 0.0; })});
    const std::vector<AreaSample> samples = area_samples(square, {.count = 2000});
    PointCloud half = support::mesh_of(support::graph_patch(1, 1, [](double, double) { return 0.0; }), 9);
    std::erase_if(half.triangles, [&](const std::array<int, 3>& t) {
        return half.points[t[0]].x() + half.points[t[1]].x() + half.points[t[2]].x() > 0.0;
    });
    const PreparedPoints suspect = prepare(half);
    const std::vector<PassedSample> passed = passed_samples(samples, suspect, {});
    for (std::size_t i = 0; i < samples.size(); ++i)
        EXPECT_NEAR(passed[i].distance, std::max(0.0, samples[i].curvature.point.x()), 1e-12);
}

}  // namespace
}  // namespace umbilic
