// SPDX-License-Identifier: LGPL-2.1-or-later
#include <support/mapped_trimming.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace umbilic::support {

namespace {

/// Accuracy of copied trimming curves, relative to the domain; halvings of a piece of them at most; steps of their
/// differences, relative to a piece.
constexpr double loop_accuracy = 1e-11;
constexpr int most_loop_halvings = 12;
constexpr double loop_difference = 1e-2;

/// Adds to the breaks of a curve the parameters at which its coordinate `at` passes a value.
void add_crossings(double value, const std::function<double(double)>& at, std::vector<double>& breaks) {
    constexpr int samples = 64, bisections = 60;
    const std::vector<double> spans = breaks;
    for (std::size_t i = 0; i + 1 < spans.size(); ++i)
        for (int k = 0; k < samples; ++k) {
            double low = spans[i] + (spans[i + 1] - spans[i]) * k / samples;
            double high = spans[i] + (spans[i + 1] - spans[i]) * (k + 1) / samples;
            const bool rises = at(low) < value;
            if (rises == (at(high) < value)) continue;
            for (int n = 0; n < bisections; ++n) {
                const double middle = 0.5 * (low + high);
                ((at(middle) < value) == rises ? low : high) = middle;
            }
            if (low > spans[i] && high < spans[i + 1]) breaks.push_back(high);
        }
    std::sort(breaks.begin(), breaks.end());
}

/// A curve of the parameter plane as cubic pieces, halved until each meets its middle within `loop_accuracy` of the
/// sides of `domain`.
class CubicCopy {
public:
    CubicCopy(std::function<Vector2(double)> at, const ParameterBox& domain) : at_(std::move(at)), domain_(domain) {}

    NurbsCurve2 over(const std::vector<double>& breaks) {
        poles_ = {at_(breaks.front())};
        knots_ = {breaks.front()};
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            const double middle = 0.5 * (breaks[i] + breaks[i + 1]);
            add(breaks[i], middle, 1);
            add(middle, breaks[i + 1], 1);
        }
        std::vector<double> all(1, knots_.front());
        for (const double knot : knots_) all.insert(all.end(), 3, knot);
        all.push_back(knots_.back());
        return NurbsCurve2(KnotVector(3, std::move(all)), std::move(poles_));
    }

private:
    void add(double low, double high, int halvings) {
        const double h = high - low, middle = 0.5 * (low + high);
        const Vector2 p = poles_.back(), q = at_(high);
        const Vector2 from = p + h / 3 * rate(low, loop_difference * h),
                      to = q - h / 3 * rate(high, -loop_difference * h);
        const Vector2 miss = 0.125 * (p + 3 * from + 3 * to + q) - at_(middle);
        const bool meets = std::abs(miss.x()) <= loop_accuracy * domain_.u.length() &&
                           std::abs(miss.y()) <= loop_accuracy * domain_.v.length();
        if (!meets && halvings < most_loop_halvings) {
            add(low, middle, halvings + 1);
            add(middle, high, halvings + 1);
            return;
        }
        poles_.insert(poles_.end(), {from, to, q});
        knots_.push_back(high);
    }

    /// Derivative towards the side of `step`, of the fourth order in it.
    Vector2 rate(double t, double step) const {
        return (-25 * at_(t) + 48 * at_(t + step) - 36 * at_(t + 2 * step) + 16 * at_(t + 3 * step) -
                3 * at_(t + 4 * step)) /
               (12 * step);
    }

    std::function<Vector2(double)> at_;
    ParameterBox domain_;
    std::vector<Vector2> poles_;
    std::vector<double> knots_;
};

/// The curve, given in native parameters of `region`, in the parameters to which `map` takes surface parameters.
NurbsCurve2 mapped(const TrimmingRegion& region, const TrimmingCurve& trimming, const ParameterBox& domain,
                   const PointMap& map, bool affine, std::optional<double> bend) {
    const NurbsCurve2& curve = trimming.curve;
    if (affine && region.u_map().identity() && region.v_map().identity()) {
        std::vector<Vector2> poles;
        for (const Vector2& pole : curve.poles()) poles.push_back(map(pole));
        return NurbsCurve2(curve.knots(), std::move(poles), curve.weights());
    }
    // Maps that are not affine still take lines of constant u and of constant v to such lines.
    const std::vector<Vector2>& poles = curve.poles();
    const bool straight =
        std::all_of(poles.begin(), poles.end(), [&](const Vector2& p) { return p.x() == poles[0].x(); }) ||
        std::all_of(poles.begin(), poles.end(), [&](const Vector2& p) { return p.y() == poles[0].y(); });
    std::vector<double> breaks = curve.knots().breaks();
    if (bend)
        add_crossings(
            *bend, [&](double t) { return region.curve_point(trimming, t).x(); }, breaks);
    const auto at = [&](double t) { return map(region.curve_point(trimming, t)); };
    if (straight)
        return NurbsCurve2(KnotVector(1, {breaks.front(), breaks.front(), breaks.back(), breaks.back()}),
                           {at(breaks.front()), at(breaks.back())});
    return CubicCopy(at, domain).over(breaks);
}

}  // namespace

TrimmingRegion mapped(const TrimmingRegion& region, const ParameterBox& domain, const PointMap& map, bool affine,
                      std::optional<double> bend) {
    if (region.loops().empty()) return TrimmingRegion(domain);
    std::vector<TrimmingLoop> loops;
    for (const TrimmingLoop& loop : region.loops()) {
        TrimmingLoop result;
        for (const TrimmingCurve& curve : loop) {
            TrimmingCurve image = curve;
            image.curve = mapped(region, curve, domain, map, affine, bend);
            result.push_back(std::move(image));
        }
        loops.push_back(std::move(result));
    }
    return TrimmingRegion(domain, std::move(loops), {}, {});
}

}  // namespace umbilic::support
