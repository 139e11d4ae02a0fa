// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <umbilic/similarity/unit_ratio.h>
#include <umbilic/similarity/wording.h>

namespace umbilic {
namespace {

TEST(Wording, PercentIsNeverRoundedToAllOrNothing) {
    EXPECT_EQ(in_percent(1.0), "100.0 %");
    EXPECT_EQ(in_percent(0.99999), "99.9 %");
    EXPECT_EQ(in_percent(0.00001), "0.1 %");
    EXPECT_EQ(in_percent(0.0), "0.0 %");
    EXPECT_EQ(in_percent(0.3704), "37.0 %");
}

TEST(Wording, Numbers) {
    EXPECT_EQ(in_digits(2.7031), "2.703");
    EXPECT_EQ(in_mm(0.00421), "0.0042 mm");
    EXPECT_EQ(in_digits(25.4), "25.4");
    EXPECT_EQ(in_digits(12345.0), "12345");
    EXPECT_EQ(in_digits(0.0), "0");
    EXPECT_EQ(in_digits(-1e-15), "-1e-15");
    EXPECT_EQ(in_mm(9.3e-5), "0.000093 mm");
    EXPECT_EQ(in_mm(2134.0), "2134 mm");
}

TEST(Wording, Lists) {
    EXPECT_EQ(joined({}), "");
    EXPECT_EQ(joined({"a"}), "a");
    EXPECT_EQ(joined({"a", "b"}), "a and b");
    EXPECT_EQ(joined({"a", "b", "c"}), "a, b and c");
}

TEST(UnitRatio, KnownRatiosAndTheirInverses) {
    for (double ratio : {25.4, 1000.0, 0.3048, 10.0, 12.0, 304.8}) {
        EXPECT_TRUE(mixed_up_units(ratio)) << ratio;
        EXPECT_EQ(mixed_up_units(1.0 / ratio), mixed_up_units(ratio)) << ratio;
        EXPECT_TRUE(mixed_up_units(ratio * 1.0009)) << ratio;
        EXPECT_FALSE(mixed_up_units(ratio * 1.002)) << ratio;
    }
    EXPECT_EQ(mixed_up_units(25.4), "inch and millimetre");
    EXPECT_EQ(mixed_up_units(0.3048), "foot and metre");
    EXPECT_FALSE(mixed_up_units(1.0));
    EXPECT_FALSE(mixed_up_units(2.703));
}

}  // namespace
}  // namespace umbilic
