// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <map>

#include <support/surfaces.h>
#include <umbilic/similarity/wireframe_nodes.h>

namespace umbilic {
namespace {

std::map<int, double> area_of_nodes(const NodeSet& set) {
    std::map<int, double> result;
    for (const AreaSample& node : set.nodes) result[node.at.face] += node.weight;
    return result;
}

TEST(WireframeNodes, StandForTheAreaOfEachFace) {
    const Model model = support::model_of({support::smooth_bicubic(8, 2), support::torus_quarter(3, 1)});
    const PreparedModel prepared = prepare(model);
    const int count = 2000;
    const NodeSet set = wireframe_nodes(prepared, count);
    EXPECT_EQ(set.area_faces, 0);
    EXPECT_EQ(set.of_wireframe, static_cast<int>(set.nodes.size()));
    EXPECT_NEAR(set.of_wireframe, count, 0.3 * count);
    for (const auto& [face, area] : area_of_nodes(set))
        EXPECT_NEAR(area, model.face(face).area, 1e-9 * model.face(face).area);
    // No node stands for much more than a cell.
    const double cell = (model.faces[0].area + model.faces[1].area) / count;
    for (const AreaSample& node : set.nodes) {
        EXPECT_GT(node.weight, 0.0);
        EXPECT_LT(node.weight, 4 * cell);
    }
}

TEST(WireframeNodes, LeaveNarrowFacesToAreaSamples) {
    // The second face is a hundred times smaller along each side.
    const Model model = support::model_of(
        {support::smooth_bicubic(8, 2),
         support::transformed(support::smooth_bicubic(8, 1), support::random_similarity(1, 0.01, false))});
    const PreparedModel prepared = prepare(model);
    const NodeSet set = wireframe_nodes(prepared, 500);
    EXPECT_EQ(set.area_faces, 1);
    for (const auto& [face, area] : area_of_nodes(set))
        EXPECT_NEAR(area, model.face(face).area, 1e-9 * model.face(face).area);
    EXPECT_EQ(area_of_nodes(set).size(), 2u);
}

TEST(WireframeNodes, OfAreaAreTheSamples) {
    const Model model = support::model_of({support::torus_quarter(3, 1)});
    const PreparedModel prepared = prepare(model);
    const NodeSet set = area_nodes(prepared);
    EXPECT_EQ(set.nodes.size(), prepared.features.samples.size());
    EXPECT_EQ(set.of_wireframe, 0);
}

}  // namespace
}  // namespace umbilic
