// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/unit_ratio.h>

#include <algorithm>
#include <cmath>

namespace umbilic {

namespace {

struct UnitRatio {
    double ratio;
    const char* units;
};

constexpr UnitRatio unit_ratios[] = {
    {25.4, "inch and millimetre"},    {1000.0, "metre and millimetre"}, {304.8, "foot and millimetre"},
    {1.0 / 0.3048, "foot and metre"}, {12.0, "foot and inch"},          {10.0, "centimetre and millimetre"},
    {100.0, "metre and centimetre"},  {2.54, "inch and centimetre"},    {30.48, "foot and centimetre"},
    {1.0 / 0.0254, "inch and metre"},
};

}  // namespace

std::optional<std::string> mixed_up_units(double scale) {
    const double ratio = std::max(scale, 1.0 / scale);
    for (const UnitRatio& known : unit_ratios)
        if (std::abs(ratio / known.ratio - 1.0) <= unit_ratio_tolerance) return known.units;
    return std::nullopt;
}

}  // namespace umbilic
