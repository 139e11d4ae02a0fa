// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <umbilic/similarity/statistics.h>
#include <umbilic/similarity/thresholds.h>

namespace umbilic {
namespace {

NodeComparison node(double distance, double weight, std::optional<double> kappa_max = {}) {
    NodeComparison result;
    result.distance = distance;
    result.weight = weight;
    result.kappa_max = kappa_max;
    return result;
}

TEST(Statistics, EqualWeightsGiveTheTextbookValues) {
    const std::vector<NodeComparison> nodes = {node(2, 1), node(4, 1), node(4, 1), node(4, 1),
                                               node(5, 1), node(5, 1), node(7, 1), node(9, 1)};
    const Statistics s = statistics(nodes, Quantity::distance);
    EXPECT_EQ(s.count, 8);
    EXPECT_DOUBLE_EQ(s.max, 9.0);
    EXPECT_DOUBLE_EQ(s.mean, 5.0);
    EXPECT_DOUBLE_EQ(s.standard_deviation, 2.0);
}

TEST(Statistics, AWeightCountsLikeSoManyNodes) {
    const std::vector<NodeComparison> weighted = {node(1, 3), node(5, 1)};
    const std::vector<NodeComparison> repeated = {node(1, 1), node(1, 1), node(1, 1), node(5, 1)};
    const Statistics a = statistics(weighted, Quantity::distance), b = statistics(repeated, Quantity::distance);
    EXPECT_DOUBLE_EQ(a.mean, b.mean);
    EXPECT_DOUBLE_EQ(a.standard_deviation, b.standard_deviation);
    EXPECT_EQ(a.count, 2);
}

TEST(Statistics, NodesWithoutTheQuantityAndBeyondTheLimitAreLeftOut) {
    const std::vector<NodeComparison> nodes = {node(0.1, 1, 3.0), node(0.2, 1), node(10.0, 1, 100.0)};
    const Statistics s = statistics(nodes, Quantity::kappa_max, 1.0);
    EXPECT_EQ(s.count, 1);
    EXPECT_DOUBLE_EQ(s.max, 3.0);
    EXPECT_DOUBLE_EQ(s.standard_deviation, 0.0);
    EXPECT_EQ(statistics(nodes, Quantity::direction).count, 0);
}

TEST(Statistics, SpreadOfNearlyEqualLargeValuesDoesNotCancel) {
    const std::vector<NodeComparison> nodes = {node(1e9, 1), node(1e9 + 1, 1), node(1e9 + 2, 1)};
    EXPECT_NEAR(statistics(nodes, Quantity::distance).standard_deviation, std::sqrt(2.0 / 3.0), 1e-6);
}

TEST(Thresholds, MeanAndSpreadEachCanFail) {
    EXPECT_TRUE(within_thresholds({.max = 9, .mean = 1.0, .standard_deviation = 1.0, .count = 5}, 1.0));
    EXPECT_FALSE(within_thresholds({.max = 9, .mean = 1.001, .standard_deviation = 0.0, .count = 5}, 1.0));
    EXPECT_FALSE(within_thresholds({.max = 9, .mean = 0.5, .standard_deviation = 1.26, .count = 5}, 1.0));
    EXPECT_FALSE(within_thresholds({}, 1.0)) << "no node is no evidence";
    EXPECT_FALSE(within_maximum({}, 1.0));
}

}  // namespace
}  // namespace umbilic
