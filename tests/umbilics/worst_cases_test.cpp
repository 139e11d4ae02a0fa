// SPDX-License-Identifier: LGPL-2.1-or-later
// Bounded work and an honest answer where subdivision explodes.
#include <gtest/gtest.h>

#include <string>

#include <support/dense_umbilics.h>
#include <support/worst_cases.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

using support::Expected;
using support::WorstCase;

class WorstCases : public testing::TestWithParam<WorstCase> {};

TEST_P(WorstCases, EndInBoundedWorkWithAnHonestAnswer) {
    const WorstCase& c = GetParam();
    const FaceUmbilics found = find_umbilics(c.surface);
    EXPECT_LE(found.statistics.boxes, c.boxes);
    EXPECT_FALSE(found.statistics.budget_exhausted);
    if (found.certificate.complete) {
        EXPECT_TRUE(*found.certificate.complete) << found.certificate.why;
    }
    const ParameterBox domain = c.surface.domain();
    // What is called proved exists: Newton's method in extended precision stays there.
    for (const Umbilic& umbilic : found.umbilics) {
        const auto polished = support::polished_umbilic(c.surface, {umbilic.at.u, umbilic.at.v}, c.place_accuracy);
        ASSERT_TRUE(polished) << umbilic.at.u << ' ' << umbilic.at.v;
        EXPECT_LE(std::abs(polished->x() - umbilic.at.u), (umbilic.radius + c.place_accuracy) * domain.u.length());
        EXPECT_LE(std::abs(polished->y() - umbilic.at.v), (umbilic.radius + c.place_accuracy) * domain.v.length());
    }
    switch (c.expected) {
        case Expected::line:
            EXPECT_FALSE(found.lines.empty());
            EXPECT_TRUE(found.regions.empty());
            break;
        case Expected::region:
            EXPECT_EQ(found.regions.size(), 1u);
            break;
        case Expected::resolved:
            EXPECT_FALSE(found.umbilics.empty());
            EXPECT_TRUE(found.undecided.empty() && found.lines.empty() && found.regions.empty());
            break;
        case Expected::resolved_or_index:
            EXPECT_FALSE(found.umbilics.empty() && found.undecided.empty());
            for (const UndecidedCluster& cluster : found.undecided) EXPECT_TRUE(cluster.index);
            EXPECT_TRUE(found.lines.empty() && found.regions.empty());
            break;
        case Expected::anything_bounded:
            break;
    }
}

INSTANTIATE_TEST_SUITE_P(Umbilics, WorstCases, testing::ValuesIn(support::worst_cases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace umbilic
