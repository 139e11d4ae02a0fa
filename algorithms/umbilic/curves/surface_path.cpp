// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/surface_path.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <Eigen/Geometry>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <umbilic/core/errors.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

namespace {

using Stepper = boost::numeric::odeint::runge_kutta_dopri5<PathState>;

/// Step control: the local error is of order 5 in the length of the step.
constexpr double safety = 0.9, least_factor = 0.2, greatest_factor = 5.0;
constexpr int error_order = 5;
/// Steps shorter than this times the length of the path end it.
constexpr double shortest_step = 1e-13;
/// Two pieces of a surface meet smoothly if the cosine between their normals is above this (2.6 degrees).
constexpr double smooth_cosine = 0.999;
/// Two pieces meet at all if their points are nearer than this, relative to sqrt(area).
constexpr double joined = 1e-6;
/// Places on a step at which the trimming loops are asked, and halvings to find a crossing.
constexpr int trim_samples = 4, halvings = 50;
/// Rounding of a parameter relative to its domain.
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
/// Borders crossed one after the other without a step between them: more of them is a corner.
constexpr int most_crossings = 4;

const ParameterInterval& side(const ParameterBox& box, int k) {
    return k == 0 ? box.u : box.v;
}

Vector2 parameters_of(const PathState& y, int chart) {
    return {y[chart_components[chart]], y[chart_components[chart] + 1]};
}

const KnotVector& knots(const Face& face, int k) {
    return k == 0 ? face.surface.u_knots() : face.surface.v_knots();
}

bool closed(const Face& face, int k) {
    return k == 0 ? face.u_closed || face.u_periodic : face.v_closed || face.v_periodic;
}

int piece_count(const Face& face, int k) {
    return static_cast<int>(knots(face, k).breaks().size()) - 1;
}

FacePiece piece_at(const Face& face, const Vector2& parameters) {
    return {&face, {knots(face, 0).piece(parameters.x()), knots(face, 1).piece(parameters.y())}};
}

ParameterBox box_of(const FacePiece& piece) {
    const std::vector<double>& u = knots(*piece.face, 0).breaks();
    const std::vector<double>& v = knots(*piece.face, 1).breaks();
    return {{u[piece.piece[0]], u[piece.piece[0] + 1]}, {v[piece.piece[1]], v[piece.piece[1] + 1]}};
}

/// The state of one integration.
struct Run {
    const PathSystem& system;
    const SurfacePathOptions& options;
    std::array<FacePiece, 2> pieces{};
    std::array<double, 2> sizes{};
    PathState y{};
    double s = 0.0, step = 0.0;
    ChartSurfaces surfaces{};
    std::optional<CurveEnd> undefined{};  ///< of the last evaluation
    Stepper stepper{};
    SurfacePath path{};
    int crossings = 0;

    bool evaluate(const PathState& state) {
        bool sound = true;
        for (int chart = 0; chart < system.charts; ++chart) {
            surfaces[chart] = pieces[chart].derivatives(parameters_of(state, chart));
            sound = sound && surfaces[chart].r().allFinite();
        }
        return sound;
    }

    PathState rates(double at, const PathState& state) {
        PathState rate{};
        const bool sound = evaluate(state);
        undefined = sound ? system.rates(at, state, surfaces, rate) : CurveEnd::boundary;
        return rate;
    }

    /// On a knot line the run may lead into the piece before.
    void settle() {
        const PathState rate = rates(s, y);
        for (int chart = 0; chart < system.charts; ++chart)
            for (int k = 0; k < 2; ++k) {
                const int at = chart_components[chart] + k;
                int& piece = pieces[chart].piece[k];
                if (piece > 0 && y[at] <= side(box_of(pieces[chart]), k).low && rate[at] < 0.0) --piece;
            }
    }

    double next_break() const {
        const auto next = std::upper_bound(options.breaks.begin(), options.breaks.end(), s * (1 + rounding));
        return next == options.breaks.end() ? options.length : std::min(*next, options.length);
    }

    /// One step. False if the path ends before it.
    bool advance() {
        if (system.begin_step) {
            evaluate(y);
            system.begin_step(s, surfaces);
        }
        const PathState rate0 = rates(s, y);
        if (undefined) {
            path.ended = *undefined;
            return false;
        }
        const double limit = next_break();
        while (true) {
            const double h = std::min(step, limit - s);
            PathState y1{}, rate1{}, difference{};
            std::optional<CurveEnd> end;
            stepper.do_step(
                [&](const PathState& at, PathState& rate, double t) {
                    rate = rates(t, at);
                    if (!end) end = undefined;
                },
                y, rate0, s, y1, rate1, h, difference);
            const double error = end ? 0.0 : system.error(difference, surfaces);
            const bool sound = !end && std::isfinite(error);
            double factor = least_factor;
            if (sound)
                factor = error > 0.0 ? std::clamp(safety * std::pow(options.tolerance / error, 1.0 / error_order),
                                                  least_factor, greatest_factor)
                                     : greatest_factor;
            if (sound && error <= options.tolerance) {
                PathState middle{};
                stepper.calc_state(s + 0.5 * h, middle, y, rate0, s, y1, rate1, s + h);
                path.steps.push_back({s, h, pieces, y, y1, rate0, rate1, middle});
                path.error += error;
                y = y1;
                s += h;
                // A step shortened by a break says nothing about the length the error allows.
                step = std::min(h < step ? std::max(step, h * factor) : h * factor, options.longest_step);
                return true;
            }
            step = h * std::min(factor, safety);
            if (step < shortest_step * options.length) {
                if (!end)
                    throw NumericFailure("face " + std::to_string(pieces[0].face->number) +
                                         ": a curve cannot be continued at u = " + std::to_string(y[0]) +
                                         ", v = " + std::to_string(y[1]) + "; the surface is not smooth enough there");
                path.ended = *end;
                return false;
            }
        }
    }

    /// Cuts the last step at the fraction x.
    void cut(double x) {
        PathStep& last = path.steps.back();
        const PathState end = last.at(x), middle = last.at(0.5 * x), rate = last.rate(x);
        last.end = end;
        last.middle = middle;
        last.end_rate = rate;
        last.length *= x;
        s = last.s + last.length;
        y = end;
    }

    /// Fraction of the last step at which `beyond` becomes true, up to which it is false; its end is beyond.
    template <class Beyond>
    double crossing(double low, double high, const Beyond& beyond, bool after) const {
        for (int i = 0; i < halvings; ++i) {
            const double middle = 0.5 * (low + high);
            (beyond(path.steps.back().at(middle)) ? high : low) = middle;
        }
        return after ? high : low;
    }

    bool outside_loops(int chart, const PathState& state) const {
        const Vector2 p = parameters_of(state, chart);
        return pieces[chart].face->region.classify(p.x(), p.y()) == Containment::outside;
    }

    /// Ends the last step where it first leaves a piece or a face and goes on beyond. False if the path ends there.
    bool handle_events() {
        int chart_of_event = -1, k_of_event = -1;  // k = 2 for a trimming loop
        double first = 2.0;
        const PathStep& last = path.steps.back();
        for (int chart = 0; chart < system.charts; ++chart) {
            const ParameterBox box = box_of(pieces[chart]);
            for (int k = 0; k < 2; ++k) {
                const int at = chart_components[chart] + k;
                const ParameterInterval& range = side(box, k);
                const double slack = rounding * side(pieces[chart].face->surface.domain(), k).length();
                if (y[at] >= range.low - slack && y[at] <= range.high + slack) continue;
                const bool up = y[at] > range.high;
                const double bound = up ? range.high : range.low;
                const double x = crossing(
                    0.0, 1.0, [&](const PathState& state) { return up ? state[at] > bound : state[at] < bound; }, true);
                if (x < first) {
                    first = x;
                    chart_of_event = chart;
                    k_of_event = k;
                }
            }
        }
        for (int chart = 0; chart < system.charts; ++chart) {
            if (pieces[chart].face->region.whole_domain()) continue;
            double low = 0.0;
            for (int i = 1; i <= trim_samples; ++i) {
                const double high = std::min(1.0, first) * i / trim_samples;
                if (!outside_loops(chart, last.at(high))) {
                    low = high;
                    continue;
                }
                const double x = crossing(
                    low, high, [&](const PathState& state) { return outside_loops(chart, state); }, false);
                if (x < first) {
                    first = x;
                    chart_of_event = chart;
                    k_of_event = 2;
                }
                break;
            }
        }
        if (chart_of_event < 0) {
            crossings = 0;
            return true;
        }
        if (first > 0.0) {
            crossings = 0;
            cut(first);
        } else {
            y = path.steps.back().start;
            s = path.steps.back().s;
            path.steps.pop_back();
        }
        if (++crossings > most_crossings) {
            path.ended = CurveEnd::boundary;
            path.ended_chart = chart_of_event;
            return false;
        }
        return k_of_event < 2 ? pass_knot(chart_of_event, k_of_event) : leave_face(chart_of_event, CurveEnd::trim);
    }

    /// Goes on beyond the knot line that component k of a chart has reached.
    bool pass_knot(int chart, int k) {
        const int at = chart_components[chart] + k;
        FacePiece& place = pieces[chart];
        const ParameterInterval range = side(box_of(place), k);
        const bool up = y[at] > range.middle();
        y[at] = up ? range.high : range.low;
        if (!path.steps.empty()) path.steps.back().end[at] = y[at];
        const SurfaceDerivatives before = place.derivatives(parameters_of(y, chart));
        FacePiece next = place;
        next.piece[k] += up ? 1 : -1;
        const int count = piece_count(*place.face, k);
        PathState moved = y;
        if (next.piece[k] < 0 || next.piece[k] >= count) {
            if (!closed(*place.face, k)) return leave_face(chart, CurveEnd::boundary);
            next.piece[k] = up ? 0 : count - 1;
            moved[at] = up ? knots(*place.face, k).domain().low : knots(*place.face, k).domain().high;
        }
        const SurfaceDerivatives after = next.derivatives(parameters_of(moved, chart));
        if (!meets(chart, before, after)) return leave_face(chart, CurveEnd::boundary);
        return enter(chart, next, before, after, moved);
    }

    bool meets(int chart, const SurfaceDerivatives& before, const SurfaceDerivatives& after) const {
        return (after.r() - before.r()).norm() <= joined * sizes[chart] && regular(before) && regular(after) &&
               unit_normal(before).dot(unit_normal(after)) >= smooth_cosine;
    }

    bool enter(int chart, const FacePiece& next, const SurfaceDerivatives& before, const SurfaceDerivatives& after,
               const PathState& moved) {
        y = moved;
        pieces[chart] = next;
        if (system.enter) system.enter(chart, before, after, y);
        return true;
    }

    /// Goes on over a smooth edge; ends the path where there is none.
    bool leave_face(int chart, CurveEnd reason) {
        path.ended = reason;
        path.ended_chart = chart;
        const SmoothJoins* joins = options.joins[chart];
        if (!joins) return false;
        const FaceAdjacency& adjacency = *joins->adjacency;
        const Face& face = *pieces[chart].face;
        const Vector2 here = parameters_of(y, chart);
        const BorderPoint border = nearest_in_parameters(face, adjacency.borders.loops_of(face.number), here);
        const SurfaceDerivatives before = pieces[chart].derivatives(here);
        if (!regular(before)) return false;
        for (const EdgeCrossing& crossing : across(adjacency, border)) {
            if (!joins->smooth[crossing.edge]) continue;
            const Face& other = adjacency.borders.face(crossing.to.face);
            PathState moved = y;
            moved[chart_components[chart]] = crossing.to.parameters.x();
            moved[chart_components[chart] + 1] = crossing.to.parameters.y();
            const FacePiece next = piece_at(other, crossing.to.parameters);
            const SurfaceDerivatives after = next.derivatives(crossing.to.parameters);
            if (!regular(after)) continue;
            sizes[chart] = extent(other);
            enter(chart, next, before, after, moved);
            settle();
            path.ended = CurveEnd::length;
            return true;
        }
        return false;
    }
};

}  // namespace

SmoothJoins smooth_joins(const FaceAdjacency& adjacency, double largest_bend) {
    if (!(std::isfinite(largest_bend) && largest_bend >= 0.0))
        throw InvalidInput("the largest bend of a smooth edge must be an angle of at least 0 radians");
    SmoothJoins result{&adjacency, {}};
    for (const EdgeSmoothness& edge : edge_smoothness(adjacency)) result.smooth.push_back(edge.smooth(largest_bend));
    return result;
}

SurfaceDerivatives FacePiece::derivatives(const Vector2& parameters, int order) const {
    return face->surface.piece_derivatives(piece[0], piece[1], parameters.x(), parameters.y(), order);
}

PathState PathStep::at(double x) const {
    const double w = 1 - x;
    PathState result;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const auto cubic = [&](double t) {
            const double v = 1 - t;
            return v * v * (1 + 2 * t) * start[i] + t * t * (3 - 2 * t) * end[i] +
                   length * t * v * (v * start_rate[i] - t * end_rate[i]);
        };
        result[i] = cubic(x) + 16 * x * x * w * w * (middle[i] - cubic(0.5));
    }
    return result;
}

PathState PathStep::rate(double x) const {
    const double w = 1 - x;
    PathState result;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double half = 0.5 * (start[i] + end[i]) + 0.125 * length * (start_rate[i] - end_rate[i]);
        const double slope = 6 * x * w * (end[i] - start[i]) +
                             length * (w * (1 - 3 * x) * start_rate[i] - x * (2 - 3 * x) * end_rate[i]) +
                             32 * x * w * (1 - 2 * x) * (middle[i] - half);
        result[i] = slope / length;
    }
    return result;
}

const PathStep& SurfacePath::step_at(double s) const {
    const auto next = std::upper_bound(steps.begin(), steps.end(), s,
                                       [](double value, const PathStep& step) { return value < step.s; });
    return next == steps.begin() ? steps.front() : *(next - 1);
}

PathState SurfacePath::at(double s) const {
    const PathStep& step = step_at(s);
    return step.at(step.length > 0.0 ? std::clamp((s - step.s) / step.length, 0.0, 1.0) : 0.0);
}

SurfacePath follow(const PathSystem& system, const PathState& start, const std::array<const Face*, 2>& faces,
                   const SurfacePathOptions& options, const Progress& progress) {
    Run run{.system = system, .options = options, .y = start, .step = options.longest_step};
    for (int chart = 0; chart < system.charts; ++chart) {
        run.pieces[chart] = piece_at(*faces[chart], parameters_of(start, chart));
        run.sizes[chart] = extent(*faces[chart]);
    }
    run.settle();
    while (run.s < options.length * (1 - rounding)) {
        progress.check();
        if (!run.advance()) break;
        if (!run.handle_events()) break;
    }
    run.path.length = run.path.steps.empty() ? 0.0 : run.path.steps.back().s + run.path.steps.back().length;
    return run.path;
}

SurfaceCurve sampled(const SurfacePath& path, int chart, double spacing, bool by_projected_length) {
    SurfaceCurve curve;
    curve.length = path.length;
    curve.error = path.error;
    curve.ended = path.ended;
    const auto add = [&](double s, const PathStep& step, const PathState& y) {
        const Vector2 p = parameters_of(y, chart);
        const SurfacePoint at{step.pieces[chart].face->number, p.x(), p.y()};
        curve.points.push_back(
            {by_projected_length ? y[projected_length] : s, at, step.pieces[chart].derivatives(p, 0).r()});
    };
    double next = 0.0;
    const int parts = spacing > 0.0 ? parts_of(path.length, spacing) : 0;
    int part = 0;
    for (std::size_t i = 0; i < path.steps.size(); ++i) {
        const PathStep& step = path.steps[i];
        const bool new_face = i > 0 && step.pieces[chart].face->number != path.steps[i - 1].pieces[chart].face->number;
        if (i == 0 || new_face) add(step.s, step, step.start);
        const double end = step.s + step.length;
        if (parts == 0) {
            add(end, step, step.end);
            continue;
        }
        const bool last_on_face =
            i + 1 == path.steps.size() || path.steps[i + 1].pieces[chart].face != step.pieces[chart].face;
        for (; part < parts; ++part) {
            next = path.length * (part + 1) / parts;
            if (next > end || part + 1 == parts) break;
            if (next < end || !last_on_face) add(next, step, step.at((next - step.s) / step.length));
        }
        if (last_on_face) add(end, step, step.end);
    }
    if (by_projected_length) curve.length = curve.points.empty() ? 0.0 : curve.points.back().s;
    return curve;
}

double extent(const Face& face) {
    const double size = face.area > 0.0 ? std::sqrt(face.area) : face.surface.pole_box().diagonal();
    if (!(size > 0.0)) throw InvalidInput("face " + std::to_string(face.number) + " has no extent");
    return size;
}

Vector2 tangent_components(const SurfaceDerivatives& d, const Vector3& vector) {
    const auto [E, F, G] = first_form(d);
    const double a = d.r_u().dot(vector), b = d.r_v().dot(vector), determinant = E * G - F * F;
    return {(G * a - F * b) / determinant, (E * b - F * a) / determinant};
}

}  // namespace umbilic
