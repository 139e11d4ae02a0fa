// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/mark.h>

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <report/color_scale.h>

namespace umbilic {

namespace {

/// Polygon with corners at `outer` from the top on, and with corners at `inner` between them if that is not 0.
std::string polygon(int corners, double outer, double inner) {
    const int count = inner > 0.0 ? 2 * corners : corners;
    std::string path;
    for (int i = 0; i < count; ++i) {
        const double radius = inner > 0.0 && i % 2 == 1 ? inner : outer;
        const double angle = 2.0 * std::numbers::pi * i / count - std::numbers::pi / 2.0;
        path += fmt::format("{}{:.3f} {:.3f}", i == 0 ? "M" : "L", radius * std::cos(angle), radius * std::sin(angle));
    }
    return path + "Z";
}

}  // namespace

std::string mark_path(UmbilicType type) {
    switch (type) {
        case UmbilicType::star:
            return polygon(3, 1.3, 0.42);
        case UmbilicType::monstar:
            return polygon(3, 1.15, 0.0);
        case UmbilicType::lemon:
            return "M-1.2 0Q0 -1.5 1.2 0Q0 1.5 -1.2 0Z";
        case UmbilicType::non_generic:
            return "M-.8 -.8H.8V.8H-.8Z";
    }
    return "";
}

std::string mark_svg(UmbilicType type, double x, double y, double radius, const std::string& classes) {
    return fmt::format(
        "<path class=\"umbilic{}{}\" fill=\"{}\" transform=\"translate({:.1f} {:.1f}) scale({})\" d=\"{}\"/>",
        classes.empty() ? "" : " ", classes, hex(color_of(type)), x, y, radius, mark_path(type));
}

}  // namespace umbilic
