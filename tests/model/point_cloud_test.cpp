// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>

#include <gtest/gtest.h>

#include <support/clouds.h>
#include <support/surfaces.h>
#include <umbilic/model/point_cloud.h>

namespace umbilic {
namespace {

TEST(ThinOut, LeavesAsManyPointsAsAskedForInTheirOrder) {
    const PointCloud all = support::sphere_cloud(1000, 2.0, 0.0, 3);
    PointCloud cloud = all;
    thin_out(cloud, 100, 7);
    ASSERT_EQ(cloud.points.size(), 100u);
    EXPECT_EQ(cloud.thinned_out, 900u);
    ASSERT_EQ(cloud.warnings.size(), 1u);
    EXPECT_NE(cloud.warnings[0].find("1000"), std::string::npos);
    auto next = all.points.begin();
    for (const Vector3& p : cloud.points) {
        next = std::find(next, all.points.end(), p);
        ASSERT_NE(next, all.points.end());
        ++next;
    }
    PointCloud again = all, other = all;
    thin_out(again, 100, 7);
    thin_out(other, 100, 8);
    EXPECT_EQ(again.points, cloud.points);
    EXPECT_NE(other.points, cloud.points);
}

TEST(ThinOut, DoesNothingToSmallClouds) {
    const PointCloud all = support::sphere_cloud(50, 2.0, 0.0, 3);
    PointCloud cloud = all;
    thin_out(cloud, 50);
    EXPECT_EQ(cloud.points, all.points);
    EXPECT_TRUE(cloud.warnings.empty());
    EXPECT_EQ(cloud.thinned_out, 0u);
}

TEST(ThinOut, KeepsTheOutwardSideOfAMesh) {
    PointCloud mesh = support::mesh_of(support::ellipsoid_octant(2, 2, 2), 20);
    clean(mesh);
    mesh.points.emplace_back(50, 50, 50);  // of no triangle
    const std::vector<Vector3> normals = outward_normals(mesh);
    EXPECT_TRUE(normals.back().isZero(0.0));
    const double side = normals.front().dot(mesh.points.front());
    thin_out(mesh, 60);
    ASSERT_EQ(mesh.points.size(), 60u);
    ASSERT_EQ(mesh.normals.size(), 60u);
    EXPECT_FALSE(mesh.is_mesh());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        EXPECT_LT(mesh.points[i].norm(), 3.0);
        EXPECT_NEAR(mesh.normals[i].norm(), 1.0, 1e-12);
        EXPECT_GT(mesh.normals[i].dot(mesh.points[i]) * side, 0.0);
    }
}

}  // namespace
}  // namespace umbilic
