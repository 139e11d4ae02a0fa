// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/axis_hull.h>

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

namespace umbilic {
namespace {

using Exact = boost::multiprecision::cpp_rational;

struct ExactHull {
    Exact low, high;
};

/// All pairs of end points: the hull of a finite set meets a line in the hull of the pairs' crossings.
std::optional<ExactHull> exact_hull(const std::vector<Interval>& columns) {
    std::optional<ExactHull> result;
    const int degree = static_cast<int>(columns.size()) - 1;
    const auto add = [&](const Exact& x) {
        if (!result) result = ExactHull{x, x};
        if (x < result->low) result->low = x;
        if (x > result->high) result->high = x;
    };
    for (int i = 0; i <= degree; ++i)
        for (const double y : {columns[i].low, columns[i].high})
            for (int j = 0; j <= degree; ++j)
                for (const double z : {columns[j].low, columns[j].high}) {
                    const Exact a = y, b = z;
                    if (a == 0) add(Exact(i) / degree);
                    if ((a < 0 && b > 0) || (a > 0 && b < 0)) add((i + (j - i) * (a / (a - b))) / degree);
                }
    return result;
}

TEST(AxisHull, HoldsTheExactHullAndLittleMore) {
    std::mt19937_64 engine(11);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    int missed = 0;
    for (int k = 0; k < 5000; ++k) {
        const int degree = 1 + k % 9;
        const double shift = 1.2 * number(engine), slope = 2.0 * number(engine);
        std::vector<Interval> columns;
        for (int i = 0; i <= degree; ++i) {
            const double y = shift + slope * i / degree + 0.3 * number(engine);
            const double half = k % 3 == 0 ? 0.0 : 0.1 * std::abs(number(engine));
            columns.emplace_back(y - half, y + half);
        }
        const std::optional<ExactHull> wanted = exact_hull(columns);
        const std::optional<Interval> found = axis_hull(columns);
        if (!wanted) {
            // Rounding may only keep too much.
            ++missed;
            EXPECT_FALSE(found);
            continue;
        }
        ASSERT_TRUE(found);
        EXPECT_LE(Exact(found->low), wanted->low);
        EXPECT_GE(Exact(found->high), wanted->high);
        EXPECT_NEAR(found->low, static_cast<double>(wanted->low), 1e-14);
        EXPECT_NEAR(found->high, static_cast<double>(wanted->high), 1e-14);
    }
    EXPECT_GT(missed, 500);
    EXPECT_LT(missed, 4500);
}

TEST(AxisHull, TouchingAnEndKeepsIt) {
    const std::optional<Interval> left = axis_hull(std::vector<Interval>{{0.0, 0.0}, {1.0, 2.0}, {1.0, 3.0}});
    ASSERT_TRUE(left);
    EXPECT_EQ(left->low, 0.0);
    EXPECT_LT(left->high, 1e-14);
    const std::optional<Interval> right = axis_hull(std::vector<Interval>{{-3.0, -2.0}, {-1.0, -1.0}, {-1.0, 0.0}});
    ASSERT_TRUE(right);
    EXPECT_GT(right->low, 1.0 - 1e-14);
    EXPECT_EQ(right->high, 1.0);
}

TEST(AxisHull, OneColumn) {
    EXPECT_FALSE(axis_hull(std::vector<Interval>{{1.0, 2.0}}));
    EXPECT_FALSE(axis_hull(std::vector<Interval>{{-2.0, -1.0}}));
    const std::optional<Interval> all = axis_hull(std::vector<Interval>{{-1.0, 1.0}});
    ASSERT_TRUE(all);
    EXPECT_EQ(all->low, 0.0);
    EXPECT_EQ(all->high, 1.0);
}

}  // namespace
}  // namespace umbilic
