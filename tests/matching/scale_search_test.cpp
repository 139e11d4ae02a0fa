// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/scale_search.h>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace umbilic {
namespace {

double parabola(double x) {
    return (x - 0.7) * (x - 0.7) + 2.0;
}

TEST(ScaleSearch, GoldenSectionKeepsTheGoldenShareOfTheBracket) {
    const Minimum found = golden_section_minimum(parabola, -1.0, 3.0, 1e-6);
    EXPECT_NEAR(found.at, 0.7, 1e-6);
    double before = 4.0;
    for (const double length : found.lengths) {
        EXPECT_NEAR(length / before, 0.5 * (std::sqrt(5.0) - 1.0), 1e-6);
        before = length;
    }
    EXPECT_LE(before, 1e-6);
    // 4 * 0.618^n <= 1e-6, one evaluation a step and two to begin with.
    EXPECT_EQ(found.evaluations, 2 + static_cast<int>(std::ceil(std::log(4e6) / std::log(1.6180339887))));
}

TEST(ScaleSearch, GoldenSectionHoldsAtTheEndsAndOnKinks) {
    EXPECT_NEAR(golden_section_minimum([](double x) { return x; }, 1.0, 2.0, 1e-8).at, 1.0, 1e-8);
    EXPECT_NEAR(golden_section_minimum([](double x) { return -x; }, 1.0, 2.0, 1e-8).at, 2.0, 1e-8);
    EXPECT_NEAR(golden_section_minimum([](double x) { return std::abs(x - 1.3); }, 1.0, 2.0, 1e-8).at, 1.3, 1e-8);
}

TEST(ScaleSearch, BrentNeedsFewerSteps) {
    const Minimum golden = golden_section_minimum(parabola, -1.0, 3.0, 1e-6),
                  brent = brent_minimum(parabola, -1.0, 3.0, 1e-6);
    EXPECT_NEAR(brent.at, 0.7, 1e-6);
    EXPECT_LT(brent.evaluations, golden.evaluations / 2);
}

TEST(ScaleSearch, ScanFindsTheLowestOfSeveralMinima) {
    // Minima near every whole number, lowest near 2.
    const auto f = [](double x) { return std::abs(x - 2.1) - 0.5 * std::cos(2 * std::numbers::pi * x); };
    const auto minima =
        scanned_minima(f, -1.0, 5.0, 61, 3, [&](double a, double b) { return golden_section_minimum(f, a, b, 1e-9); });
    ASSERT_EQ(minima.size(), 3u);
    // Near 2 the slope of the cosine outweighs the modulus: pi sin(2 pi x) = 1.
    EXPECT_NEAR(minima[0].at, 2.0 + std::asin(1 / std::numbers::pi) / (2 * std::numbers::pi), 1e-7);
    EXPECT_LT(minima[0].value, minima[1].value);
    EXPECT_LT(minima[1].value, minima[2].value);
}

}  // namespace
}  // namespace umbilic
