// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/readable.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace umbilic {

namespace {

std::string superscript(int exponent) {
    static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "⁻" : "";
    for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
    return text;
}

}  // namespace

std::string readable(double value, int digits) {
    if (!std::isfinite(value)) return "–";
    std::string text = fmt::format("{:.{}g}", std::abs(value), digits);
    const auto e = text.find('e');
    if (e != std::string::npos) text = text.substr(0, e) + " × 10" + superscript(std::stoi(text.substr(e + 1)));
    return value < 0.0 ? "−" + text : text;
}

std::string readable(double value, const std::string& unit, int digits) {
    const std::string number = readable(value, digits);
    return unit.empty() || unit == "1" || !std::isfinite(value) ? number : number + " " + unit;
}

std::string readable_coordinate(double value, double size) {
    if (!(size > 0.0) || !std::isfinite(size) || !std::isfinite(value)) return readable(value, 8);
    const int decimals = std::clamp(7 - static_cast<int>(std::ceil(std::log10(size))), 0, 15);
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.find_first_of("123456789") == std::string::npos) return "0";
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
    }
    return text.front() == '-' ? "−" + text.substr(1) : text;
}

std::string readable_percent(double share) {
    if (!std::isfinite(share)) return "–";
    const double percent = 100.0 * share;
    if (share >= 1.0) return "100 %";
    if (share <= 0.0) return "0 %";
    if (percent > 99.9) return "> 99.9 %";
    if (percent < 0.1) return "< 0.1 %";
    return fmt::format("{:.1f} %", percent);
}

std::string readable_count(std::uint64_t count) {
    const std::string digits = std::to_string(count);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text += "\u202f";
        text += digits[i];
    }
    return text;
}

std::string base_name(const std::string& path) {
    const auto separator = path.find_last_of('/');
    return separator == std::string::npos ? path : path.substr(separator + 1);
}

}  // namespace umbilic
