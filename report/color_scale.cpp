// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/color_scale.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include <report/readable.h>

namespace umbilic {

namespace {

constexpr std::array<std::uint32_t, 10> viridis = {0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e,
                                                   0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725};
constexpr std::array<std::uint32_t, 9> blue_white_red = {0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7,
                                                         0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b};

Color unpack(std::uint32_t rgb) {
    return {static_cast<float>(rgb >> 16 & 0xff) / 255.0f, static_cast<float>(rgb >> 8 & 0xff) / 255.0f,
            static_cast<float>(rgb & 0xff) / 255.0f};
}

/// Linear interpolation in a table of colours, t in [0, 1].
template <std::size_t count>
Color interpolate(const std::array<std::uint32_t, count>& table, double t) {
    const double position = std::clamp(std::isfinite(t) ? t : 1.0, 0.0, 1.0) * (count - 1);
    const auto i = std::min(static_cast<std::size_t>(position), count - 2);
    const auto fraction = static_cast<float>(position - static_cast<double>(i));
    const Color low = unpack(table[i]), high = unpack(table[i + 1]);
    Color color;
    for (int k = 0; k < 3; ++k) color[k] = low[k] + fraction * (high[k] - low[k]);
    return color;
}

/// Smallest of 1, 2, 5 times a power of ten that is not below `value`.
double round_up(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * decade >= value) return factor * decade;
    }
    return 10.0 * decade;
}

}  // namespace

Color ColorScale::of_size(double deviation) const {
    return interpolate(viridis, std::abs(deviation) / range);
}

Color ColorScale::of_signed(double deviation) const {
    return interpolate(blue_white_red, 0.5 + 0.5 * deviation / range);
}

ColorScale color_scale(double largest, double tolerance) {
    const double wanted = tolerance > 0.0 ? std::clamp(largest, 0.1 * tolerance, 5.0 * tolerance) : largest;
    return {wanted > 0.0 ? round_up(wanted) : 1.0, largest, tolerance};
}

Color color_of(UmbilicType type) {
    switch (type) {
        case UmbilicType::star:
            return {0.835f, 0.369f, 0.0f};
        case UmbilicType::lemon:
            return {0.0f, 0.447f, 0.698f};
        case UmbilicType::monstar:
            return {0.0f, 0.620f, 0.451f};
        case UmbilicType::non_generic:
            return {0.45f, 0.45f, 0.45f};
    }
    return {0.45f, 0.45f, 0.45f};
}

std::string hex(const Color& color) {
    const auto byte = [](float value) { return static_cast<int>(std::lround(255.0f * value)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(color[0]), byte(color[1]), byte(color[2]));
}

std::string legend_svg(const ColorScale& scale, bool is_signed, const std::string& id) {
    constexpr double left = 24.0, width = 340.0, top = 20.0, height = 12.0;
    constexpr int steps = 24;
    const char* const kind = is_signed ? "signed" : "size";
    const double low = is_signed ? -scale.range : 0.0;
    const auto x_of = [&](double value) { return left + width * (value - low) / (scale.range - low); };
    fmt::memory_buffer out;
    const auto append = [&](fmt::string_view text, const auto&... arguments) {
        fmt::format_to(std::back_inserter(out), fmt::runtime(text), arguments...);
    };
    append("<svg class=\"legend legend-{}\" viewBox=\"0 0 400 52\" role=\"img\" aria-label=\"Colour scale of the {}\">",
           kind, is_signed ? "signed deviation" : "deviation");
    append("<defs><linearGradient id=\"{}\">", id);
    for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const double value = low + t * (scale.range - low);
        append("<stop offset=\"{:.4f}\" stop-color=\"{}\"/>", t,
               hex(is_signed ? scale.of_signed(value) : scale.of_size(value)));
    }
    append("</linearGradient></defs><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"url(#{})\"/>", left, top,
           width, height, id);
    const bool beyond = scale.largest > scale.range;
    const int ticks = 4;
    for (int i = 0; i <= ticks; ++i) {
        const double value = low + (scale.range - low) * i / ticks;
        const bool last = i == ticks, first = i == 0;
        const std::string text = (last && beyond                 ? "≥ "
                                  : first && beyond && is_signed ? "≤ "
                                                                 : "") +
                                 readable(value, 3) + (last ? " mm" : "");
        append("<path d=\"M{0:.1f} {1}v4\" class=\"tick\"/><text x=\"{0:.1f}\" y=\"{2}\">{3}</text>", x_of(value),
               top + height, top + height + 16.0, text);
    }
    if (scale.tolerance > 0.0 && scale.tolerance <= scale.range) {
        for (const double sign : {-1.0, 1.0}) {
            if (sign < 0.0 && !is_signed) continue;
            append("<path d=\"M{0:.1f} {1}v{2}\" class=\"mark\"/>", x_of(sign * scale.tolerance), top - 4.0,
                   height + 8.0);
        }
        append("<text x=\"{:.1f}\" y=\"{}\" class=\"mark-text\">tolerance {}</text>",
               std::clamp(x_of(scale.tolerance), left + 50.0, left + width - 50.0), top - 7.0,
               readable(scale.tolerance, "mm", 3));
    } else if (scale.tolerance > 0.0) {
        append("<text x=\"{}\" y=\"{}\" class=\"mark-text beyond\">tolerance {}, beyond the scale</text>", left + width,
               top - 7.0, readable(scale.tolerance, "mm", 3));
    }
    append("</svg>");
    return fmt::to_string(out);
}

}  // namespace umbilic
