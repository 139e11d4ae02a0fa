// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace umbilic {

/// Greatest number this header knows to be at most the exact value that was rounded to nearest to x: one ulp below x,
/// plus the smallest denormal, so that the step is never lost. The rounding mode stays untouched, so intervals may be
/// used in any thread and beside any library.
inline double rounded_down(double x) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (x == infinity) return std::numeric_limits<double>::max();
    return x - (std::abs(x) * std::numeric_limits<double>::epsilon() + std::numeric_limits<double>::denorm_min());
}

/// Counterpart of rounded_down.
inline double rounded_up(double x) {
    return -rounded_down(-x);
}

/// Closed interval [low, high] of real numbers; ends may be infinite. Every operation returns an interval that contains
/// all results of the exact operation on members of its operands (thesis 3.8.1).
struct Interval {
    double low = 0.0;
    double high = 0.0;

    constexpr Interval() = default;
    constexpr Interval(double value) : low(value), high(value) {}
    constexpr Interval(double l, double h) : low(l), high(h) {}

    /// The whole real line.
    static constexpr Interval all() {
        return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    }

    bool contains(double value) const { return low <= value && value <= high; }
    double middle() const { return 0.5 * low + 0.5 * high; }
    /// Largest absolute value of a member.
    double magnitude() const { return std::max(std::abs(low), std::abs(high)); }
    /// Smallest absolute value of a member.
    double mignitude() const { return contains(0.0) ? 0.0 : std::min(std::abs(low), std::abs(high)); }
};

inline Interval operator-(const Interval& a) {
    return {-a.high, -a.low};
}

inline Interval operator+(const Interval& a, const Interval& b) {
    return {rounded_down(a.low + b.low), rounded_up(a.high + b.high)};
}

inline Interval operator-(const Interval& a, const Interval& b) {
    return a + -b;
}

inline Interval operator*(const Interval& a, const Interval& b) {
    // 0 * infinity is 0 here: infinite ends stand for unbounded sets of finite numbers.
    const auto times = [](double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : x * y; };
    const double ll = times(a.low, b.low), lh = times(a.low, b.high);
    const double hl = times(a.high, b.low), hh = times(a.high, b.high);
    return {rounded_down(std::min(std::min(ll, lh), std::min(hl, hh))),
            rounded_up(std::max(std::max(ll, lh), std::max(hl, hh)))};
}

/// The whole line if b contains 0.
inline Interval operator/(const Interval& a, const Interval& b) {
    if (b.contains(0.0)) return Interval::all();
    return a * Interval(rounded_down(1.0 / b.high), rounded_up(1.0 / b.low));
}

inline Interval square(const Interval& a) {
    return {std::max(0.0, rounded_down(a.mignitude() * a.mignitude())), rounded_up(a.magnitude() * a.magnitude())};
}

/// Square root of the non-negative members; the lower end is 0 if a member is negative.
inline Interval sqrt(const Interval& a) {
    return {std::max(0.0, rounded_down(std::sqrt(std::max(0.0, a.low)))), rounded_up(std::sqrt(std::max(0.0, a.high)))};
}

inline Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Widened by `radius` (>= 0) on both sides.
inline Interval inflated(const Interval& a, double radius) {
    return {rounded_down(a.low - radius), rounded_up(a.high + radius)};
}

}  // namespace umbilic
