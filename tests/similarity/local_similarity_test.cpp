// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <support/surfaces.h>
#include <umbilic/similarity/local_similarity.h>

namespace umbilic {
namespace {

NodeComparison node_at(double u, double v, double distance, double weight = 1.0) {
    NodeComparison result;
    result.at = {1, u, v};
    result.distance = distance;
    result.weight = weight;
    return result;
}

Model one_face() {
    return support::model_of({support::smooth_bicubic(6, 1)});
}

TEST(LocalSimilarity, ThesisExampleOf31MarkedCellsOf400) {
    std::vector<NodeComparison> nodes;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            nodes.push_back(node_at((i + 0.5) / 20, (j + 0.5) / 20, nodes.size() < 31 ? 0.02 : 0.005));
    const LocalSimilarity result = local_similarity(one_face(), nodes, Quantity::distance, 0.01, 0.05);
    EXPECT_EQ(result.cells, 400);
    EXPECT_EQ(result.marked, 31);
    EXPECT_DOUBLE_EQ(result.cell_percent, 92.25);
    EXPECT_DOUBLE_EQ(result.percent, 92.25);
    EXPECT_DOUBLE_EQ(result.tolerance, 0.01);
}

TEST(LocalSimilarity, ValuesAreNotDividedByTheirMaximum) {
    const std::vector<NodeComparison> nodes = {node_at(0.1, 0.1, 1e-9), node_at(0.9, 0.9, 2e-9)};
    EXPECT_EQ(local_similarity(one_face(), nodes, Quantity::distance, 0.01, 0.05).percent, 100.0);
}

TEST(LocalSimilarity, CellsWithoutNodesDoNotCount) {
    const std::vector<NodeComparison> nodes = {node_at(0.1, 0.1, 1.0), node_at(0.9, 0.9, 0.0)};
    const LocalSimilarity result = local_similarity(one_face(), nodes, Quantity::distance, 0.01, 0.05);
    EXPECT_EQ(result.cells, 2);
    EXPECT_DOUBLE_EQ(result.cell_percent, 50.0);
}

TEST(LocalSimilarity, OneNodeBeyondTheToleranceMarksItsCellButOnlyItsOwnArea) {
    const std::vector<NodeComparison> nodes = {node_at(0.51, 0.51, 0.0, 3.0), node_at(0.52, 0.52, 1.0, 1.0)};
    const LocalSimilarity result = local_similarity(one_face(), nodes, Quantity::distance, 0.01, 0.05);
    EXPECT_EQ(result.cells, 1);
    EXPECT_DOUBLE_EQ(result.cell_percent, 0.0);
    EXPECT_DOUBLE_EQ(result.percent, 75.0);
}

TEST(LocalSimilarity, UpperBordersOfTheDomainBelongToTheLastCells) {
    const std::vector<NodeComparison> nodes = {node_at(1.0, 1.0, 0.0), node_at(0.99, 0.99, 0.0)};
    EXPECT_EQ(local_similarity(one_face(), nodes, Quantity::distance, 0.01, 0.05).cells, 1);
}

TEST(LocalSimilarity, QuantityThatIsNowhereDefinedHasNoCells) {
    const std::vector<NodeComparison> nodes = {node_at(0.1, 0.1, 0.0)};
    EXPECT_EQ(local_similarity(one_face(), nodes, Quantity::direction, 0.01, 0.05).cells, 0);
}

}  // namespace
}  // namespace umbilic
