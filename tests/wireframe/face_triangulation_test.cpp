// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include <umbilic/wireframe/face_triangulation.h>

namespace umbilic {
namespace {

GridPoint at(double x, double y) {
    return {static_cast<std::int64_t>(x * grid_side), static_cast<std::int64_t>(y * grid_side)};
}

struct Counts {
    int vertices = 0, edges = 0, triangles = 0;
    std::int64_t area = 0;  ///< twice, in grid steps
    int euler() const { return vertices - edges + triangles; }
};

Counts count(const FaceTriangulation& mesh) {
    Counts counts;
    std::set<int> vertices;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
        if (!mesh.alive(t)) continue;
        ++counts.triangles;
        const std::int64_t area =
            orientation(mesh.slot(3 * t).corner, mesh.slot(3 * t + 1).corner, mesh.slot(3 * t + 2).corner);
        EXPECT_GT(area, 0);
        counts.area += area;
        for (int s = 3 * t; s < 3 * t + 3; ++s) {
            vertices.insert(mesh.slot(s).vertex);
            const int twin = mesh.slot(s).twin;
            if (twin < s) ++counts.edges;
            if (twin < 0) continue;
            EXPECT_EQ(mesh.slot(twin).twin, s);
            EXPECT_EQ(mesh.slot(FaceTriangulation::next(s)).vertex,
                      mesh.slot(FaceTriangulation::previous(twin)).vertex);
        }
    }
    counts.vertices = static_cast<int>(vertices.size());
    return counts;
}

/// The unit square with n nodes a side, from the vertex number `first`.
std::vector<int> square(FaceTriangulation::Loops& loops, double low, double high, int n) {
    std::vector<int> loop;
    const auto add = [&](double x, double y) {
        loop.push_back(static_cast<int>(loops.corners.size()));
        loops.corners.push_back(at(low + (high - low) * x, low + (high - low) * y));
    };
    for (int i = 0; i < n; ++i) add(double(i) / n, 0);
    for (int i = 0; i < n; ++i) add(1, double(i) / n);
    for (int i = 0; i < n; ++i) add(1 - double(i) / n, 1);
    for (int i = 0; i < n; ++i) add(0, 1 - double(i) / n);
    return loop;
}

std::vector<Vector3> flat(const FaceTriangulation::Loops& loops) {
    std::vector<Vector3> points;
    for (const GridPoint& p : loops.corners) points.emplace_back(double(p.x) / grid_side, double(p.y) / grid_side, 0.0);
    return points;
}

TEST(FaceTriangulation, FillsASquareWithAHole) {
    FaceTriangulation::Loops loops;
    loops.loops.push_back(square(loops, 0, 1, 8));
    loops.loops.push_back(square(loops, 0.25, 0.5, 3));
    FaceTriangulation mesh;
    ASSERT_FALSE(mesh.build(loops, 1.0));
    const Counts counts = count(mesh);
    EXPECT_EQ(counts.vertices, 44);
    EXPECT_EQ(counts.euler(), 0);
    EXPECT_NEAR(static_cast<double>(counts.area) / (2.0 * grid_side * grid_side), 1 - 0.0625, 1e-12);
}

TEST(FaceTriangulation, KeepsItsAreaUnderInsertionAndRemoval) {
    FaceTriangulation::Loops loops;
    loops.loops.push_back(square(loops, 0, 1, 5));
    FaceTriangulation mesh;
    ASSERT_FALSE(mesh.build(loops, 1.0));
    mesh.set_points(flat(loops));
    mesh.improve(Vector3::Zero());
    std::vector<int> inner;
    // On edges and corners of others too: a grid.
    for (int i = 1; i < 16; ++i)
        for (int j = 1; j < 16; ++j) {
            const GridPoint p = at(i / 16.0, j / 16.0);
            const FaceTriangulation::Place place = mesh.locate(p, -1, true);
            ASSERT_FALSE(place.outside);
            const int v = mesh.insert(place, {i / 16.0, j / 16.0, 0.0});
            ASSERT_GE(v, 0);
            inner.push_back(v);
        }
    EXPECT_EQ(mesh.insert(mesh.locate(at(0.5, 0.5), -1, true), {0.5, 0.5, 0}), -1);
    Counts counts = count(mesh);
    EXPECT_EQ(counts.vertices, 20 + 225);
    EXPECT_EQ(counts.euler(), 1);
    EXPECT_EQ(counts.area, 2 * grid_side * grid_side);
    for (const int v : inner) EXPECT_TRUE(mesh.remove(v));
    counts = count(mesh);
    EXPECT_EQ(counts.vertices, 20);
    EXPECT_EQ(counts.euler(), 1);
    EXPECT_EQ(counts.area, 2 * grid_side * grid_side);
}

/// Where a vertex is taken out no flip may be left that is an improvement: what remains would tell where it was.
TEST(FaceTriangulation, IsImprovedWhereAVertexIsTakenOut) {
    FaceTriangulation::Loops loops;
    loops.loops.push_back(square(loops, 0, 1, 5));
    FaceTriangulation mesh;
    ASSERT_FALSE(mesh.build(loops, 1.0));
    mesh.set_points(flat(loops));
    mesh.improve(Vector3::Zero());
    std::vector<int> taken;
    // An irregular set: multiples of two irrational numbers.
    for (int i = 1; i <= 300; ++i) {
        const double x = 0.05 + 0.9 * std::fmod(i * 0.6180339887, 1.0),
                     y = 0.05 + 0.9 * std::fmod(i * 0.7548776662, 1.0);
        const int v = mesh.insert(mesh.locate(at(x, y), -1, true), {x, y, 0.1 * std::sin(3 * x + 2 * y)});
        ASSERT_GE(v, 0);
        if (i % 3 == 0) taken.push_back(v);
    }
    for (const int v : taken) EXPECT_TRUE(mesh.remove(v));
    mesh.take_changed();
    mesh.improve(Vector3::Zero());
    EXPECT_TRUE(mesh.take_changed().empty());
}

TEST(FaceTriangulation, TellsWhichSegmentsCross) {
    FaceTriangulation::Loops loops;
    loops.corners = {at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
    loops.loops = {{0, 1, 2, 3}};
    FaceTriangulation mesh;
    EXPECT_TRUE(mesh.build(loops, 1.0));
    loops.corners = {at(0, 0), at(1, 0), at(0, 0), at(0, 1)};
    EXPECT_TRUE(mesh.build(loops, 1.0));
}

TEST(FaceTriangulation, IsGluedAcrossASeam) {
    // The square's left and right sides are one: a cylinder.
    const int n = 4;
    FaceTriangulation::Loops loops;
    loops.loops.push_back(square(loops, 0, 1, n));
    FaceTriangulation mesh;
    ASSERT_FALSE(mesh.build(loops, 1.0));
    std::vector<int> names(4 * n);
    for (int i = 0; i < 4 * n; ++i) names[i] = i;
    const auto right = [&](int k) { return n + k; };                  // (1, k / n)
    const auto left = [&](int k) { return k == 0 ? 0 : 4 * n - k; };  // (0, k / n)
    for (int k = 0; k < n; ++k) mesh.glue(right(k), right(k + 1), left(k + 1), left(k));
    for (int k = 0; k <= n; ++k) names[right(k)] = left(k);
    mesh.rename(names);
    EXPECT_EQ(count(mesh).euler(), 0);
    std::vector<Vector3> points(4 * n);
    for (int i = 0; i < 4 * n; ++i) {
        const double angle = 2 * 3.14159265358979 * loops.corners[i].x / grid_side;
        points[names[i]] = {std::cos(angle), std::sin(angle), 4.0 * loops.corners[i].y / grid_side};
    }
    mesh.set_points(points);
    mesh.improve(Vector3::Zero());
    for (int k = 1; k < n; ++k) EXPECT_TRUE(mesh.remove(left(k)));
    const Counts counts = count(mesh);
    EXPECT_EQ(counts.euler(), 0);
    EXPECT_EQ(counts.area, 2 * grid_side * grid_side);
    // A point beyond the seam is found on the other side.
    EXPECT_FALSE(mesh.locate(at(0.9, 0.5), 0, true).outside);
}

}  // namespace
}  // namespace umbilic
