// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include <support/clouds.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/points/triangle_tree.h>

namespace umbilic {
namespace {

TEST(TriangleTree, FindsWhatALoopOverSingleTrianglesFinds) {
    const PointCloud mesh = support::mesh_of(support::smooth_bicubic(8, 41, 0.3), 15);
    const TriangleTree tree(mesh);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-0.5, 1.5);
    for (int i = 0; i < 300; ++i) {
        const Vector3 p(uniform(random), uniform(random), uniform(random));
        double least = std::numeric_limits<double>::infinity();
        for (const auto& triangle : mesh.triangles) {
            PointCloud single = mesh;
            single.triangles = {triangle};
            least = std::min(least, TriangleTree(single).closest(p).distance);
        }
        const TriangleFoot foot = tree.closest(p);
        EXPECT_EQ(foot.distance, least);
        Vector3 point = Vector3::Zero();
        for (int k = 0; k < 3; ++k) point += foot.weights[k] * mesh.points[mesh.triangles[foot.triangle][k]];
        EXPECT_LT((point - foot.point).norm(), 1e-15);
        EXPECT_NEAR((p - foot.point).norm(), foot.distance, 1e-15);
    }
}

TEST(TriangleTree, DistancesFromASquareAndItsBorder) {
    const PointCloud square = support::mesh_of(support::graph_patch(1, 1, [](double, double) { return 0.0; }), 9);
    const TriangleTree tree(square);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(-3.0, 3.0);
    for (int i = 0; i < 1000; ++i) {
        const Vector3 p(uniform(random), uniform(random), uniform(random));
        const Vector3 nearest(std::clamp(p.x(), -1.0, 1.0), std::clamp(p.y(), -1.0, 1.0), 0.0);
        const TriangleFoot foot = tree.closest(p);
        EXPECT_NEAR(foot.distance, (p - nearest).norm(), 1e-14);
        EXPECT_LT((foot.point - nearest).norm(), 1e-14);
        EXPECT_EQ(foot.at_border, std::max(std::abs(p.x()), std::abs(p.y())) > 1.0);
    }
    // Inner edges and corners are no border; corners on the border are.
    EXPECT_FALSE(tree.closest(square.points[4 * 9 + 4]).at_border);
    EXPECT_TRUE(tree.closest(square.points[4 * 9]).at_border);
    EXPECT_EQ(tree.closest(square.points[4 * 9 + 4]).distance, 0.0);
}

TEST(TriangleTree, RefusesACloud) {
    EXPECT_THROW(TriangleTree(support::sphere_cloud(50, 1.0, 0.0, 1)), InvalidInput);
}

}  // namespace
}  // namespace umbilic
