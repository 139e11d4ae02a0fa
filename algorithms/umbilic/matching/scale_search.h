// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <vector>

namespace umbilic {

/// What a search for the least value of a function of one number came to.
struct Minimum {
    double at = 0.0;
    double value = 0.0;
    int evaluations = 0;
    std::vector<double> lengths;  ///< of the bracket after each step (golden section only)
};

/// Golden section search in [low, high] until the bracket is at most `width` (> 0) long (thesis 4.7.2 and 4.7.5): every
/// step keeps 0.618 of the bracket. The new point lies at the golden share of the new bracket, opposite to the one that
/// is kept: whichever end was cut, as the thesis's proof needs. (Its mirror image about the middle is the same place
/// but for rounding, which would grow by 2.6 a step.) Finds a local minimum if there are several.
Minimum golden_section_minimum(const std::function<double(double)>& f, double low, double high, double width);

/// Brent's method, parabolas safeguarded by the golden section (Boost.Math), to the same width.
Minimum brent_minimum(const std::function<double(double)>& f, double low, double high, double width);

/// The least values of f at `count` (>= 2) evenly spaced points of [low, high] that are no greater than those of their
/// neighbours, at most `most`, lowest first: f need not have one minimum only. Each is searched further by
/// `search` between its neighbours.
std::vector<Minimum> scanned_minima(const std::function<double(double)>& f, double low, double high, int count,
                                    int most, const std::function<Minimum(double low, double high)>& search);

}  // namespace umbilic
