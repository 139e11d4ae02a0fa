// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/interval.h>

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <random>

#include <boost/multiprecision/cpp_int.hpp>

namespace umbilic {
namespace {

using Exact = boost::multiprecision::cpp_rational;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool encloses(const Interval& interval, const Exact& value) {
    return (interval.low == -infinity || Exact(interval.low) <= value) &&
           (interval.high == infinity || value <= Exact(interval.high));
}

/// Finite doubles of all sizes up to 2^limit, denormals, zeros and small integers included.
class Numbers {
public:
    double operator()(int limit) {
        const int kind = std::uniform_int_distribution<int>(0, 9)(engine_);
        const double sign = kind % 2 ? 1.0 : -1.0;
        if (kind < 2) return sign * std::uniform_int_distribution<int>(0, 3)(engine_);
        if (kind < 4)
            return sign * std::numeric_limits<double>::denorm_min() * std::uniform_int_distribution<int>(1, 9)(engine_);
        const int exponent =
            std::uniform_int_distribution<int>(kind < 8 ? -30 : -limit, kind < 8 ? 30 : limit)(engine_);
        return sign * std::ldexp(std::uniform_real_distribution<double>(0.5, 1.0)(engine_), exponent);
    }
    Interval interval(int limit) {
        const double a = (*this)(limit), b = (*this)(limit);
        return {std::min(a, b), std::max(a, b)};
    }

private:
    std::mt19937_64 engine_{7};
};

TEST(Interval, RoundedStepsPassTheNeighbouringNumber) {
    Numbers numbers;
    for (int k = 0; k < 20000; ++k) {
        const double x = numbers(1000);
        EXPECT_LE(rounded_down(x), std::nextafter(x, -infinity));
        EXPECT_GE(rounded_up(x), std::nextafter(x, infinity));
    }
}

TEST(Interval, ArithmeticEnclosesExactResults) {
    Numbers numbers;
    for (int k = 0; k < 5000; ++k) {
        const Interval a = numbers.interval(400), b = numbers.interval(400);
        for (const double x : {a.low, a.high})
            for (const double y : {b.low, b.high}) {
                const Exact ex(x), ey(y);
                ASSERT_TRUE(encloses(a + b, ex + ey));
                ASSERT_TRUE(encloses(a - b, ex - ey));
                ASSERT_TRUE(encloses(a * b, ex * ey));
                if (y != 0.0) {
                    ASSERT_TRUE(encloses(a / b, ex / ey));
                }
            }
        ASSERT_TRUE(encloses(square(a), Exact(a.low) * Exact(a.low)));
        ASSERT_TRUE(encloses(square(a), Exact(a.high) * Exact(a.high)));
        ASSERT_GE(square(a).low, 0.0);
        if (a.low >= 0.0) {
            const Interval root = sqrt(a);
            ASSERT_TRUE(Exact(root.low) * Exact(root.low) <= Exact(a.low));
            ASSERT_TRUE(Exact(root.high) * Exact(root.high) >= Exact(a.high));
        }
    }
}

TEST(Interval, OneTenthIsNeverAPoint) {
    const Interval tenth = Interval(1.0) / Interval(10.0);
    EXPECT_LT(tenth.low, tenth.high);
    EXPECT_TRUE(encloses(tenth, Exact(1) / 10));
}

TEST(Interval, DivisionByAnIntervalWithZeroIsTheWholeLine) {
    const Interval quotient = Interval(1.0, 2.0) / Interval(-1.0, 3.0);
    EXPECT_EQ(quotient.low, -infinity);
    EXPECT_EQ(quotient.high, infinity);
    EXPECT_EQ((Interval(1.0) / Interval(0.0, 1.0)).low, -infinity);
}

TEST(Interval, OverflowKeepsEnclosing) {
    const double largest = std::numeric_limits<double>::max();
    const Interval sum = Interval(largest) + Interval(largest);
    EXPECT_LE(sum.low, largest);
    EXPECT_EQ(sum.high, infinity);
    const Interval product = Interval::all() * Interval(0.0, 1.0);
    EXPECT_TRUE(product.contains(0.0));
    EXPECT_EQ(product.low, -infinity);
}

TEST(Interval, MagnitudeAndMignitude) {
    EXPECT_EQ(Interval(-3.0, 2.0).magnitude(), 3.0);
    EXPECT_EQ(Interval(-3.0, 2.0).mignitude(), 0.0);
    EXPECT_EQ(Interval(-3.0, -2.0).mignitude(), 2.0);
    EXPECT_EQ(Interval(1.0, 4.0).mignitude(), 1.0);
}

}  // namespace
}  // namespace umbilic
