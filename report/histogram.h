// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

namespace umbilic {

/// How often values fall into bins of equal width, symmetric about 0.
struct Histogram {
    double range = 0.0;       ///< the bins reach from -range to range, which contains all values
    std::vector<int> counts;  ///< one a bin; the upper edge of the last one belongs to it
};

Histogram histogram(std::span<const double> values, int bins);

/// As an SVG element, with the normal distribution of standard deviation `noise` (none if 0) drawn over it.
std::string histogram_svg(const Histogram& histogram, double noise);

}  // namespace umbilic
