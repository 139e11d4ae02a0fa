// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/model/face_border.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace umbilic {

namespace {

/// Samples of one polynomial piece of a border curve from which a search starts.
constexpr int samples_per_span = 4;
/// A range is sampled at least and at most this often.
constexpr int fewest_samples = 9;
constexpr int most_samples = 400;

/// Gauss-Newton steps; on a curve that passes close by each one squares the error.
constexpr int most_steps = 20;
constexpr double smallest_step = 4 * std::numeric_limits<double>::epsilon();

/// Distances from a border curve, relative to the box of the border, at which the two sides of it are looked at.
constexpr std::array<double, 4> side_steps = {1e-3, 1e-2, 1e-4, 1e-5};

BorderPoint at(const Face& face, const TrimmingCurve& curve, int loop, int index, double t) {
    const BoundaryPoint b = boundary_point(face.surface, face.region, curve, t);
    return {face.number, loop, index, t, b.parameters, b.r, b.r_t, 0.0};
}

int sample_count(const TrimmingCurve& curve, const ParameterInterval& range) {
    const std::vector<double>& breaks = curve.curve.knots().breaks();
    const auto first = std::upper_bound(breaks.begin(), breaks.end(), range.low);
    const auto last = std::lower_bound(breaks.begin(), breaks.end(), range.high);
    const int spans = 1 + std::max(0, static_cast<int>(last - first));
    return std::clamp(samples_per_span * spans + 1, fewest_samples, most_samples);
}

/// Gauss-Newton from `t` on the squared length of the residual that `evaluate(t)` returns with its derivative; steps
/// that do not shorten it are halved.
template <class Evaluate>
double descend(const Evaluate& evaluate, const ParameterInterval& range, double t) {
    auto [residual, slope] = evaluate(t);
    for (int i = 0; i < most_steps; ++i) {
        const double squared_slope = slope.squaredNorm();
        if (!(squared_slope > 0.0)) break;
        double step = -residual.dot(slope) / squared_slope;
        bool moved = false;
        for (int halving = 0; halving < most_steps; ++halving, step *= 0.5) {
            const double next = range.clamp(t + step);
            if (std::abs(next - t) <= smallest_step * range.length()) break;
            const auto [r, s] = evaluate(next);
            if (r.squaredNorm() >= residual.squaredNorm()) continue;
            t = next;
            residual = r;
            slope = s;
            moved = true;
            break;
        }
        if (!moved) break;
    }
    return t;
}

}  // namespace

std::vector<TrimmingLoop> border_loops(const Face& face) {
    if (!face.region.loops().empty()) return face.region.loops();
    const ParameterBox box = face.surface.domain();
    const std::array<Vector2, 5> corners = {Vector2(box.u.low, box.v.low), Vector2(box.u.high, box.v.low),
                                            Vector2(box.u.high, box.v.high), Vector2(box.u.low, box.v.high),
                                            Vector2(box.u.low, box.v.low)};
    TrimmingLoop loop;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i)
        loop.push_back({NurbsCurve2(KnotVector::bezier(1), {corners[i], corners[i + 1]})});
    return {loop};
}

bool face_on_left(const Face& face, const TrimmingCurve& curve, const ParameterInterval& range) {
    const BoundaryPoint middle = boundary_point(face.surface, face.region, curve, range.middle());
    const ParameterBox domain = face.surface.domain(), box = face.region.box();
    const Vector2 sides(domain.u.length(), domain.v.length());
    const Vector2 along = middle.parameters_t.cwiseQuotient(sides);
    const bool by_rule = !curve.reversed;
    if (!(along.norm() > 0.0)) return by_rule;
    const Vector2 left = Vector2(-along.y(), along.x()).normalized();
    const double extent = std::min(box.u.length() / sides.x(), box.v.length() / sides.y());
    for (const double step : side_steps) {
        const Vector2 offset = (step * extent * left).cwiseProduct(sides);
        const Vector2 p = middle.parameters + offset, q = middle.parameters - offset;
        const Containment here = face.region.classify(p.x(), p.y()), there = face.region.classify(q.x(), q.y());
        if (here == Containment::inside && there == Containment::outside) return true;
        if (here == Containment::outside && there == Containment::inside) return false;
    }
    return by_rule;
}

BorderPoint nearest_in_space(const Face& face, const std::vector<TrimmingLoop>& loops, const BorderPiece& piece,
                             const Vector3& point, double guess, double good_enough) {
    const TrimmingCurve& curve = loops[piece.loop][piece.curve];
    const auto evaluate = [&](double t) {
        const BoundaryPoint b = boundary_point(face.surface, face.region, curve, t);
        return std::pair<Vector3, Vector3>(b.r - point, b.r_t);
    };
    const auto result = [&](double t) {
        BorderPoint found = at(face, curve, piece.loop, piece.curve, t);
        found.distance = (found.point - point).norm();
        return found;
    };
    const BorderPoint first = result(descend(evaluate, piece.range, piece.range.clamp(guess)));
    if (first.distance <= good_enough) return first;
    const int count = sample_count(curve, piece.range);
    double best = first.t, shortest = first.distance;
    for (int i = 0; i < count; ++i) {
        const double t = piece.range.low + piece.range.length() * i / (count - 1);
        const double distance = evaluate(t).first.norm();
        if (distance < shortest) {
            shortest = distance;
            best = t;
        }
    }
    return result(descend(evaluate, piece.range, best));
}

BorderPoint nearest_in_parameters(const Face& face, const std::vector<TrimmingLoop>& loops, const Vector2& parameters) {
    const ParameterBox domain = face.surface.domain();
    const Vector2 sides(domain.u.length(), domain.v.length());
    int best_loop = 0, best_curve = 0;
    double best = 0.0, shortest = std::numeric_limits<double>::infinity();
    ParameterInterval around;
    for (int loop = 0; loop < static_cast<int>(loops.size()); ++loop)
        for (int index = 0; index < static_cast<int>(loops[loop].size()); ++index) {
            const TrimmingCurve& curve = loops[loop][index];
            const ParameterInterval range = curve.curve.domain();
            const int count = sample_count(curve, range);
            Vector2 before;
            for (int i = 0; i < count; ++i) {
                const double t = range.low + range.length() * i / (count - 1);
                const Vector2 here = (face.region.curve_point(curve, t) - parameters).cwiseQuotient(sides);
                if (i > 0) {
                    // Nearest point of the chord.
                    const Vector2 along = here - before;
                    const double squared = along.squaredNorm();
                    const double share = squared > 0.0 ? std::clamp(-before.dot(along) / squared, 0.0, 1.0) : 0.0;
                    const double distance = (before + share * along).norm();
                    if (distance < shortest) {
                        shortest = distance;
                        best_loop = loop;
                        best_curve = index;
                        const double width = range.length() / (count - 1);
                        best = t - width * (1 - share);
                        around = {range.clamp(t - 2 * width), range.clamp(t + width)};
                    }
                }
                before = here;
            }
        }
    const TrimmingCurve& curve = loops[best_loop][best_curve];
    const auto evaluate = [&](double t) {
        const BoundaryPoint b = boundary_point(face.surface, face.region, curve, t);
        return std::pair<Vector2, Vector2>((b.parameters - parameters).cwiseQuotient(sides),
                                           b.parameters_t.cwiseQuotient(sides));
    };
    const double t = descend(evaluate, around, best);
    BorderPoint found = at(face, curve, best_loop, best_curve, t);
    found.distance = evaluate(t).first.norm();
    return found;
}

}  // namespace umbilic
