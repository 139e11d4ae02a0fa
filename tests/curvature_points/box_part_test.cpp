// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/box_part.h>

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace umbilic {
namespace {

const ParameterBox unit{{0.0, 1.0}, {0.0, 1.0}};

double area(const BoxPart& part) {
    double result = 0.0;
    for (std::size_t k = 0; k < part.corners.size(); ++k) {
        const Vector2 &a = part.corners[k], &b = part.corners[(k + 1) % part.corners.size()];
        result += 0.5 * (a.x() * b.y() - b.x() * a.y());
    }
    return result;
}

TEST(BoxPart, ADiagonalBandTouchesAllSidesOfItsBox) {
    // |u - v| <= 1/4: the square without two triangles of legs 3/4.
    const LinearBand diagonal{{1.0, -1.0}, 0.0, 0.25};
    const auto part = part_within(unit, {&diagonal, 1});
    ASSERT_TRUE(part);
    EXPECT_NEAR(area(*part), 1.0 - 0.75 * 0.75, 1e-15);
    const std::vector<ParameterBox> touched = contacts(*part);
    ASSERT_EQ(touched.size(), 4u);
    EXPECT_EQ(touched[0].u.high, 0.0);
    EXPECT_NEAR(touched[0].v.high, 0.25, 1e-15);
    EXPECT_EQ(touched[1].u.low, 1.0);
    EXPECT_NEAR(touched[1].v.low, 0.75, 1e-15);
    EXPECT_TRUE(contains(*part, 0.5, 0.74));
    EXPECT_FALSE(contains(*part, 0.5, 0.76));
}

TEST(BoxPart, BandsThatCrossInsideTouchNoSide) {
    const LinearBand bands[] = {{{2.0, 1.0}, -1.5, 0.05}, {{-1.0, 3.0}, -1.0, 0.1}};
    const auto part = part_within(unit, bands);
    ASSERT_TRUE(part);
    // The parallelogram's area is 4 w1 w2 / |det|, its centre the crossing of the middle lines.
    EXPECT_NEAR(area(*part), 4 * 0.05 * 0.1 / 7.0, 1e-15);
    const ParameterBox box = extent(*part);
    EXPECT_NEAR(box.u.middle(), 0.5, 1e-15);
    EXPECT_NEAR(box.v.middle(), 0.5, 1e-15);
    EXPECT_TRUE(contacts(*part).empty());
}

TEST(BoxPart, NothingIsLeftOfABandThatMissesTheBox) {
    const LinearBand beside{{1.0, 1.0}, -2.3, 0.2};
    EXPECT_FALSE(part_within(unit, {&beside, 1}));
    const LinearBand everything{{1.0, 1.0}, -2.3, std::numeric_limits<double>::infinity()};
    const auto part = part_within(unit, {&everything, 1});
    ASSERT_TRUE(part);
    EXPECT_EQ(area(*part), 1.0);
}

TEST(BoxPart, AWholeBoxTouchesAsItself) {
    const BoxPart whole{{{0.25, 0.5}, {0.5, 0.75}}, {}};
    ASSERT_EQ(contacts(whole).size(), 1u);
    EXPECT_EQ(contacts(whole)[0].u.low, 0.25);
    EXPECT_TRUE(contains(whole, 0.3, 0.6));
    EXPECT_FALSE(contains(whole, 0.6, 0.6));
}

TEST(BoxPart, HoldsThePointsOfItsBandsAlsoWhenMapped) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const ParameterBox box{{0.125, 0.1875}, {0.5, 0.75}};
    const Vector2 origin(3.1, -7.3), scale(0.7, 11.0);
    int inside = 0, empty = 0;
    for (int trial = 0; trial < 500; ++trial) {
        LinearBand bands[2];
        for (LinearBand& band : bands)
            band = {{uniform(random), uniform(random)}, uniform(random), std::abs(uniform(random))};
        const auto part = part_within(box, bands);
        empty += !part;
        for (int k = 0; k < 50; ++k) {
            const Vector2 t = 0.5 * Vector2(1.0 + uniform(random), 1.0 + uniform(random));
            double farthest = -std::numeric_limits<double>::infinity();
            for (const LinearBand& band : bands)
                farthest = std::max(farthest, std::abs(band.slope.dot(t) + band.offset) - band.half_width);
            if (std::abs(farthest) < 1e-9) continue;
            const double u = box.u.low + t.x() * box.u.length(), v = box.v.low + t.y() * box.v.length();
            ASSERT_EQ(part && contains(*part, u, v), farthest < 0.0) << trial;
            if (!part) continue;
            const BoxPart moved = mapped(*part, origin, scale);
            ASSERT_EQ(contains(moved, origin.x() + u * scale.x(), origin.y() + v * scale.y()), farthest < 0.0) << trial;
            if (farthest < 0.0) {
                ++inside;
                EXPECT_TRUE(extent(*part).contains(u, v));
            }
        }
        if (!part) continue;
        // Sides stay sides under the map, to the last bit.
        EXPECT_EQ(contacts(mapped(*part, origin, scale)).size(), contacts(*part).size());
    }
    EXPECT_GT(inside, 1000);
    EXPECT_GT(empty, 10);
}

}  // namespace
}  // namespace umbilic
