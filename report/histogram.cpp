// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/histogram.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include <report/readable.h>

namespace umbilic {

Histogram histogram(std::span<const double> values, int bins) {
    Histogram result;
    result.counts.assign(bins, 0);
    for (const double value : values) result.range = std::max(result.range, std::abs(value));
    for (const double value : values) {
        const double t = result.range > 0.0 ? 0.5 + 0.5 * value / result.range : 0.5;
        ++result.counts[std::clamp(static_cast<int>(t * bins), 0, bins - 1)];
    }
    return result;
}

std::string histogram_svg(const Histogram& histogram, double noise) {
    constexpr double left = 20.0, width = 600.0, top = 10.0, height = 170.0;
    const auto bins = static_cast<double>(histogram.counts.size());
    double total = 0.0;
    for (const int count : histogram.counts) total += count;
    // What a normal distribution puts into a bin around x.
    const double bin_width = 2.0 * histogram.range / bins;
    const auto expected = [&](double x) {
        return total * bin_width * std::exp(-0.5 * x * x / (noise * noise)) /
               (noise * std::sqrt(2.0 * std::numbers::pi));
    };
    const bool curve = noise > 0.0 && histogram.range > 0.0;
    double highest = *std::max_element(histogram.counts.begin(), histogram.counts.end());
    if (curve) highest = std::max(highest, expected(0.0));
    fmt::memory_buffer out;
    const auto append = [&](fmt::string_view text, const auto&... values) {
        fmt::format_to(std::back_inserter(out), fmt::runtime(text), values...);
    };
    append("<svg class=\"histogram\" viewBox=\"0 0 640 210\" role=\"img\" aria-label=\"Histogram of the residuals\">");
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
        const double tall = highest > 0.0 ? height * histogram.counts[i] / highest : 0.0;
        append("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"#4393c3\"/>",
               left + width * static_cast<double>(i) / bins, top + height - tall, 0.9 * width / bins, tall);
    }
    if (curve) {
        append("<path fill=\"none\" stroke=\"#d6604d\" stroke-width=\"1.5\" d=\"");
        constexpr int steps = 200;
        for (int i = 0; i <= steps; ++i) {
            const double t = static_cast<double>(i) / steps;
            append("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", left + width * t,
                   top + height * (1.0 - expected((2.0 * t - 1.0) * histogram.range) / highest));
        }
        append("\"/>");
    }
    append("<path class=\"tick\" d=\"M{} {}h{}\"/>", left, top + height, width);
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0})
        append(
            "<path d=\"M{0:.1f} {1}v4\" class=\"tick\"/><text x=\"{0:.1f}\" y=\"{2}\" "
            "text-anchor=\"middle\">{3}</text>",
            left + width * t, top + height, top + height + 18.0, readable((2.0 * t - 1.0) * histogram.range, 2));
    append("</svg>");
    return fmt::to_string(out);
}

}  // namespace umbilic
