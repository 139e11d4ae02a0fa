// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>

namespace umbilic {

/// Largest relative error of one operation rounded to nearest, 2^-53.
inline constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

/// Bound k u / (1 - k u) on the relative error of k roundings in a row (Higham, Accuracy and Stability of Numerical
/// Algorithms, lemma 3.1).
constexpr double gamma_bound(int k) {
    return k * unit_roundoff / (1.0 - k * unit_roundoff);
}

/// Factor that covers the rounding of a bound's own evaluation: a bound is a sum of products of non-negative numbers
/// with far fewer than 2^13 operations.
inline constexpr double bound_slack = 1.0 + 0x1p-40;

}  // namespace umbilic
