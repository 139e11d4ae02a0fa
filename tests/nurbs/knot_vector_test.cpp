// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include <umbilic/core/errors.h>
#include <umbilic/nurbs/knot_vector.h>

namespace umbilic {
namespace {

TEST(KnotVector, SaysWhatIsWrong) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(KnotVector(0, {0, 1}), InvalidInput);
    EXPECT_THROW(KnotVector(26, std::vector<double>(54, 0.0)), InvalidInput);
    EXPECT_THROW(KnotVector(3, {0, 0, 0, 0, 1, 1, 1}), InvalidInput);
    EXPECT_THROW(KnotVector(2, {0, 0, 0, 0.6, 0.5, 1, 1, 1}), InvalidInput);
    EXPECT_THROW(KnotVector(2, {0, 0, 0, nan, 1, 1, 1}), InvalidInput);
    EXPECT_THROW(KnotVector(2, {0, 0, 0, 0, 0, 0}), InvalidInput);
    EXPECT_THROW(KnotVector(2, {0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1}), InvalidInput);
    try {
        KnotVector(2, {0, 0, 0, 0.6, 0.5, 1, 1, 1});
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("knot 4"), std::string::npos) << error.what();
    }
}

TEST(KnotVector, SpansFollowTheSideAtAKnot) {
    const KnotVector knots(2, {0, 0, 0, 0.25, 0.5, 0.5, 1, 1, 1});
    EXPECT_EQ(knots.span(0.0), 2);
    EXPECT_EQ(knots.span(0.25), 3);
    EXPECT_EQ(knots.span(0.25, Side::left), 2);
    EXPECT_EQ(knots.span(0.5), 5);
    EXPECT_EQ(knots.span(0.5, Side::left), 3);
    EXPECT_EQ(knots.span(1.0), 5);
    EXPECT_EQ(knots.span(0.0, Side::left), 2);
    EXPECT_EQ(knots.span(-1.0), 2);
    EXPECT_EQ(knots.span(2.0, Side::left), 5);
}

TEST(KnotVector, BreaksCarryTheContinuity) {
    const KnotVector knots(3, {0, 0, 0, 0, 0.25, 0.5, 0.5, 0.75, 0.75, 0.75, 1, 1, 1, 1});
    EXPECT_EQ(knots.breaks(), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
    EXPECT_EQ(knots.continuity(0), -1);
    EXPECT_EQ(knots.continuity(1), 2);
    EXPECT_EQ(knots.continuity(2), 1);
    EXPECT_EQ(knots.continuity(3), 0);
    EXPECT_EQ(knots.continuity(4), -1);
}

TEST(KnotVector, UnclampedDomainLiesBetweenTheInnerKnots) {
    const KnotVector knots(2, {-2, -1, 0, 1, 2, 3, 4});
    EXPECT_DOUBLE_EQ(knots.domain().low, 0.0);
    EXPECT_DOUBLE_EQ(knots.domain().high, 2.0);
    EXPECT_EQ(knots.breaks().size(), 3u);
}

/// Row k of the basis must be the k-th derivative: checked by the partition of unity and by differences of row k - 1.
TEST(KnotVector, BasisSumsToOneAndRowsAreDerivatives) {
    for (const int degree : {1, 2, 3, 5, 8, 25}) {
        std::vector<double> values(degree + 1, 0.0);
        for (const double inner : {0.2, 0.35, 0.7}) values.push_back(inner);
        values.insert(values.end(), degree + 1, 1.0);
        const KnotVector knots(degree, values);
        for (const double u : {0.05, 0.21, 0.5, 0.69, 0.93}) {
            const int span = knots.span(u);
            const double h = 1e-5;
            std::array<double, 5 * 26> here, before, after;
            knots.basis(span, u, 4, here.data());
            knots.basis(span, u - h, 4, before.data());
            knots.basis(span, u + h, 4, after.data());
            for (int k = 0; k <= 4; ++k) {
                double sum = 0.0, magnitude = 0.0;
                for (int j = 0; j <= degree; ++j) {
                    sum += here[k * (degree + 1) + j];
                    magnitude += std::abs(here[k * (degree + 1) + j]);
                }
                EXPECT_NEAR(sum, k == 0 ? 1.0 : 0.0, 1e-12 * (1 + magnitude)) << degree << ' ' << u << ' ' << k;
                if (k == 0) continue;
                for (int j = 0; j <= degree; ++j) {
                    const int at = (k - 1) * (degree + 1) + j;
                    EXPECT_NEAR(here[k * (degree + 1) + j], (after[at] - before[at]) / (2 * h), 1e-5 * (1 + magnitude))
                        << degree << ' ' << u << ' ' << k;
                }
            }
        }
    }
}

}  // namespace
}  // namespace umbilic
