// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/nurbs/trimming.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

/// Largest gap between consecutive curves of a loop, relative to the domain's sides, that is bridged by a straight
/// segment. Files written with single-precision or loose tolerances stay below; a loop with a missing edge does not.
constexpr double largest_gap = 1e-2;

/// The search in the polylines looks at bands of equal height that hold about this many segments, were all short.
constexpr int segments_per_band = 4;
constexpr int most_bands = 1 << 14;

/// A curve is halved at most this often when it is turned into a polyline.
constexpr int deepest_halving = 14;

Vector2 scaled(const ParameterBox& domain, const Vector2& p) {
    return {(p.x() - domain.u.low) / domain.u.length(), (p.y() - domain.v.low) / domain.v.length()};
}

/// Gap between the end of one curve of a loop and the start of the next, relative to the domain's sides. What happens
/// outside of the domain does not count: a face has no points there.
double gap(const ParameterBox& domain, const Vector2& end, const Vector2& start) {
    const auto nearest = [&](const Vector2& p) -> Vector2 {
        return scaled(domain, {domain.u.clamp(p.x()), domain.v.clamp(p.y())});
    };
    return (nearest(end) - nearest(start)).norm();
}

double segment_distance(const Vector2& p, const Vector2& a, const Vector2& b) {
    const Vector2 along = b - a;
    const double length = along.squaredNorm();
    const double t = length > 0.0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0.0;
    return (p - a - t * along).norm();
}

}  // namespace

NurbsCurve2::NurbsCurve2(KnotVector knots, std::vector<Vector2> poles, std::vector<double> weights)
    : knots_(std::move(knots)), poles_(std::move(poles)), weights_(std::move(weights)) {
    if (static_cast<int>(poles_.size()) != knots_.pole_count())
        throw InvalidInput("NURBS curve: " + std::to_string(poles_.size()) + " poles where the knots ask for " +
                           std::to_string(knots_.pole_count()));
    if (!weights_.empty() && weights_.size() != poles_.size())
        throw InvalidInput("NURBS curve: " + std::to_string(weights_.size()) + " weights for " +
                           std::to_string(poles_.size()) + " poles");
    for (const Vector2& pole : poles_)
        if (!pole.allFinite()) throw InvalidInput("NURBS curve: a pole is not finite");
    for (const double weight : weights_)
        if (!std::isfinite(weight) || weight <= 0.0) throw InvalidInput("NURBS curve: weights must be positive");
}

Vector2 NurbsCurve2::value(double t) const {
    return value_and_tangent(t).first;
}

std::pair<Vector2, Vector2> NurbsCurve2::value_and_tangent(double t) const {
    const int p = knots_.degree();
    std::array<double, 2 * (maximum_degree + 1)> basis;
    const int span = knots_.span(t);
    knots_.basis(span, t, 1, basis.data());
    Vector2 point = Vector2::Zero(), tangent = Vector2::Zero();
    double weight = 0.0, weight_slope = 0.0;
    for (int i = 0; i <= p; ++i) {
        const int at = span - p + i;
        const double w = weights_.empty() ? 1.0 : weights_[at];
        point += basis[i] * w * poles_[at];
        tangent += basis[p + 1 + i] * w * poles_[at];
        weight += basis[i] * w;
        weight_slope += basis[p + 1 + i] * w;
    }
    if (weights_.empty()) return {point, tangent};
    point /= weight;
    return {point, (tangent - weight_slope * point) / weight};
}

TrimmingRegion::TrimmingRegion(ParameterBox domain) : domain_(domain), box_(domain) {}

TrimmingRegion::TrimmingRegion(ParameterBox domain, std::vector<TrimmingLoop> loops, ParameterMap u_map,
                               ParameterMap v_map)
    : domain_(domain), loops_(std::move(loops)), u_map_(std::move(u_map)), v_map_(std::move(v_map)) {
    if (loops_.empty()) {
        box_ = domain_;
        return;
    }
    for (std::size_t number = 0; number < loops_.size(); ++number) {
        std::vector<Vector2> line;
        for (const TrimmingCurve& curve : loops_[number]) {
            std::vector<std::pair<double, Vector2>> points;
            // The breaks of the angular maps bend the image of a straight pcurve; halving finds them.
            const std::vector<double>& breaks = curve.curve.knots().breaks();
            for (const double t : breaks) points.emplace_back(t, curve_point(curve, t));
            for (int depth = 0; depth < deepest_halving; ++depth) {
                bool split = false;
                std::vector<std::pair<double, Vector2>> finer;
                for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                    finer.push_back(points[i]);
                    const double middle = 0.5 * (points[i].first + points[i + 1].first);
                    const Vector2 point = curve_point(curve, middle);
                    const double off = segment_distance(scaled(domain_, point), scaled(domain_, points[i].second),
                                                        scaled(domain_, points[i + 1].second));
                    // Two halvings at least: an S-shaped span may cross its chord in the middle.
                    if (depth < 2 || off > 0.5 * polyline_deviation) {
                        finer.emplace_back(middle, point);
                        split = true;
                    }
                }
                finer.push_back(points.back());
                points = std::move(finer);
                if (!split) break;
            }
            if (curve.reversed) std::reverse(points.begin(), points.end());
            if (!line.empty() && gap(domain_, line.back(), points.front().second) > largest_gap)
                throw InvalidInput("trimming loop " + std::to_string(number + 1) +
                                   ": its curves do not join in the parameter plane");
            for (const auto& [t, point] : points) line.push_back(point);
        }
        if (line.empty()) throw InvalidInput("trimming loop " + std::to_string(number + 1) + " is empty");
        if (gap(domain_, line.back(), line.front()) > largest_gap)
            throw InvalidInput("trimming loop " + std::to_string(number + 1) + " is not closed in the parameter plane");
        if (line.back() != line.front()) line.push_back(line.front());
        polylines_.push_back(std::move(line));
    }

    box_ = {{domain_.u.high, domain_.u.low}, {domain_.v.high, domain_.v.low}};
    bool on_border = polylines_.size() == 1;
    double area = 0.0;
    for (const std::vector<Vector2>& line : polylines_)
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const Vector2 p = scaled(domain_, line[i]), next = scaled(domain_, line[i + 1]);
            box_.u.low = std::min(box_.u.low, line[i].x());
            box_.u.high = std::max(box_.u.high, line[i].x());
            box_.v.low = std::min(box_.v.low, line[i].y());
            box_.v.high = std::max(box_.v.high, line[i].y());
            const double to_border =
                std::min({std::abs(p.x()), std::abs(1 - p.x()), std::abs(p.y()), std::abs(1 - p.y())});
            on_border = on_border && to_border <= polyline_deviation;
            area += 0.5 * (p.x() * next.y() - p.y() * next.x());
        }
    box_.u = {domain_.u.clamp(box_.u.low), domain_.u.clamp(box_.u.high)};
    box_.v = {domain_.v.clamp(box_.v.low), domain_.v.clamp(box_.v.high)};
    whole_domain_ = on_border && std::abs(std::abs(area) - 1.0) <= 8 * polyline_deviation;
    build_bands();
}

void TrimmingRegion::build_bands() {
    for (const std::vector<Vector2>& line : polylines_)
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            segments_.push_back({scaled(domain_, line[i]), scaled(domain_, line[i + 1])});
    banded_ = {segments_.front().from.y(), segments_.front().from.y()};
    for (const Segment& segment : segments_) {
        banded_.low = std::min({banded_.low, segment.from.y(), segment.to.y()});
        banded_.high = std::max({banded_.high, segment.from.y(), segment.to.y()});
    }
    const int count = std::clamp(static_cast<int>(segments_.size()) / segments_per_band, 1, most_bands);
    const auto for_each_band = [&](const Segment& segment, const auto& visit) {
        const int first = band(std::min(segment.from.y(), segment.to.y()));
        const int last = band(std::max(segment.from.y(), segment.to.y()));
        for (int i = first; i <= last; ++i) visit(i);
    };
    band_start_.assign(count + 1, 0);
    for (const Segment& segment : segments_) for_each_band(segment, [&](int i) { ++band_start_[i + 1]; });
    for (int i = 0; i < count; ++i) band_start_[i + 1] += band_start_[i];
    in_band_.resize(band_start_.back());
    std::vector<int> next(band_start_.begin(), band_start_.end() - 1);
    for (int number = 0; number < static_cast<int>(segments_.size()); ++number)
        for_each_band(segments_[number], [&](int i) { in_band_[next[i]++] = number; });
}

/// Monotone in its argument, so every segment that reaches the height `scaled_v` is listed in the band found for it.
int TrimmingRegion::band(double scaled_v) const {
    const int count = static_cast<int>(band_start_.size()) - 1;
    if (!(scaled_v > banded_.low)) return 0;
    if (scaled_v >= banded_.high) return count - 1;
    return std::min(count - 1, static_cast<int>((scaled_v - banded_.low) / banded_.length() * count));
}

Vector2 TrimmingRegion::curve_point(const TrimmingCurve& curve, double t) const {
    const Vector2 native = curve.curve.value(t);
    return {u_map_.surface(native.x()), v_map_.surface(native.y())};
}

Containment TrimmingRegion::classify(double u, double v, double radius) const {
    const Vector2 p = scaled(domain_, {u, v});
    if (whole_domain_) {
        const double inward = std::min({p.x(), 1 - p.x(), p.y(), 1 - p.y()});
        return inward < -radius ? Containment::outside : inward <= radius ? Containment::boundary : Containment::inside;
    }
    const double near = radius + polyline_deviation;
    for (int i = band(p.y() - near), last = band(p.y() + near); i <= last; ++i)
        for (int at = band_start_[i]; at < band_start_[i + 1]; ++at) {
            const auto& [a, b] = segments_[in_band_[at]];
            const bool beside = p.x() >= std::min(a.x(), b.x()) - near && p.x() <= std::max(a.x(), b.x()) + near &&
                                p.y() >= std::min(a.y(), b.y()) - near && p.y() <= std::max(a.y(), b.y()) + near;
            if (beside && segment_distance(p, a, b) <= near) return Containment::boundary;
        }
    bool inside = false;
    const int own = band(p.y());
    for (int at = band_start_[own]; at < band_start_[own + 1]; ++at) {
        const auto& [a, b] = segments_[in_band_[at]];
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
            inside = !inside;
    }
    return inside ? Containment::inside : Containment::outside;
}

}  // namespace umbilic
