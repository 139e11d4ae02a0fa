// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <umbilic/core/errors.h>
#include <umbilic/core/progress.h>

namespace umbilic {
namespace {

TEST(Progress, PartsReportTheirShareOfTheWhole) {
    double seen = -1.0;
    const Progress whole([&](double fraction, std::string_view) { return seen = fraction, true; });
    whole.part(0.5, 1.0).part(0.0, 0.5).report(1.0, "stage");
    EXPECT_DOUBLE_EQ(seen, 0.75);
}

TEST(Progress, CallbackThatReturnsFalseStopsTheWork) {
    const Progress progress([](double, std::string_view) { return false; });
    EXPECT_THROW(progress.report(0.1, "stage"), Cancelled);
    EXPECT_TRUE(progress.cancelled());
    EXPECT_THROW(progress.check(), Cancelled);
}

TEST(Progress, CancelReachesEveryCopy) {
    const Progress progress;
    const Progress copy = progress.part(0.0, 0.5);
    EXPECT_NO_THROW(copy.check());
    progress.cancel();
    EXPECT_THROW(copy.check(), Cancelled);
}

}  // namespace
}  // namespace umbilic
