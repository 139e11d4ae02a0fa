// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/wording.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace umbilic {

namespace {

std::string converted(double number, std::chars_format format, int precision) {
    std::array<char, 64> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, format, precision);
    return end.ec == std::errc() ? std::string(buffer.data(), end.ptr) : std::string("?");
}

}  // namespace

std::string in_digits(double number, int digits) {
    // Powers of ten are for numbers that nobody measures.
    constexpr double smallest = 1e-6, largest = 1e9;
    const double magnitude = std::abs(number);
    if (!(magnitude >= smallest && magnitude < largest)) return converted(number, std::chars_format::general, digits);
    const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(magnitude))));
    std::string result = converted(number, std::chars_format::fixed, decimals);
    if (decimals == 0) return result;
    result.erase(result.find_last_not_of('0') + 1);
    if (result.back() == '.') result.pop_back();
    return result;
}

std::string in_mm(double length) {
    // Two digits say enough of a deviation, and no part is made to a nanometre.
    constexpr double measurable = 1e-6;
    if (length > 0.0 && length < measurable) return "less than 0.000001 mm";
    return in_digits(length, 2) + " mm";
}

std::string in_percent(double share) {
    double tenths = std::round(share * 1000.0);
    if (share < 1.0) tenths = std::min(tenths, 999.0);
    if (share > 0.0) tenths = std::max(tenths, 1.0);
    return converted(tenths / 10.0, std::chars_format::fixed, 1) + " %";
}

std::string joined(const std::vector<std::string>& parts) {
    std::string result;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i > 0) result += i + 1 == parts.size() ? " and " : ", ";
        result += parts[i];
    }
    return result;
}

}  // namespace umbilic
