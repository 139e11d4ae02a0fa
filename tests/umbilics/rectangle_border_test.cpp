// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>

#include <umbilic/umbilics/rectangle_border.h>

namespace umbilic {
namespace {

/// Area to the left of the border (Green), after a check that every end is also a start.
double enclosed_area(const std::vector<BorderSide>& border) {
    std::map<std::pair<double, double>, int> balance;
    double area = 0.0;
    for (const BorderSide& side : border) {
        EXPECT_TRUE(side.from.x() == side.to.x() || side.from.y() == side.to.y());
        ++balance[{side.from.x(), side.from.y()}];
        --balance[{side.to.x(), side.to.y()}];
        area += 0.5 * (side.from.x() * side.to.y() - side.to.x() * side.from.y());
    }
    for (const auto& [point, count] : balance) EXPECT_EQ(count, 0) << point.first << ' ' << point.second;
    return area;
}

TEST(RectangleBorder, OneRectangleRunsCounterClockwise) {
    const ParameterBox box{{1, 3}, {2, 7}};
    const std::vector<BorderSide> border = border_of_difference({&box, 1}, {});
    EXPECT_EQ(border.size(), 4u);
    EXPECT_EQ(enclosed_area(border), 10.0);
}

TEST(RectangleBorder, OverlapsCountOnceAndHolesRunTheOtherWay) {
    const std::vector<ParameterBox> kept{{{0, 4}, {0, 4}}, {{3, 5}, {1, 2}}};
    EXPECT_EQ(enclosed_area(border_of_difference(kept, {})), 17.0);
    const std::vector<ParameterBox> removed{{{1, 2}, {1, 2}}, {{1.5, 2.5}, {1, 2}}, {{-1, 0.5}, {3, 9}}};
    EXPECT_EQ(enclosed_area(border_of_difference(kept, removed)), 17.0 - 1.5 - 0.5);
    EXPECT_TRUE(border_of_difference(kept, kept).empty());
    EXPECT_TRUE(border_of_difference({}, removed).empty());
}

TEST(RectangleBorder, RandomSetsHaveTheAreaOfTheirCells) {
    std::mt19937 random(5);
    constexpr int cells = 12;
    std::uniform_int_distribution<int> coordinate(0, cells);
    const auto boxes = [&](int count) {
        std::vector<ParameterBox> result;
        for (int k = 0; k < count; ++k) {
            const auto interval = [&] {
                const int a = coordinate(random), b = coordinate(random);
                return ParameterInterval{static_cast<double>(std::min(a, b)), static_cast<double>(std::max(a, b))};
            };
            result.push_back({interval(), interval()});
        }
        return result;
    };
    for (int round = 0; round < 200; ++round) {
        const std::vector<ParameterBox> kept = boxes(4), removed = boxes(4);
        double area = 0.0;
        for (int i = 0; i < cells; ++i)
            for (int j = 0; j < cells; ++j) {
                const auto holds = [&](const ParameterBox& box) { return box.contains(i + 0.5, j + 0.5); };
                area +=
                    std::any_of(kept.begin(), kept.end(), holds) && std::none_of(removed.begin(), removed.end(), holds);
            }
        EXPECT_EQ(enclosed_area(border_of_difference(kept, removed)), area);
    }
}

}  // namespace
}  // namespace umbilic
