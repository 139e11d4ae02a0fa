// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <limits>

#include <umbilic/core/errors.h>
#include <umbilic/core/tolerances.h>

namespace umbilic {
namespace {

TEST(Tolerances, LengthsGrowAndCurvaturesShrinkWithTheModel) {
    const auto small = derive_tolerances(10.0, 0.0), large = derive_tolerances(1000.0, 0.0);
    for (const char* length : {"distance", "umbilic-distance", "exact-distance"})
        EXPECT_DOUBLE_EQ(find_tolerance(large, length).value, 100.0 * find_tolerance(small, length).value) << length;
    EXPECT_DOUBLE_EQ(find_tolerance(large, "kappa").value, find_tolerance(small, "kappa").value / 100.0);
    for (const char* pure : {"direction", "cell"})
        EXPECT_EQ(find_tolerance(large, pure).value, find_tolerance(small, pure).value) << pure;
}

TEST(Tolerances, ThesisExampleComesOutOfTheDefaults) {
    // 6.2.3: 0.01 mm, 0.03 / mm and 0.06 rad on a surface of about 33 mm x 33 mm.
    const auto t = derive_tolerances(33.3, 0.0);
    EXPECT_NEAR(find_tolerance(t, "distance").value, 0.01, 1e-4);
    EXPECT_NEAR(find_tolerance(t, "kappa").value, 0.03, 1e-4);
    EXPECT_EQ(find_tolerance(t, "direction").value, 0.06);
    EXPECT_EQ(find_tolerance(t, "cell").value, 0.05);
}

TEST(Tolerances, PoorAccuracyOfTheFileRaisesTheDistanceUpToALimit) {
    EXPECT_DOUBLE_EQ(find_tolerance(derive_tolerances(100.0, 1e-6), "distance").value, 0.03);
    EXPECT_DOUBLE_EQ(find_tolerance(derive_tolerances(100.0, 0.05), "distance").value, 0.05);
    EXPECT_DOUBLE_EQ(find_tolerance(derive_tolerances(100.0, 7.0), "distance").value, 0.1);
}

TEST(Tolerances, ChoicesOfTheUserKeepValueAndOrigin) {
    ToleranceChoices choices;
    choices.distance = 0.5;
    choices.cell = 0.1;
    const auto t = derive_tolerances(100.0, 7.0, choices);
    EXPECT_EQ(find_tolerance(t, "distance").value, 0.5);
    EXPECT_EQ(find_tolerance(t, "distance").origin, ToleranceOrigin::user);
    EXPECT_EQ(find_tolerance(t, "cell").origin, ToleranceOrigin::user);
    EXPECT_EQ(find_tolerance(t, "kappa").origin, ToleranceOrigin::derived);
    EXPECT_EQ(find_tolerance(t, "direction").origin, ToleranceOrigin::fixed_default);
    for (const Tolerance& tolerance : t) {
        EXPECT_FALSE(tolerance.unit.empty()) << tolerance.name;
        EXPECT_FALSE(tolerance.inequality.empty()) << tolerance.name;
    }
}

TEST(Tolerances, ExactnessNeverExceedsTheDistance) {
    ToleranceChoices choices;
    choices.distance = 1e-9;
    EXPECT_LE(find_tolerance(derive_tolerances(100.0, 0.5, choices), "exact-distance").value, 1e-9);
}

TEST(Tolerances, NonsenseIsRefused) {
    for (double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        ToleranceChoices choices;
        choices.kappa = bad;
        EXPECT_THROW(derive_tolerances(1.0, 0.0, choices), InvalidInput) << bad;
        EXPECT_THROW(derive_tolerances(bad, 0.0), InvalidInput) << bad;
    }
    ToleranceChoices choices;
    choices.cell = 1.5;
    EXPECT_THROW(derive_tolerances(1.0, 0.0, choices), InvalidInput);
    EXPECT_THROW(find_tolerance(derive_tolerances(1.0, 0.0), "weight"), InvalidInput);
}

}  // namespace
}  // namespace umbilic
