// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>

namespace umbilic {

/// A number for people: `digits` significant digits, powers of ten as in "1.2 × 10⁻⁶", a true minus sign, "–" if it is
/// not finite. UTF-8.
std::string readable(double value, int digits = 4);

/// The same with a unit, e.g. "0.0346 mm"; the unit "1" is left out.
std::string readable(double value, const std::string& unit, int digits = 4);

/// A coordinate (mm) of a model of the given size to a ten-millionth of that size: what is smaller is 0.
std::string readable_coordinate(double value, double size);

/// A share in [0, 1] as a percentage that never rounds up to 100 % or down to 0 %.
std::string readable_percent(double share);

/// A count in groups of three digits, e.g. "1 234 567" (thin spaces).
std::string readable_count(std::uint64_t count);

/// The part of a path after its last separator.
std::string base_name(const std::string& path);

}  // namespace umbilic
