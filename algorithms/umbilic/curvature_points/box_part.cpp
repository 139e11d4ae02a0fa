// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/box_part.h>

#include <algorithm>
#include <cmath>

namespace umbilic {

namespace {

/// Corners are rounded by less than this share of the box's sides.
constexpr double rounding = 1e-13;

/// The part of a convex polygon with slope . x <= limit. Sides that are parallel to an axis keep their coordinate.
void clip(const Vector2& slope, double limit, std::vector<Vector2>& polygon) {
    std::vector<Vector2> result;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector2 &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
        const double a = slope.dot(from) - limit, b = slope.dot(to) - limit;
        if (a <= 0.0) result.push_back(from);
        if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) result.push_back(from + a / (a - b) * (to - from));
    }
    polygon = std::move(result);
}

/// Where `along` runs over the corners with across = side; none if there are no such corners.
template <typename Along, typename Across>
std::optional<ParameterInterval> on_side(const std::vector<Vector2>& corners, double side, const Along& along,
                                         const Across& across) {
    std::optional<ParameterInterval> result;
    for (const Vector2& corner : corners) {
        if (across(corner) != side) continue;
        if (!result) result = ParameterInterval{along(corner), along(corner)};
        result = {std::min(result->low, along(corner)), std::max(result->high, along(corner))};
    }
    return result;
}

}  // namespace

std::optional<BoxPart> part_within(const ParameterBox& box, std::span<const LinearBand> bands) {
    std::vector<Vector2> polygon = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
    for (const LinearBand& band : bands) {
        if (std::isinf(band.half_width)) continue;
        clip(band.slope, band.half_width - band.offset, polygon);
        clip(-band.slope, band.half_width + band.offset, polygon);
    }
    if (polygon.empty()) return std::nullopt;
    // Corners on a side get its very coordinate.
    const auto in_box = [](const ParameterInterval& side, double t) {
        return t == 1.0 ? side.high : side.low + t * side.length();
    };
    for (Vector2& corner : polygon) corner = {in_box(box.u, corner.x()), in_box(box.v, corner.y())};
    return BoxPart{box, std::move(polygon)};
}

BoxPart mapped(const BoxPart& part, const Vector2& origin, const Vector2& scale) {
    const auto u = [&](double t) { return origin.x() + t * scale.x(); };
    const auto v = [&](double t) { return origin.y() + t * scale.y(); };
    BoxPart result{{{u(part.box.u.low), u(part.box.u.high)}, {v(part.box.v.low), v(part.box.v.high)}}, {}};
    for (const Vector2& corner : part.corners) result.corners.emplace_back(u(corner.x()), v(corner.y()));
    return result;
}

ParameterBox extent(const BoxPart& part) {
    if (part.corners.empty()) return part.box;
    Vector2 low = part.corners.front(), high = low;
    for (const Vector2& corner : part.corners) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
    }
    return {{low.x(), high.x()}, {low.y(), high.y()}};
}

bool contains(const BoxPart& part, double u, double v) {
    if (!part.box.contains(u, v)) return false;
    const double room = rounding * part.box.u.length() * part.box.v.length();
    for (std::size_t k = 0; k < part.corners.size(); ++k) {
        const Vector2& from = part.corners[k];
        const Vector2 side = part.corners[(k + 1) % part.corners.size()] - from;
        if (side.x() * (v - from.y()) - side.y() * (u - from.x()) < -room) return false;
    }
    return true;
}

std::vector<ParameterBox> contacts(const BoxPart& part) {
    if (part.corners.empty()) return {part.box};
    const auto u = [](const Vector2& corner) { return corner.x(); };
    const auto v = [](const Vector2& corner) { return corner.y(); };
    std::vector<ParameterBox> result;
    for (const double side : {part.box.u.low, part.box.u.high})
        if (const auto piece = on_side(part.corners, side, v, u)) result.push_back({{side, side}, *piece});
    for (const double side : {part.box.v.low, part.box.v.high})
        if (const auto piece = on_side(part.corners, side, u, v)) result.push_back({*piece, {side, side}});
    return result;
}

}  // namespace umbilic
