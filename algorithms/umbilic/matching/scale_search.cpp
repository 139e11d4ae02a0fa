// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/scale_search.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <boost/math/tools/minima.hpp>

namespace umbilic {

Minimum golden_section_minimum(const std::function<double(double)>& f, double low, double high, double width) {
    const double share = 0.5 * (std::sqrt(5.0) - 1.0);
    double left = high - share * (high - low), right = low + share * (high - low);
    double at_left = f(left), at_right = f(right);
    Minimum result;
    result.evaluations = 2;
    while (high - low > width) {
        if (at_left <= at_right) {
            high = right;
            right = left;
            at_right = at_left;
            left = high - share * (high - low);
            at_left = f(left);
        } else {
            low = left;
            left = right;
            at_left = at_right;
            right = low + share * (high - low);
            at_right = f(right);
        }
        ++result.evaluations;
        result.lengths.push_back(high - low);
        // Down at rounding the points can no longer be told apart.
        if (!(left < right)) break;
    }
    result.at = at_left <= at_right ? left : right;
    result.value = std::min(at_left, at_right);
    return result;
}

Minimum brent_minimum(const std::function<double(double)>& f, double low, double high, double width) {
    Minimum result;
    const auto counted = [&](double x) {
        ++result.evaluations;
        return f(x);
    };
    // Bits of accuracy relative to the place: shift the bracket so that the place is of the bracket's own size.
    const double length = high - low;
    const int bits = std::max(3, static_cast<int>(std::ceil(std::log2(2 * length / width))));
    std::uintmax_t steps = 100;
    const auto [at, value] = boost::math::tools::brent_find_minima([&](double x) { return counted(low - length + x); },
                                                                   length, 2 * length, bits, steps);
    result.at = low - length + at;
    result.value = value;
    return result;
}

std::vector<Minimum> scanned_minima(const std::function<double(double)>& f, double low, double high, int count,
                                    int most, const std::function<Minimum(double, double)>& search) {
    const auto place = [&](int k) { return low + (high - low) * k / (count - 1); };
    std::vector<double> values(count);
    for (int k = 0; k < count; ++k) values[k] = f(place(k));
    std::vector<int> local;
    for (int k = 0; k < count; ++k) {
        const bool below_left = k == 0 || values[k] <= values[k - 1];
        // On a plateau the first point stands for it.
        const bool below_right = k == count - 1 || values[k] < values[k + 1];
        if (below_left && below_right) local.push_back(k);
    }
    std::stable_sort(local.begin(), local.end(), [&](int a, int b) { return values[a] < values[b]; });
    if (static_cast<int>(local.size()) > most) local.resize(most);
    std::vector<Minimum> result;
    for (const int k : local) {
        Minimum found = search(place(std::max(k - 1, 0)), place(std::min(k + 1, count - 1)));
        if (values[k] < found.value) {
            found.at = place(k);
            found.value = values[k];
        }
        result.push_back(found);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Minimum& a, const Minimum& b) { return a.value < b.value; });
    return result;
}

}  // namespace umbilic
