// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/wireframe/border_nodes.h>

namespace umbilic {
namespace {

/// Two halves of a graph that share the border x = 0.5, on which their knots and degrees differ.
Model halves() {
    const auto height = [](double x, double y) { return 0.3 * std::sin(2 * x) + 0.2 * y * y * x; };
    const NurbsSurface left = support::graph_patch(6, 2, [&](double s, double t) { return height(s - 1, t); });
    const NurbsSurface right = support::graph_patch(7, 3, [&](double s, double t) { return height(s + 1, t); });
    SimilarityTransform to_left, to_right;
    to_left.translation = Vector3(-1, 0, 0);
    to_right.translation = Vector3(1, 0, 0);
    return support::model_of({support::transformed(left, to_left), support::transformed(right, to_right)});
}

TEST(BorderNodes, AreTheSamePointsOnBothSides) {
    const Model model = halves();
    const FaceAdjacency adjacency = face_adjacency(model, {.tolerance = 1e-3});
    const std::vector<FaceBorder> borders = border_nodes(adjacency, {.step = 0.17});
    ASSERT_EQ(borders.size(), 2u);
    int shared = 0;
    for (const BorderNode& node : borders[0].loops[0])
        for (const BorderNode& other : borders[1].loops[0]) {
            if (node.edge != other.edge || (node.point - other.point).norm() > 1e-9) continue;
            ++shared;
            const Vector3 p = model.faces[1].surface.value(other.parameters.x(), other.parameters.y());
            EXPECT_LT((p - node.point).norm(), 1e-3);
        }
    EXPECT_GE(shared, 10);
}

TEST(BorderNodes, DivideEdgesIntoEqualParts) {
    const double major = 3, minor = 1, step = 0.1;
    const Model model = support::model_of({support::torus_quarter(major, minor)});
    const FaceAdjacency adjacency = face_adjacency(model);
    const std::vector<FaceBorder> borders = border_nodes(adjacency, {.step = step});
    ASSERT_EQ(borders[0].loops.size(), 1u);
    double length = 0.0;
    for (const BorderNode& node : borders[0].loops[0]) {
        EXPECT_LE(node.length, longest_stretch * step);
        EXPECT_EQ(node.kind, BorderKind::border);
        length += node.length;
    }
    // Meridians of the minor radius at both ends, parallels of the radii 4 and 3.
    const double quarter = std::numbers::pi / 2;
    EXPECT_NEAR(length, quarter * (2 * minor + (major + minor) + major), 1e-6);
    // On a circle equal parts have equal chords.
    for (std::size_t i = 0; i + 1 < borders[0].loops[0].size(); ++i) {
        const BorderNode &a = borders[0].loops[0][i], &b = borders[0].loops[0][i + 1];
        if (std::abs(a.point.z()) > 1e-12 || std::abs(b.point.z()) > 1e-12) continue;
        EXPECT_NEAR((a.point - b.point).norm(), 2 * (major + minor) * std::sin(a.length / (2 * (major + minor))), 1e-6);
    }
}

TEST(BorderNodes, MeetAtAPole) {
    const Model model = support::model_of({support::ellipsoid_octant(3, 2, 1)});
    const FaceAdjacency adjacency = face_adjacency(model);
    const FaceBorder border = border_nodes(adjacency, {.step = 0.2}).front();
    int poles = 0, at_pole = 0;
    for (const BorderNode& node : border.loops[0]) {
        poles += node.kind == BorderKind::pole;
        at_pole += (node.point - Vector3(0, 0, 1)).norm() < 1e-9;
    }
    EXPECT_EQ(poles, 1);
    EXPECT_EQ(at_pole, 2);
    EXPECT_EQ(border.identities, static_cast<int>(border.loops[0].size()) - 1);
}

/// On a piece a few roundings wide the tangent is noise: it must not count as a turn.
TEST(BorderNodes, DoNotDependOnKnotsAFewRoundingsApart) {
    const NurbsSurface surface = support::torus_quarter(3, 1);
    const ParameterBox domain = surface.domain();
    const auto knots = [&](const ParameterInterval& range, int degree) {
        const double middle = range.middle();
        std::vector<double> result(degree, middle);
        result.insert(result.end(), degree,
                      middle + 8 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(middle)));
        return result;
    };
    const NurbsSurface cut =
        support::with_knots(surface, knots(domain.u, surface.u_degree()), knots(domain.v, surface.v_degree())).surface;
    const Model model = support::model_of({surface}), copy = support::model_of({cut});
    // Few parts by length, so that the turn decides.
    const BorderNodeOptions options{.step = 10.0};
    const FaceBorder border = border_nodes(face_adjacency(model), options).front();
    const FaceBorder other = border_nodes(face_adjacency(copy), options).front();
    ASSERT_EQ(other.loops[0].size(), border.loops[0].size());
    for (std::size_t i = 0; i < border.loops[0].size(); ++i)
        EXPECT_LT((other.loops[0][i].point - border.loops[0][i].point).norm(), 1e-9);
}

}  // namespace
}  // namespace umbilic
