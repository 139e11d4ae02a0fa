// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/axis_hull.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace umbilic {

namespace {

/// Distance from column 0 towards the last one, in columns, that can be left out because every hull point there is
/// positive (`sign` = 1) or negative (-1); nothing if that is all of it. `near` runs from 0 on.
template <typename Column>
std::optional<double> left_out(int count, double sign, const Column& column) {
    // Ends that face the axis.
    const auto end = [&](int k) { return sign > 0.0 ? column(k).low : -column(k).high; };
    if (end(0) <= 0.0) return 0.0;
    // The hull's border crosses the axis on a segment from a point above to one at or below it; the first crossing of
    // all such segments is the one on the border.
    double first = count;
    for (int j = 1; j < count; ++j) {
        const double below = end(j);
        if (below > 0.0) continue;
        for (int i = 0; i < j && i < first; ++i) {
            const double above = end(i);
            if (above <= 0.0) continue;
            const Interval share = Interval(above) / (Interval(above) - Interval(below));
            first = std::min(first, (Interval(i) + Interval(j - i) * share).low);
        }
    }
    if (first == count) return std::nullopt;
    return std::max(first, 0.0);
}

}  // namespace

std::optional<Interval> axis_hull(std::span<const Interval> columns) {
    assert(!columns.empty());
    const int count = static_cast<int>(columns.size()), degree = count - 1;
    const auto forward = [&](int k) { return columns[k]; };
    const auto backward = [&](int k) { return columns[degree - k]; };
    double low = 0.0, high = 0.0;
    for (const double sign : {1.0, -1.0}) {
        const std::optional<double> left = left_out(count, sign, forward), right = left_out(count, sign, backward);
        if (!left || !right) return std::nullopt;
        low = std::max(low, *left);
        high = std::max(high, *right);
    }
    if (degree == 0) return Interval(0.0, 1.0);
    const Interval result((Interval(low) / Interval(degree)).low,
                          (Interval(1.0) - Interval(high) / Interval(degree)).high);
    if (result.low > result.high) return std::nullopt;
    return Interval(std::max(result.low, 0.0), std::min(result.high, 1.0));
}

}  // namespace umbilic
