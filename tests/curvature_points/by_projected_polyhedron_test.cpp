// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/by_projected_polyhedron.h>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>

namespace umbilic {
namespace {

/// Both searches find the same points.
void expect_same(const NurbsSurface& surface, double u, double v, CurvatureSystem system) {
    const Curvature there = curvature(surface, u, v);
    const CurvatureQuery query{there.gaussian(), there.mean()};
    const CurvaturePoints expected = find_curvature_points(surface, {&query, 1});
    const ProjectedPolyhedronCurvaturePoints found =
        find_curvature_points_by_projected_polyhedron(surface, query, {.system = system});
    EXPECT_FALSE(found.exhausted);
    EXPECT_TRUE(found.undecided.empty());
    EXPECT_EQ(found.points.size(), expected.points.size());
    for (const CurvaturePosition& point : found.points) {
        EXPECT_TRUE(point.certified);
        EXPECT_TRUE(std::any_of(expected.points.begin(), expected.points.end(),
                                [&](const CurvaturePoint& other) {
                                    return other.opposite == point.opposite && std::abs(other.at.u - point.u) < 1e-9 &&
                                           std::abs(other.at.v - point.v) < 1e-9;
                                }))
            << point.u << ' ' << point.v;
    }
}

TEST(CurvaturePointsByProjectedPolyhedron, AgreeWithTheSearch) {
    expect_same(support::table_3_1_patch(), 0.3, 0.6, CurvatureSystem::auxiliary);
    expect_same(support::table_3_1_patch(), 0.3, 0.6, CurvatureSystem::squared);
    for (const unsigned seed : {1u, 2u}) {
        const NurbsSurface surface = support::rough_bicubic(6, seed, 0.1);
        expect_same(surface, 0.35, 0.62, CurvatureSystem::auxiliary);
        expect_same(surface, 0.35, 0.62, CurvatureSystem::squared);
    }
    expect_same(support::random_surface(2, 2, 4, 4, 3, 0.2, 2.0), 0.41, 0.37, CurvatureSystem::auxiliary);
}

TEST(CurvaturePointsByProjectedPolyhedron, BadOptionsAreRefused) {
    const NurbsSurface surface = support::table_3_1_patch();
    EXPECT_THROW(find_curvature_points_by_projected_polyhedron(surface, {1.0, 1.0, 0.1, 0.1}), InvalidInput);
    EXPECT_THROW(find_curvature_points_by_projected_polyhedron(surface, {1.0, 1.0}, {.tolerance = 0.0}), InvalidInput);
    EXPECT_THROW(find_curvature_points_by_projected_polyhedron(surface, {1.0, 1.0}, {.boxes_per_patch = 0}),
                 InvalidInput);
}

}  // namespace
}  // namespace umbilic
