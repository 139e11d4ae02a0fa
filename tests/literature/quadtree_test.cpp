// SPDX-License-Identifier: LGPL-2.1-or-later
// Section 3.6 of the thesis by its own method: Table 3.1, figure 3-5, figure 3-6, and the positions at high precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <support/surfaces.h>
#include <umbilic/umbilics/by_projected_polyhedron.h>
#include <umbilic/umbilics/quadtree.h>

namespace umbilic {
namespace {

std::vector<ParameterBox> cluster_hulls(const QuadtreeUmbilics& found) {
    std::vector<ParameterBox> result(found.clusters, {{2, -1}, {2, -1}});
    for (const QuadtreeLeaf& leaf : found.leaves) {
        ParameterBox& hull = result[leaf.cluster];
        hull.u = {std::min(hull.u.low, leaf.box.u.low), std::max(hull.u.high, leaf.box.u.high)};
        hull.v = {std::min(hull.v.low, leaf.box.v.low), std::max(hull.v.high, leaf.box.v.high)};
    }
    return result;
}

TEST(ThesisQuadtree, FiveBoxesOfTable31WithTheirPrintedCorners) {
    QuadtreeOptions options;
    options.tolerance = 0.005;
    const QuadtreeUmbilics found = find_umbilics_by_quadtree(support::table_3_1_patch(), options);
    // One leaf each, two of them joined at u = 1/2.
    EXPECT_EQ(found.leaves.size(), 6u);
    const std::vector<ParameterBox> hulls = cluster_hulls(found);
    ASSERT_EQ(hulls.size(), 5u);
    struct Box {
        double u_low, v_low, u_high, v_high;
    };
    // Lower left and upper right corners, in 256ths; the table prints four digits of them, and 0.9807 for 251/256.
    const std::array<Box, 5> printed = {
        {{54, 13, 55, 14}, {54, 251, 55, 252}, {201, 13, 202, 14}, {201, 251, 202, 252}, {127, 112, 129, 113}}};
    for (const Box& box : printed) {
        EXPECT_TRUE(std::any_of(hulls.begin(), hulls.end(),
                                [&](const ParameterBox& hull) {
                                    return hull.u.low == box.u_low / 256 && hull.u.high == box.u_high / 256 &&
                                           hull.v.low == box.v_low / 256 && hull.v.high == box.v_high / 256;
                                }))
            << box.u_low << ' ' << box.v_low;
    }
}

TEST(ThesisQuadtree, LineOfUmbilicsIsOneColumnOfBoxes) {
    const double z[4] = {0.0, 1.0, -0.3770311209, 0.0};
    std::vector<Vector3> poles;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 2; ++j) poles.emplace_back(i / 3.0, j, z[i]);
    const NurbsSurface developable(KnotVector::bezier(3), KnotVector::bezier(1), std::move(poles));
    const QuadtreeUmbilics found = find_umbilics_by_quadtree(developable);
    EXPECT_EQ(found.clusters, 1);
    ASSERT_EQ(found.leaves.size(), 256u);
    std::vector<bool> row(256, false);
    for (const QuadtreeLeaf& leaf : found.leaves) {
        EXPECT_EQ(leaf.box.u.low, 147.0 / 256);
        EXPECT_EQ(leaf.box.u.high, 148.0 / 256);
        EXPECT_EQ(leaf.box.v.length(), 1.0 / 256);
        row[static_cast<std::size_t>(leaf.box.v.low * 256)] = true;
    }
    EXPECT_EQ(std::count(row.begin(), row.end(), true), 256);
}

TEST(ThesisQuadtree, PlanarRegionOfA20By20SurfaceIsItsSpans) {
    // 17 x 17 spans; 8 x 8 coplanar control points make 5 x 5 planar ones.
    const NurbsSurface rough = support::rough_bicubic(20, 11);
    std::vector<Vector3> poles = rough.poles();
    for (int i = 6; i < 14; ++i)
        for (int j = 6; j < 14; ++j) poles[i * 20 + j].z() = 0.1;
    const NurbsSurface surface(rough.u_knots(), rough.v_knots(), poles);
    const QuadtreeUmbilics found = find_umbilics_by_quadtree(surface);
    EXPECT_FALSE(found.exhausted);
    double area = 0.0;
    int cluster = -1;
    for (const QuadtreeLeaf& leaf : found.leaves) {
        if (!leaf.zero) continue;
        if (cluster < 0) cluster = leaf.cluster;
        EXPECT_EQ(leaf.cluster, cluster);
        area += leaf.box.u.length() * leaf.box.v.length();
        EXPECT_GE(leaf.box.u.low, 6.0 / 17 - 1e-15);
        EXPECT_LE(leaf.box.u.high, 11.0 / 17 + 1e-15);
        EXPECT_GE(leaf.box.v.low, 6.0 / 17 - 1e-15);
        EXPECT_LE(leaf.box.v.high, 11.0 / 17 + 1e-15);
    }
    EXPECT_NEAR(area, 25.0 / (17 * 17), 1e-12);
}

TEST(ThesisQuadtree, PositionsByTheProjectedPolyhedronSolver) {
    const double low = (3 - std::sqrt(3.0)) / 6;
    const double expected[5][3] = {{low, 0.051522680936, -0.5},
                                   {low, 0.983837821065, -0.5},
                                   {0.5, 0.440183509410, 0.5},
                                   {1 - low, 0.051522680936, -0.5},
                                   {1 - low, 0.983837821065, -0.5}};
    for (const UmbilicSystem system : {UmbilicSystem::simple, UmbilicSystem::thesis}) {
        ProjectedPolyhedronUmbilicOptions options;
        options.system = system;
        const ProjectedPolyhedronUmbilics found =
            find_umbilics_by_projected_polyhedron(support::table_3_1_patch(), options);
        EXPECT_TRUE(found.undecided.empty());
        ASSERT_EQ(found.umbilics.size(), 5u);
        for (const auto& [u, v, index] : expected) {
            const auto it = std::find_if(found.umbilics.begin(), found.umbilics.end(), [&](const UmbilicPosition& at) {
                return std::abs(at.u - u) <= at.radius.x() + 1e-15 && std::abs(at.v - v) <= at.radius.y() + 5e-13;
            });
            ASSERT_NE(it, found.umbilics.end()) << u << ' ' << v;
            const bool simple = system == UmbilicSystem::simple;
            EXPECT_EQ(it->certified, simple);
            EXPECT_EQ(it->index, simple ? index : 0.0);
            // Table 6.2 prints boxes of 2.4e-7; ours hold for all inputs that round to the given one.
            EXPECT_LE(it->radius.maxCoeff(), simple ? 1e-10 : 1.2e-7);
        }
    }
}

}  // namespace
}  // namespace umbilic
