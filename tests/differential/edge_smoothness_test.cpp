// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <umbilic/differential/edge_smoothness.h>

#include <support/surfaces.h>

namespace umbilic {
namespace {

/// Unit square from the y axis towards the direction (cos, sin) of the x, z plane.
NurbsSurface leaf(double angle) {
    const Vector3 out(std::cos(angle), 0, std::sin(angle)), along = Vector3::UnitY();
    return NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1), {Vector3::Zero(), along, out, out + along});
}

/// Quarter of a cylinder of radius r that leaves the y axis along +x and turns upwards.
NurbsSurface quarter(double r) {
    const double w = std::sqrt(0.5);
    const Vector3 along = Vector3::UnitY(), side(r, 0, 0), top(r, 0, r);
    return NurbsSurface(KnotVector::bezier(2), KnotVector::bezier(1),
                        {Vector3::Zero(), along, side, side + along, top, top + along}, {1, 1, w, w, 1, 1});
}

EdgeSmoothness of_shared_edge(std::vector<NurbsSurface> surfaces) {
    const Model model = support::model_of(std::move(surfaces));
    const FaceAdjacency adjacency = face_adjacency(model);
    const std::vector<EdgeSmoothness> all = edge_smoothness(adjacency);
    EdgeSmoothness result;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (adjacency.edges[i].uses.size() == 2)
            result = all[i];
        else
            EXPECT_EQ(all[i].samples, 0);
    EXPECT_GT(result.samples, 0);
    return result;
}

TEST(EdgeSmoothness, BendIsTheAngleBetweenTwoLeaves) {
    for (const double angle : {0.0, 1e-4, 0.3, 2.0, 3.0}) {
        for (const NurbsSurface& other : {leaf(angle), leaf(angle).swapped(), leaf(angle).u_reversed()}) {
            const EdgeSmoothness edge = of_shared_edge({leaf(std::numbers::pi), other});
            EXPECT_NEAR(edge.bend, angle, 1e-12);
            EXPECT_EQ(edge.smooth(1e-3), angle < 1e-3);
            EXPECT_NEAR(edge.curvature, 0.0, 1e-12);
        }
    }
}

TEST(EdgeSmoothness, CurvatureJumpsFromPlaneToCylinder) {
    for (const double r : {0.5, 1.0, 40.0}) {
        for (const NurbsSurface& plane : {leaf(std::numbers::pi), leaf(std::numbers::pi).swapped()}) {
            const EdgeSmoothness edge = of_shared_edge({plane, quarter(r)});
            EXPECT_LE(edge.bend, 1e-12);
            EXPECT_NEAR(edge.curvature_jump, 1 / r, 1e-11 / r);
            EXPECT_NEAR(edge.curvature, 1 / r, 1e-11 / r);
        }
    }
}

TEST(EdgeSmoothness, OneSmoothSurfaceCutInTwoHasNoJump) {
    // The graph of one cubic over [-2, 0] x [-1, 1] and [0, 2] x [-1, 1].
    const auto half = [](double middle) {
        const NurbsSurface graph = support::graph_patch(3, 3, [&](double x, double y) {
            const double at = x + middle;
            return 0.4 * at * at + 0.2 * at * at * at - 0.3 * at * y * y + 0.5 * at * y;
        });
        SimilarityTransform shift;
        shift.translation = Vector3(middle, 0, 0);
        return support::transformed(graph, shift);
    };
    const EdgeSmoothness edge = of_shared_edge({half(-1), half(1).swapped()});
    EXPECT_LE(edge.bend, 1e-12);
    EXPECT_LE(edge.curvature_jump, 1e-11);
    EXPECT_GT(edge.curvature, 0.1);
}

}  // namespace
}  // namespace umbilic
