// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <similarity/shapes.h>
#include <support/surfaces.h>
#include <umbilic/similarity/nodes.h>

namespace umbilic {
namespace {

constexpr double delta_0 = 0.01;

/// A node of one model and its foot on another, compared where both models are as they stand.
NodeComparison compared(const PreparedModel& model, const Vector2& node, const PreparedModel& other,
                        const Vector2& foot) {
    const auto curvature_at = [](const PreparedModel& prepared, const Vector2& at) {
        const Face& face = prepared.model.faces.front();
        const Curvature c = curvature(face.surface, at.x(), at.y());
        return face.reversed ? flipped(c) : c;
    };
    const Curvature here = curvature_at(model, node), there = curvature_at(other, foot);
    const NodeSet nodes{.nodes = {{{1, node.x(), node.y()}, here, 1.0}}};
    const Feet feet{.nodes = {here.point},
                    .feet = {{.at = {1, foot.x(), foot.y()},
                              .point = there.point,
                              .distance = (there.point - here.point).norm(),
                              .kind = FootKind::interior}}};
    const PlacedModel placed{.prepared = model, .is_original = true}, placed_other{.prepared = other};
    return compare_nodes(placed, nodes, placed_other, feet, {.distance = delta_0, .kappa = 1e-6}).nodes.front();
}

/// The half-flat sheet with u running the other way: a parameter on its knot line belongs to the other side there.
Model backwards_half_flat() {
    const NurbsSurface surface = test::half_flat();
    std::vector<Vector3> poles;
    for (int i = 3; i >= 0; --i)
        for (int j = 0; j < 2; ++j) poles.push_back(surface.poles()[2 * i + j]);
    Model model = support::model_of({NurbsSurface(surface.u_knots(), surface.v_knots(), poles)});
    model.faces.front().reversed = true;
    return model;
}

TEST(Nodes, OnAKnotLineWhereCurvatureJumpsAreComparedOnOneSide) {
    const Model model = support::model_of({test::half_flat()}), copy = backwards_half_flat();
    const PreparedModel original = test::prepared_on_grid(model, 4), suspect = test::prepared_on_grid(copy, 4);
    // The very same point, which the two descriptions put on different sides.
    const double here = curvature(model.faces[0].surface, 0.0, 0.5).kappa_max;
    const double there = -curvature(copy.faces[0].surface, 0.0, 0.5).kappa_min;
    ASSERT_NEAR(std::abs(here - there), 2.0, 1e-12);
    for (const auto& [node_on, foot_on] : {std::pair(&original, &suspect), std::pair(&suspect, &original)}) {
        const NodeComparison on_line = compared(*node_on, {0.0, 0.5}, *foot_on, {0.0, 0.5});
        ASSERT_TRUE(on_line.kappa_max && on_line.kappa_min);
        EXPECT_NEAR(*on_line.kappa_max, 0.0, 1e-12);
        EXPECT_NEAR(*on_line.kappa_min, 0.0, 1e-12);
    }
    // A foot that has slipped over the line by less than delta_0.
    const NodeComparison beside = compared(original, {1e-4, 0.5}, original, {-1e-4, 0.5});
    ASSERT_TRUE(beside.kappa_max);
    EXPECT_NEAR(*beside.kappa_max, 0.0, 1e-6);
}

TEST(Nodes, AwayFromKnotLinesCurvaturesThatDifferDiffer) {
    const Model model = support::model_of({test::half_flat()});
    const PreparedModel original = test::prepared_on_grid(model, 4);
    const NodeComparison across = compared(original, {0.2, 0.5}, original, {-0.2, 0.5});
    ASSERT_TRUE(across.kappa_max);
    EXPECT_GT(*across.kappa_max, 1.0);
}

TEST(Nodes, ThatBendMoreTightlyThanTheDistanceToleranceHaveNoCurvatureToCompare) {
    const auto with_radius = [](double radius) { return support::model_of({support::torus_quarter(3.0, radius)}); };
    const Model tight_model = with_radius(0.5 * delta_0), round_model = with_radius(2.0 * delta_0);
    const PreparedModel tight = test::prepared_on_grid(tight_model, 4), round = test::prepared_on_grid(round_model, 4);
    const Vector2 middle(0.5, 0.5);
    const NodeComparison resolved = compared(round, middle, round, middle);
    ASSERT_TRUE(resolved.kappa_max && resolved.kappa_min);
    EXPECT_NEAR(*resolved.kappa_max, 0.0, 1e-9);
    // Whether it is the node or the foot, or both.
    for (const auto& [node_on, foot_on] :
         {std::pair(&tight, &round), std::pair(&round, &tight), std::pair(&tight, &tight)}) {
        const NodeComparison unresolved = compared(*node_on, middle, *foot_on, middle);
        EXPECT_FALSE(unresolved.kappa_max || unresolved.kappa_min || unresolved.direction);
    }
}

}  // namespace
}  // namespace umbilic
