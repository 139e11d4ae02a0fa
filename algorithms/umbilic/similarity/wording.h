// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace umbilic {

/// The number with at least so many significant digits, whatever the locale: "2.703", "0.0042", "12345", "1e-15".
std::string in_digits(double number, int digits = 4);
/// "0.0042 mm".
std::string in_mm(double length);
/// A share in [0, 1] as "37.0 %"; below 1 it is never rounded up to "100.0 %", above 0 never down to "0.0 %".
std::string in_percent(double share);
/// "a", "a and b", "a, b and c".
std::string joined(const std::vector<std::string>& parts);

}  // namespace umbilic
