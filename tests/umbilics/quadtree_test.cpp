// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/quadtree.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

bool touches(const ParameterBox& box, const Umbilic& umbilic, const ParameterBox& domain) {
    const double u = umbilic.radius * domain.u.length(), v = umbilic.radius * domain.v.length();
    return umbilic.at.u >= box.u.low - u && umbilic.at.u <= box.u.high + u && umbilic.at.v >= box.v.low - v &&
           umbilic.at.v <= box.v.high + v;
}

TEST(Quadtree, HoldsEveryCertifiedUmbilicOfRandomSurfaces) {
    int umbilics = 0, alone = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        const int p = 2 + seed % 3, q = 2 + seed / 3 % 2;
        const NurbsSurface surface =
            support::random_surface(p, q, p + 3, q + 4, seed, 0.2, seed % 4 == 0 && p < 4 ? 2.0 : 1.0);
        const FaceUmbilics certified = find_umbilics(surface);
        const QuadtreeUmbilics found = find_umbilics_by_quadtree(surface);
        EXPECT_FALSE(found.exhausted);
        std::set<int> with_umbilic;
        for (const Umbilic& umbilic : certified.umbilics) {
            ++umbilics;
            const auto leaf = std::find_if(found.leaves.begin(), found.leaves.end(), [&](const QuadtreeLeaf& leaf) {
                return touches(leaf.box, umbilic, surface.domain());
            });
            ASSERT_NE(leaf, found.leaves.end());
            with_umbilic.insert(leaf->cluster);
        }
        // Clusters without one: P_N is small there, but the certified search excludes them.
        alone += found.clusters - static_cast<int>(with_umbilic.size());
    }
    EXPECT_GT(umbilics, 100);
    EXPECT_LT(alone, umbilics / 2);
}

TEST(Quadtree, LeavesAreBelowTheToleranceOfTheWholeDomain) {
    const NurbsSurface surface = support::rough_bicubic(10, 3);
    QuadtreeOptions options;
    for (const double tolerance : {0.1, 0.01, 0.001}) {
        options.tolerance = tolerance;
        const QuadtreeUmbilics found = find_umbilics_by_quadtree(surface, options);
        EXPECT_FALSE(found.leaves.empty());
        for (const QuadtreeLeaf& leaf : found.leaves) {
            EXPECT_LT(leaf.box.u.length(), tolerance);
            EXPECT_LT(leaf.box.v.length(), tolerance);
            EXPECT_FALSE(leaf.zero);
        }
    }
}

TEST(Quadtree, FinerToleranceStaysInsideCoarserLeaves) {
    const NurbsSurface surface = support::table_3_1_patch();
    QuadtreeOptions fine;
    fine.tolerance = 1e-4;
    const QuadtreeUmbilics coarse = find_umbilics_by_quadtree(surface),
                           finer = find_umbilics_by_quadtree(surface, fine);
    for (const QuadtreeLeaf& leaf : finer.leaves)
        EXPECT_TRUE(std::any_of(coarse.leaves.begin(), coarse.leaves.end(), [&](const QuadtreeLeaf& outer) {
            return outer.box.u.low <= leaf.box.u.low && leaf.box.u.high <= outer.box.u.high &&
                   outer.box.v.low <= leaf.box.v.low && leaf.box.v.high <= outer.box.v.high;
        }));
}

TEST(Quadtree, PlaneAndSphereAreOneBoxPerPatch) {
    const NurbsSurface plane =
        support::transformed(support::smooth_bicubic(8, 1, 0.0), support::random_similarity(4, 1.0, false, 100.0));
    const QuadtreeUmbilics flat = find_umbilics_by_quadtree(plane);
    EXPECT_EQ(flat.boxes, 25);
    EXPECT_EQ(flat.clusters, 1);
    ASSERT_EQ(flat.leaves.size(), 25u);
    for (const QuadtreeLeaf& leaf : flat.leaves) EXPECT_TRUE(leaf.zero);
    const QuadtreeUmbilics sphere = find_umbilics_by_quadtree(support::ellipsoid_octant(2, 2, 2));
    ASSERT_EQ(sphere.leaves.size(), 1u);
    EXPECT_TRUE(sphere.leaves[0].zero);
}

TEST(Quadtree, NoUmbilicNoBox) {
    const QuadtreeUmbilics found = find_umbilics_by_quadtree(support::torus_quarter(3, 1));
    EXPECT_TRUE(found.leaves.empty());
    EXPECT_EQ(found.clusters, 0);
}

TEST(Quadtree, BudgetKeepsWhatIsLeft) {
    QuadtreeOptions options;
    options.boxes_per_patch = 20;
    const NurbsSurface surface = support::table_3_1_patch();
    const QuadtreeUmbilics found = find_umbilics_by_quadtree(surface, options);
    EXPECT_TRUE(found.exhausted);
    EXPECT_EQ(found.boxes, 20);
    for (const Umbilic& umbilic : find_umbilics(surface).umbilics)
        EXPECT_TRUE(std::any_of(found.leaves.begin(), found.leaves.end(), [&](const QuadtreeLeaf& leaf) {
            return touches(leaf.box, umbilic, surface.domain());
        }));
}

TEST(Quadtree, BadOptionsHighDegreesAndCancelling) {
    const NurbsSurface surface = support::table_3_1_patch();
    QuadtreeOptions options;
    for (const double tolerance : {0.0, -1.0, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
        options.tolerance = tolerance;
        EXPECT_THROW(find_umbilics_by_quadtree(surface, options), InvalidInput);
    }
    options = {};
    options.boxes_per_patch = 0;
    EXPECT_THROW(find_umbilics_by_quadtree(surface, options), InvalidInput);
    const NurbsSurface steep = support::graph_patch(22, 2, [](double x, double y) { return x * x * x + x * y; });
    EXPECT_THROW(find_umbilics_by_quadtree(steep), Unsupported);
    const Progress progress([](double, std::string_view) { return false; });
    EXPECT_THROW(find_umbilics_by_quadtree(surface, {}, progress), Cancelled);
}

}  // namespace
}  // namespace umbilic
