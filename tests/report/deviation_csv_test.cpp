// SPDX-License-Identifier: LGPL-2.1-or-later
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <report/deviation_csv.h>

#include "made_comparison.h"

namespace umbilic {
namespace {

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_EQ(line.back(), '\r');
        line.pop_back();
        std::vector<std::string> fields{""};
        for (const char c : line) {
            if (c == ',') {
                fields.emplace_back();
            } else {
                fields.back() += c;
            }
        }
        rows.push_back(fields);
    }
    return rows;
}

TEST(DeviationCsv, HoldsEveryNodeOfBothModels) {
    const auto made = made_comparison();
    const auto rows = rows_of(deviation_csv(*made->original, *made->suspect, made->comparison.assessment));
    const auto& forward = made->comparison.assessment.suspect_on_original.nodes;
    const auto& backward = made->comparison.assessment.original_on_suspect.nodes;
    ASSERT_EQ(rows.size(), 1 + forward.size() + backward.size());
    for (const auto& row : rows) EXPECT_EQ(row.size(), rows.front().size());
    for (std::size_t i = 0; i < forward.size(); ++i) {
        const auto& row = rows[1 + i];
        EXPECT_EQ(row[0], "suspect");
        EXPECT_EQ(std::stod(row[4]), forward[i].point.x());  // shortest text that reads back as the same number
        EXPECT_EQ(std::stod(row[11]), forward[i].distance);
        EXPECT_EQ(row[13].empty(), !forward[i].kappa_max.has_value());
        EXPECT_EQ(row[15].empty(), !forward[i].direction.has_value());
    }
    EXPECT_EQ(rows.back()[0], "original");
}

TEST(DeviationCsv, IsAHeadingAloneWithoutAPose) {
    const auto made = made_comparison_without_pose();
    EXPECT_EQ(rows_of(deviation_csv(*made->original, *made->suspect, made->comparison.assessment)).size(), 1u);
}

}  // namespace
}  // namespace umbilic
