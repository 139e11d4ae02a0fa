// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include <point_files/read_points.h>
#include <point_files/write_ply.h>
#include <support/clouds.h>
#include <support/surfaces.h>

namespace umbilic {
namespace {

PointCloud read_back(const std::string& text) {
    const auto path = std::filesystem::path(testing::TempDir()) / ("umbilic_" + std::to_string(getpid()) + ".ply");
    std::ofstream(path, std::ios::binary) << text;
    PointCloud cloud = read_points(path.string());
    std::filesystem::remove(path);
    return cloud;
}

TEST(WritePly, MeshesReadBackExactly) {
    PointCloud mesh = support::mesh_of(support::smooth_bicubic(8, 3, 0.3), 12);
    mesh.normals.assign(mesh.points.size(), Vector3(0, 0, 1));
    const PointCloud back = read_back(ply_text(mesh));
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_EQ(back.normals, mesh.normals);
}

TEST(WritePly, MovesPointsAndKeepsTheOutwardSide) {
    const PointCloud mesh = support::mesh_of(support::ellipsoid_octant(3, 2, 1), 6);
    const SimilarityTransform mirror{.scale = 2.0, .translation = Vector3(1, 2, 3), .mirrored = true};
    PointCloud clean_mesh = mesh;
    clean(clean_mesh);
    const PointCloud back = read_back(ply_text(clean_mesh, mirror));
    ASSERT_EQ(back.points.size(), clean_mesh.points.size());
    for (std::size_t i = 0; i < back.points.size(); ++i) EXPECT_EQ(back.points[i], mirror.apply(clean_mesh.points[i]));
    const std::vector<Vector3> before = outward_normals(clean_mesh), after = outward_normals(back);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_GT(after[i].dot(mirror.apply_direction(before[i])), 0.0);
}

}  // namespace
}  // namespace umbilic
