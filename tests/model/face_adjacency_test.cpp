// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include <umbilic/core/errors.h>
#include <umbilic/model/face_adjacency.h>

#include <support/surfaces.h>

namespace umbilic {
namespace {

double height(double x, double y) {
    return 0.3 * x * x - 0.2 * x * y * y + 0.1 * y;
}

/// The graph of `height` over [x0, x1] x [y0, y1] as a Bezier patch.
NurbsSurface piece(double x0, double x1, double y0, double y1) {
    const auto x = [=](double u) { return 0.5 * (x0 + x1) + 0.5 * (x1 - x0) * u; };
    const auto y = [=](double v) { return 0.5 * (y0 + y1) + 0.5 * (y1 - y0) * v; };
    const NurbsSurface graph = support::graph_patch(3, 3, [&](double u, double v) { return height(x(u), y(v)); });
    std::vector<Vector3> poles;
    for (const Vector3& pole : graph.poles()) poles.emplace_back(x(pole.x()), y(pole.y()), pole.z());
    return NurbsSurface(graph.u_knots(), graph.v_knots(), poles);
}

int shared(const FaceAdjacency& adjacency) {
    int count = 0;
    for (const Edge& edge : adjacency.edges) count += edge.uses.size() == 2;
    return count;
}

/// Point of the face's border at the parameters (u, v), and its other side.
EdgeCrossing only_crossing(const FaceAdjacency& adjacency, const Model& model, int face, double u, double v) {
    const BorderPoint border = nearest_in_parameters(model.face(face), adjacency.borders.loops_of(face), Vector2(u, v));
    EXPECT_LE(border.distance, 1e-14);
    const std::vector<EdgeCrossing> crossings = across(adjacency, border);
    EXPECT_EQ(crossings.size(), 1u);
    return crossings.at(0);
}

TEST(FaceAdjacency, TwoHalvesShareOneEdgeWhateverTheirParameters) {
    const NurbsSurface left = piece(-1, 0.25, -1, 1), right = piece(0.25, 1, -1, 1);
    const Model model = support::model_of({left, right.swapped().u_reversed()});
    const FaceAdjacency adjacency = face_adjacency(model);
    ASSERT_EQ(adjacency.edges.size(), 7u);
    EXPECT_EQ(shared(adjacency), 1);
    ASSERT_EQ(adjacency.shells.size(), 1u);
    EXPECT_FALSE(adjacency.shells[0].closed);
    EXPECT_EQ(adjacency.shells[0].vertices, 6);
    EXPECT_EQ(adjacency.shells[0].euler_characteristic, 1);

    const double domain = left.domain().v.length();
    for (const double share : {0.1, 0.37, 0.8}) {
        const double v = left.domain().v.low + share * domain;
        const EdgeCrossing crossing = only_crossing(adjacency, model, 1, left.domain().u.high, v);
        EXPECT_EQ(crossing.to.face, 2);
        EXPECT_LE((crossing.to.point - left.value(left.domain().u.high, v)).norm(), 1e-14);
        const Vector3 there = model.faces[1].surface.value(crossing.to.parameters.x(), crossing.to.parameters.y());
        EXPECT_LE((crossing.to.point - there).norm(), 1e-14);
        // The right face begins at its v = low: swapped, then run backwards.
        EXPECT_NEAR(crossing.to.parameters.y(), right.domain().u.low, 1e-13);
        EXPECT_NEAR(crossing.to.parameters.x(), right.domain().v.low + (1 - share) * right.domain().v.length(), 1e-12);
        EXPECT_EQ(crossing.same_direction, crossing.from.tangent.dot(crossing.to.tangent) > 0.0);
        EXPECT_TRUE(crossing.from_on_left);
    }
    const BorderPoint free = nearest_in_parameters(model.faces[0], adjacency.borders.loops_of(1),
                                                   Vector2(left.domain().u.low, left.domain().v.middle()));
    EXPECT_TRUE(across(adjacency, free).empty());
}

TEST(FaceAdjacency, LongBorderMeetsTwoShortOnes) {
    const Model model = support::model_of({piece(-1, 0, -1, 1), piece(0, 1, -1, 0.3), piece(0, 1, 0.3, 1)});
    const FaceAdjacency adjacency = face_adjacency(model);
    EXPECT_EQ(shared(adjacency), 3);
    EXPECT_EQ(adjacency.edges.size(), 10u);
    ASSERT_EQ(adjacency.shells.size(), 1u);
    EXPECT_EQ(adjacency.shells[0].euler_characteristic, 1);
    const ParameterBox domain = model.faces[0].surface.domain();
    const auto face_across = [&](double y) {
        return only_crossing(adjacency, model, 1, domain.u.high, domain.v.low + 0.5 * (y + 1) * domain.v.length())
            .to.face;
    };
    EXPECT_EQ(face_across(-0.5), 2);
    EXPECT_EQ(face_across(0.5), 3);
}

TEST(FaceAdjacency, EightOctantsCloseToASphere) {
    const NurbsSurface octant = support::ellipsoid_octant(3, 2, 1);
    std::vector<NurbsSurface> all;
    for (const double x : {1.0, -1.0})
        for (const double y : {1.0, -1.0})
            for (const double z : {1.0, -1.0}) {
                std::vector<Vector3> poles;
                for (const Vector3& pole : octant.poles()) poles.push_back(pole.cwiseProduct(Vector3(x, y, z)));
                all.emplace_back(octant.u_knots(), octant.v_knots(), poles, octant.weights());
            }
    const Model model = support::model_of(all);
    const FaceAdjacency adjacency = face_adjacency(model);
    ASSERT_EQ(adjacency.shells.size(), 1u);
    const Shell& shell = adjacency.shells[0];
    EXPECT_TRUE(shell.closed);
    EXPECT_EQ(shell.vertices, 6);
    EXPECT_EQ(shell.edges, 12);
    EXPECT_EQ(shell.euler_characteristic, 2);
    EXPECT_EQ(shell.faces, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}));
    for (const Edge& edge : adjacency.edges) EXPECT_LE(edge.gap, 1e-14);

    // Without one octant it is a disc.
    all.pop_back();
    const Model open = support::model_of(all);
    const FaceAdjacency with_hole = face_adjacency(open);
    ASSERT_EQ(with_hole.shells.size(), 1u);
    EXPECT_FALSE(with_hole.shells[0].closed);
    EXPECT_EQ(with_hole.shells[0].euler_characteristic, 1);
}

TEST(FaceAdjacency, FacesApartAreShellsOfTheirOwn) {
    SimilarityTransform away;
    away.translation = Vector3(2.001, 0, 0);
    const Model model = support::model_of({piece(-1, 1, -1, 1), support::transformed(piece(-1, 1, -1, 1), away)});
    EXPECT_EQ(face_adjacency(model).shells.size(), 2u);
    const FaceAdjacency alone = face_adjacency(support::model_of({}));
    EXPECT_TRUE(alone.edges.empty() && alone.shells.empty());
}

TEST(FaceAdjacency, GapsUpToTheToleranceAreBridged) {
    SimilarityTransform lift;
    lift.translation = Vector3(0, 0, 1e-3);
    const Model model = support::model_of({piece(-1, 0, -1, 1), support::transformed(piece(0, 1, -1, 1), lift)});
    EXPECT_EQ(shared(face_adjacency(model)), 0);
    EXPECT_EQ(shared(face_adjacency(model, {.tolerance = 0.9e-3})), 0);
    const FaceAdjacency bridged = face_adjacency(model, {.tolerance = 1.1e-3});
    EXPECT_EQ(shared(bridged), 1);
    // The common border has the slope 1 / 10.
    for (const Edge& edge : bridged.edges)
        EXPECT_NEAR(edge.gap, edge.uses.size() == 2 ? 1e-3 / std::hypot(1.0, 0.1) : 0.0, 1e-12);
}

TEST(FaceAdjacency, RefusesABadTolerance) {
    const Model model = support::model_of({piece(-1, 1, -1, 1)});
    for (const double bad :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_THROW(face_adjacency(model, {.tolerance = bad}), InvalidInput);
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(face_adjacency(model, {}, progress), Cancelled);
}

}  // namespace
}  // namespace umbilic
