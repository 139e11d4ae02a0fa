// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/nurbs/parameter_map.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

/// Index of the span that holds x; the outer spans reach to infinity.
std::size_t span_of(const std::vector<double>& breaks, double x) {
    const auto next = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, x);
    return static_cast<std::size_t>(next - breaks.begin()) - 1;
}

}  // namespace

ParameterMap ParameterMap::angular(std::vector<double> breaks) {
    if (breaks.size() < 2) throw InvalidInput("angular parameter map: fewer than two breaks");
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
        if (!(breaks[i] < breaks[i + 1]) || !(breaks[i + 1] - breaks[i] < std::numbers::pi))
            throw InvalidInput("angular parameter map: spans must be positive and shorter than pi");
    ParameterMap result;
    result.breaks_ = std::move(breaks);
    return result;
}

double ParameterMap::native(double surface_parameter) const {
    if (identity()) return surface_parameter;
    if (surface_parameter <= breaks_.front() || surface_parameter >= breaks_.back()) return surface_parameter;
    const std::size_t i = span_of(breaks_, surface_parameter);
    const double d = breaks_[i + 1] - breaks_[i];
    const double t = (surface_parameter - breaks_[i]) / d;
    return breaks_[i] + 2 * std::atan2(t * std::sin(d / 2), (1 - t) + t * std::cos(d / 2));
}

double ParameterMap::surface(double native_parameter) const {
    if (identity()) return native_parameter;
    if (native_parameter <= breaks_.front() || native_parameter >= breaks_.back()) return native_parameter;
    const std::size_t i = span_of(breaks_, native_parameter);
    const double d = breaks_[i + 1] - breaks_[i];
    const double half = 0.5 * (native_parameter - breaks_[i]);
    const double toward_end = std::sin(half), toward_start = std::sin(d / 2 - half);
    return breaks_[i] + d * toward_end / (toward_end + toward_start);
}

}  // namespace umbilic
