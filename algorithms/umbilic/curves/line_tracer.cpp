// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/line_tracer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

namespace umbilic {

namespace {

using State = std::array<double, 2>;
using Stepper = boost::numeric::odeint::runge_kutta_dopri5<State>;

/// Step control: the local error is of order 5 in the length of the step.
constexpr double safety = 0.9, least_factor = 0.2, greatest_factor = 5.0;
constexpr int error_order = 5;
/// Steps shorter than this times size end a line.
constexpr double shortest_step = 1e-13;
/// Where steps become that short, a relative spread below this means an umbilic, otherwise a failure.
constexpr double near_umbilic = 1e-2;
/// Two pieces of a surface meet smoothly if the cosine between their normals is above this (2.6 degrees).
constexpr double smooth_cosine = 0.999;
/// The direction goes on from piece to piece if the cosine between the tangents is above this (45 degrees).
constexpr double forward_cosine = 0.7;
/// Places on a step at which the trimming loops are asked, and halvings to find the crossing.
constexpr int trim_samples = 4, halvings = 50;
/// Steps of Newton's method for the length of the last step of a line or piece.
constexpr int cut_corrections = 3;
/// They end at this share of the error allowed in a step.
constexpr double relative_cut = 1e-4;
/// A line meets a knot line, and does not run along it, if the sine of the angle between them is above this.
constexpr double meeting_sine = 1e-6;
/// Rounding of a parameter relative to its domain.
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();

Vector2 vector(const State& x) {
    return {x[0], x[1]};
}
State state(const Vector2& x) {
    return {x.x(), x.y()};
}

const ParameterInterval& side(const ParameterBox& box, int k) {
    return k == 0 ? box.u : box.v;
}

/// The state of one run along a line.
struct LineRun {
    const FaceLineField& field;
    CurvatureFamily family;
    const TraceOptions& options;
    TracedLine line;

    std::array<int, 2> piece = {0, 0};
    Vector2 x = Vector2::Zero();
    double s = 0.0;
    FieldValue here;        ///< at x
    Vector3 tangent;        ///< at x, in the direction of the run
    Vector3 start_tangent;  ///< the same at the start of the last step
    FieldValue latest;      ///< at the last evaluation
    Vector3 latest_tangent;
    Stepper stepper;
    double step = 0.0;
    Vector3 first_point, first_tangent;
    int asked = 1;  ///< multiple of stop_spacing at which to ask next whether to stop

    const NurbsSurface& surface() const { return field.face().surface; }

    /// The field at `parameters`, turned so that it goes on in the direction of the run.
    Vector2 rates(const Vector2& parameters) {
        latest = field.piece_value(piece, parameters, family);
        latest_tangent = latest.tangent.dot(tangent) < 0.0 ? Vector3(-latest.tangent) : latest.tangent;
        return latest.rates(latest_tangent);
    }

    /// What the piece carries.
    ParameterBox piece_box() const {
        const auto range = [&](int k) {
            const auto [first, last] = field.carried(k, piece[k]);
            return ParameterInterval{field.breaks(k)[first], field.breaks(k)[last]};
        };
        return {range(0), range(1)};
    }

    bool begin(const Vector2& start, const Vector3& direction) {
        x = start;
        piece = field.piece_at(x);
        tangent = direction;
        // On a knot line (or at the end of the domain) the run may lead into the piece before.
        const Vector2 rate = rates(x);
        for (int k = 0; k < 2; ++k)
            if (const int first = field.carried(k, piece[k])[0];
                first > 0 && x[k] <= field.breaks(k)[first] && rate[k] < 0.0)
                piece[k] = field.carrier(k, first - 1);
        rates(x);
        here = latest;
        tangent = latest_tangent;
        first_point = here.point;
        first_tangent = tangent;
        step = options.longest_step;
        return !field.indeterminate(here);
    }

    /// Tries a step of length `step` at most; on success it is appended to the line, which then ends at x, and its
    /// exit from the piece is not yet looked at. False if the line cannot go on.
    bool advance() {
        start_tangent = tangent;
        const State x0 = state(x), d0 = state(here.rates(tangent));
        while (true) {
            const double h = std::min(step, options.length - s);
            State x1, d1, error;
            stepper.do_step([&](const State& at, State& rate, double) { rate = state(rates(vector(at))); }, x0, d0, s,
                            x1, d1, h, error);
            const double distance = (latest.r_u * error[0] + latest.r_v * error[1]).norm();
            // Within one step the direction must not turn by more than a right angle.
            const bool sound =
                std::isfinite(distance) && latest.regular && latest_tangent.dot(tangent) > forward_cosine;
            double factor = least_factor;
            if (sound)
                factor = distance > 0.0 ? std::clamp(safety * std::pow(options.tolerance / distance, 1.0 / error_order),
                                                     least_factor, greatest_factor)
                                        : greatest_factor;
            if (sound && distance <= options.tolerance) {
                State middle;
                stepper.calc_state(s + 0.5 * h, middle, x0, d0, s, x1, d1, s + h);
                line.steps.push_back({.s = s,
                                      .length = h,
                                      .piece = piece,
                                      .start = x,
                                      .end = vector(x1),
                                      .start_rate = vector(d0),
                                      .end_rate = vector(d1),
                                      .middle = vector(middle)});
                line.error += distance;
                x = vector(x1);
                s += h;
                here = latest;
                tangent = latest_tangent;
                step = std::min(h * factor, options.longest_step);
                return true;
            }
            step = h * std::min(factor, safety);
            if (step < shortest_step * field.size()) {
                line.stuck = here.regular && here.spread > near_umbilic * field.spread_scale(here);
                line.ended = CurveEnd::umbilic;
                return false;
            }
        }
    }

    /// Cuts the last step at the fraction `t`: integrates it anew with that length, then corrects the length by
    /// Newton's method until `excess(x)`, whose derivative by arc length is `slope(rate)`, vanishes.
    template <class Excess, class Slope>
    void cut(double t, const Excess& excess, const Slope& slope) {
        TracedStep& last = line.steps.back();
        double h = t * last.length;
        tangent = start_tangent;
        piece = last.piece;
        const State x0 = state(last.start), d0 = state(last.start_rate);
        const double enough = std::max(rounding * h, relative_cut * options.tolerance);
        for (int i = 0; i < cut_corrections; ++i) {
            State x1, d1, middle;
            stepper.do_step([&](const State& at, State& rate, double) { rate = state(rates(vector(at))); }, x0, d0,
                            last.s, x1, d1, h);
            stepper.calc_state(last.s + 0.5 * h, middle, x0, d0, last.s, x1, d1, last.s + h);
            last.length = h;
            last.end = vector(x1);
            last.end_rate = vector(d1);
            last.middle = vector(middle);
            const double correction = excess(last.end) / slope(last.end_rate);
            if (!(std::abs(correction) < 0.1 * h) || std::abs(correction) <= enough) break;
            h -= correction;
        }
        s = last.s + last.length;
        x = last.end;
        rates(x);
        here = latest;
        tangent = latest_tangent;
    }

    /// Cuts the last step at the fraction `t` as it stands.
    void cut(double t) {
        cut(
            t, [](const Vector2&) { return 0.0; }, [](const Vector2&) { return 1.0; });
    }

    /// First fraction of the last step at which coordinate k reaches `bound`, which its end has passed.
    double crossing(int k, double bound) const {
        const TracedStep& last = line.steps.back();
        double low = 0.0, high = 1.0;
        const bool rising = last.end[k] > bound;
        for (int i = 0; i < halvings; ++i) {
            const double middle = 0.5 * (low + high);
            ((last.at(middle)[k] > bound) == rising ? high : low) = middle;
        }
        return high;
    }

    /// Leaves the piece where the last step passes its border. False if the line ends there.
    bool leave_piece() {
        while (true) {
            const ParameterBox box = piece_box();
            int k = -1;
            double t = 2.0;
            bool up = false;
            for (int i = 0; i < 2; ++i) {
                const ParameterInterval& range = side(box, i);
                const double slack = rounding * side(surface().domain(), i).length();
                if (x[i] >= range.low - slack && x[i] <= range.high + slack) continue;
                const double at = crossing(i, x[i] > range.high ? range.high : range.low);
                if (at < t) {
                    t = at;
                    k = i;
                    up = x[i] > range.high;
                }
            }
            if (k < 0) return true;
            const double bound = up ? side(box, k).high : side(box, k).low;
            cut(
                t, [&](const Vector2& p) { return p[k] - bound; }, [&](const Vector2& rate) { return rate[k]; });
            x[k] = line.steps.back().end[k] = bound;
            if (!enter_next(k, up)) return false;
            return true;
        }
    }

    /// Sine of the angle from the knot line on which parameter k is constant to a tangent; positive where k grows.
    static double across(const FieldValue& at, const Vector3& direction, int k) {
        const Vector3 along = (k == 0 ? at.r_v : at.r_u).normalized();
        const double sine = along.cross(direction).norm();
        return at.rates(direction)[k] < 0.0 ? -sine : sine;
    }

    /// Goes on into the piece beyond the knot line on which x lies. False if there is none.
    bool enter_next(int k, bool up) {
        const int pieces = static_cast<int>(field.breaks(k).size()) - 1;
        const Vector3 point = here.point, normal = here.normal;
        const auto [first, last] = field.carried(k, piece[k]);
        int next = up ? last : first - 1;
        if (next < 0 || next >= pieces) {
            if (!field.closed(k)) {
                line.ended = field.indeterminate(here) ? CurveEnd::umbilic : CurveEnd::boundary;
                return false;
            }
            next = up ? 0 : pieces - 1;
            x[k] = up ? field.breaks(k).front() : field.breaks(k).back();
        }
        piece[k] = field.carrier(k, next);
        rates(x);
        const bool joined = (latest.point - point).norm() <= 1e-6 * field.size();
        if (!joined || !latest.regular || latest.normal.dot(normal) < smooth_cosine) {
            line.ended = CurveEnd::boundary;
            return false;
        }
        // Where curvature jumps, the directions of both pieces may lead to the knot line: no line goes on from there.
        const double sense = up ? 1.0 : -1.0;
        const bool thrown_back = sense * across(latest, latest_tangent, k) < -meeting_sine;
        if (field.indeterminate(latest) || latest_tangent.dot(tangent) < forward_cosine || thrown_back) {
            line.ended = CurveEnd::umbilic;
            return false;
        }
        here = latest;
        tangent = latest_tangent;
        return true;
    }

    /// Ends the line where its last step crosses a trimming loop.
    bool crosses_loop() {
        const TrimmingRegion& region = field.face().region;
        if (region.whole_domain()) return false;
        const TracedStep& last = line.steps.back();
        const auto outside = [&](double t) {
            const Vector2 p = field.wrapped(last.at(t));
            return region.classify(p.x(), p.y()) == Containment::outside;
        };
        double low = 0.0;
        for (int i = 1; i <= trim_samples; ++i) {
            double high = static_cast<double>(i) / trim_samples;
            if (!outside(high)) {
                low = high;
                continue;
            }
            for (int n = 0; n < halvings; ++n) {
                const double middle = 0.5 * (low + high);
                (outside(middle) ? high : low) = middle;
            }
            if (low <= 0.0) {
                line.steps.pop_back();
            } else {
                cut(low);
            }
            line.ended = CurveEnd::trim;
            return true;
        }
        return false;
    }

    /// Whether the line shall end, by what is seen on its last step.
    bool stops() {
        if (!options.stop || !(options.stop_spacing > 0.0) || line.steps.empty()) return false;
        const TracedStep& last = line.steps.back();
        for (; asked * options.stop_spacing <= last.s + last.length; ++asked) {
            const double share = std::clamp((asked * options.stop_spacing - last.s) / last.length, 0.0, 1.0);
            if (!options.stop(field.piece_value(last.piece, last.at(share), family))) continue;
            line.stopped = asked * options.stop_spacing;
            line.ended = CurveEnd::length;
            return true;
        }
        return false;
    }

    /// Ends the line where its last step passes its first point.
    bool closes() {
        if (!options.close || line.steps.size() < 2) return false;
        const TracedStep& last = line.steps.back();
        const auto ahead = [&](double t) {
            const Vector2 p = last.at(t);
            return (surface().piece_derivatives(last.piece[0], last.piece[1], p.x(), p.y(), 0).r() - first_point)
                .dot(first_tangent);
        };
        // A step is short against the line's radius, so the start can only be passed where both ends are near.
        if ((here.point - first_point).norm() > 2 * last.length || s < 4 * options.closing_distance) return false;
        if (!(ahead(0.0) < 0.0 && ahead(1.0) >= 0.0)) return false;
        double low = 0.0, high = 1.0;
        for (int n = 0; n < halvings; ++n) {
            const double middle = 0.5 * (low + high);
            (ahead(middle) >= 0.0 ? high : low) = middle;
        }
        const Vector2 p = last.at(high);
        const Vector3 there = surface().piece_derivatives(last.piece[0], last.piece[1], p.x(), p.y(), 0).r();
        if ((there - first_point).norm() > options.closing_distance) return false;
        cut(
            high,
            [&](const Vector2& q) {
                return (surface().piece_derivatives(last.piece[0], last.piece[1], q.x(), q.y(), 0).r() - first_point)
                    .dot(first_tangent);
            },
            [](const Vector2&) { return 1.0; });
        line.ended = CurveEnd::closed;
        return true;
    }
};

}  // namespace

Vector2 TracedStep::at(double x) const {
    const double y = 1 - x;
    const auto cubic = [&](double t) -> Vector2 {
        const double w = 1 - t;
        return w * w * (1 + 2 * t) * start + t * t * (3 - 2 * t) * end +
               length * t * w * (w * start_rate - t * end_rate);
    };
    return cubic(x) + 16 * x * x * y * y * (middle - cubic(0.5));
}

Vector2 TracedStep::rate(double x) const {
    const double y = 1 - x;
    const Vector2 half = 0.5 * (start + end) + 0.125 * length * (start_rate - end_rate);
    const Vector2 slope = 6 * x * y * (end - start) +
                          length * (y * (1 - 3 * x) * start_rate - x * (2 - 3 * x) * end_rate) +
                          32 * x * y * (1 - 2 * x) * (middle - half);
    return slope / length;
}

std::size_t TracedLine::step_at(double s) const {
    const auto next = std::upper_bound(steps.begin(), steps.end(), s,
                                       [](double value, const TracedStep& step) { return value < step.s; });
    return next == steps.begin() ? 0 : static_cast<std::size_t>(next - steps.begin()) - 1;
}

Vector2 TracedLine::at(double s) const {
    const TracedStep& step = steps[step_at(s)];
    return step.at(std::clamp((s - step.s) / step.length, 0.0, 1.0));
}

TracedLine LineTracer::trace(const Vector2& start, CurvatureFamily family, const Vector3& direction,
                             const TraceOptions& options, const Progress& progress) const {
    LineRun run{.field = *this, .family = family, .options = options};
    if (!run.begin(start, direction)) {
        run.line.ended = CurveEnd::umbilic;
        return run.line;
    }
    while (true) {
        progress.check();
        if (run.s >= options.length * (1 - rounding)) break;
        if (run.line.steps.size() >= options.most_steps) {
            run.line.ended = CurveEnd::umbilic;
            run.line.stuck = true;
            break;
        }
        if (!run.advance()) break;
        const bool within = run.leave_piece();
        const bool ends = run.crosses_loop() || run.closes() || !within;
        if (run.stops() || ends) break;
        if (indeterminate(run.here)) {
            run.line.ended = CurveEnd::umbilic;
            break;
        }
    }
    run.line.length = run.line.steps.empty() ? 0.0 : run.line.steps.back().s + run.line.steps.back().length;
    run.line.end_tangent = run.tangent;
    return run.line;
}

}  // namespace umbilic
