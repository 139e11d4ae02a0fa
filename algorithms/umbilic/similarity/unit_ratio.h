// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

namespace umbilic {

/// The two units that were probably mixed up if a copy is `scale` times (or 1 / scale times) as large as it should be,
/// e.g. "inch and millimetre" for 25.4; none if the scale is not such a ratio within unit_ratio_tolerance.
std::optional<std::string> mixed_up_units(double scale);

/// Relative; scales found on exact copies are far better than this, and numbers of a designer's choice rarely hit it.
inline constexpr double unit_ratio_tolerance = 1e-3;

}  // namespace umbilic
