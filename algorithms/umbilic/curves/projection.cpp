// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/projection.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Dense>

#include <umbilic/core/errors.h>
#include <umbilic/curves/geodesic_path.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

namespace {

/// A given foot is off by at most this, relative to the distance between curve and target plus sqrt(area): the thesis
/// prints four digits.
constexpr double foot_accuracy = 1e-2;
/// Longest step relative to the length of the curve.
constexpr double longest_step = 0.1;
/// As in line_of_curvature: principal curvatures closer than this are the same, and the direction within one step turns
/// by less than 45 degrees.
constexpr double collapse = 1e-6, forward_cosine = 0.7;
/// Points of the first mesh of the boundary value problem (thesis Fig. 3-2) and scale of p and q.
constexpr int mesh_points = 33;

double projected_speed(const SurfaceDerivatives& target, const Vector2& rate) {
    return (target.r_u() * rate.x() + target.r_v() * rate.y()).norm();
}

void check(const ProjectionOptions& options) {
    if (!(std::isfinite(options.tolerance) && options.tolerance > 0.0))
        throw InvalidInput("projection: the tolerance must be finite and positive");
    if (!std::isfinite(options.spacing) || options.spacing < 0.0)
        throw InvalidInput("projection: the spacing must be finite and not negative");
}

void check_length(double length) {
    if (!(std::isfinite(length) && length > 0.0))
        throw InvalidInput("projection: the length must be finite and positive");
}

/// The line from the foot to the point is normal to the surface as far as `foot_accuracy` asks for.
bool orthogonal(const Face& onto, const Vector2& foot, const Vector3& point) {
    const SurfaceDerivatives d = onto.surface.derivatives(foot.x(), foot.y(), 1);
    if (!regular(d)) return false;
    const Vector3 offset = point - d.r(), normal = unit_normal(d);
    return (offset - offset.dot(normal) * normal).norm() <= foot_accuracy * (extent(onto) + offset.norm());
}

/// Foot of the start: the one given, made exact, or the closest point of the face.
Vector2 start_foot(const Face& onto, const Vector3& point, const ProjectionOptions& options, const Progress& progress) {
    if (!point.allFinite()) throw InvalidInput("projection: the curve's start is not finite");
    const std::string where = "projection onto face " + std::to_string(onto.number);
    Vector2 guess;
    if (options.foot) {
        guess = *options.foot;
        check_on_face(onto, guess, where);
        if (!orthogonal(onto, guess, point))
            throw InvalidInput(where +
                               ": the given foot is not that of the curve's start; leave it out to start from "
                               "the closest point");
    } else {
        const std::vector<StationaryPoint> all = feet(onto, point, progress);
        if (all.empty())
            throw InvalidInput(where +
                               ": the curve's start has no orthogonal projection on the face, or a whole curve of "
                               "them; start elsewhere");
        guess = {all.front().at.u, all.front().at.v};
    }
    // At a centre of curvature Newton's method has nothing to improve.
    return foot_point(onto.surface, point, guess).value_or(guess);
}

/// Sign of the evolute margin at the start.
double start_sign(const Face& onto, const Vector2& foot, const Vector3& point) {
    const double margin = evolute_margin(onto.surface.derivatives(foot.x(), foot.y(), 2), point);
    if (!(std::abs(margin) > least_evolute_margin))
        throw NumericFailure("projection onto face " + std::to_string(onto.number) +
                             ": the curve's start lies at a centre of curvature of its foot; start elsewhere");
    return margin > 0.0 ? 1.0 : -1.0;
}

/// Length of a chart's error, mm.
double chart_error(const SurfaceDerivatives& d, const PathState& e, int chart) {
    const int at = chart_components[chart];
    return (d.r_u() * e[at] + d.r_v() * e[at + 1]).norm();
}

/// Measures the projection's error by the feet of the original's points.
void measure(SurfaceCurve& projection, const std::function<Vector3(std::size_t)>& original, const Model* model,
             const Face& onto) {
    double error = 0.0;
    for (std::size_t i = 0; i < projection.points.size(); ++i) {
        const SurfaceCurvePoint& p = projection.points[i];
        const Face& face = model ? model->face(p.at.face) : onto;
        const SurfaceDerivatives d = face.surface.derivatives(p.at.u, p.at.v, 2);
        if (!regular(d)) continue;
        const Vector3 offset = d.r() - original(i);
        const Vector2 residual(offset.dot(d.r_u()), offset.dot(d.r_v()));
        const Vector2 move = projection_matrix(d, original(i)).inverse() * residual;
        error = std::max(error, (d.r_u() * move.x() + d.r_v() * move.y()).norm());
    }
    projection.error = error;
}

const Model* target_model(const ProjectionOptions& options) {
    return options.joins ? options.joins->adjacency->borders.model : nullptr;
}

/// Both charts of a path. They are sampled at the same parameters; a chart that passes to another face adds a point.
ProjectedCurve both(const SurfacePath& path, const Face& onto, const ProjectionOptions& options) {
    ProjectedCurve result;
    result.original = sampled(path, 0, options.spacing);
    result.projection = sampled(path, 1, options.spacing, true);
    result.left_target = path.ended_chart == 1 && (path.ended == CurveEnd::boundary || path.ended == CurveEnd::trim);
    // The originals of the projection's points, whose parameter is not in the curve any more.
    std::vector<Vector3> originals;
    for (const SurfaceCurvePoint& p : sampled(path, 1, options.spacing).points) {
        const PathStep& step = path.step_at(p.s);
        const PathState y = path.at(p.s);
        originals.push_back(step.pieces[0].derivatives({y[0], y[1]}, 0).r());
    }
    measure(
        result.projection, [&](std::size_t i) { return originals[i]; }, target_model(options), onto);
    return result;
}

}  // namespace

SpaceCurve polyline(std::vector<Vector3> points) {
    if (points.size() < 2) throw InvalidInput("projection: a curve needs at least two points");
    std::vector<double> at = {0.0};
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].allFinite()) throw InvalidInput("projection: a point of the curve is not finite");
        if (i == 0) continue;
        const double chord = (points[i] - points[i - 1]).norm();
        if (!(chord > 0.0)) throw InvalidInput("projection: two consecutive points of the curve are equal");
        at.push_back(at.back() + chord);
    }
    SpaceCurve curve;
    curve.range = {0.0, at.back()};
    curve.breaks.assign(at.begin() + 1, at.end() - 1);
    curve.at = [points = std::move(points), at](double t) {
        const auto next = std::upper_bound(at.begin() + 1, at.end() - 1, t);
        const auto i = static_cast<std::size_t>(next - at.begin());
        const Vector3 along = (points[i] - points[i - 1]) / (at[i] - at[i - 1]);
        return std::pair<Vector3, Vector3>(points[i - 1] + (t - at[i - 1]) * along, along);
    };
    return curve;
}

ProjectedCurve project_curve(const SpaceCurve& curve, const Face& onto, const ProjectionOptions& options,
                             const Progress& progress) {
    check(options);
    if (!curve.at) throw InvalidInput("projection: there is no curve");
    check_length(curve.range.length());
    const Vector3 start = curve.at(curve.range.low).first;
    const Vector2 foot = start_foot(onto, start, options, progress);
    const double sign = start_sign(onto, foot, start);
    PathSystem system;
    // Where a piece of the curve ends, its derivative is that of the piece before up to the break: steps end there, and
    // their last stage is taken just before.
    double step_start = 0.0;
    const auto at = [&](double s) {
        const double low = curve.range.low;
        const auto next = std::upper_bound(curve.breaks.begin(), curve.breaks.end(), low + step_start);
        const double limit = next == curve.breaks.end() ? curve.range.high : *next;
        const double t = low + s;
        return curve.at(t < limit ? t : std::nextafter(limit, low));
    };
    system.rates = [&](double s, const PathState&, const ChartSurfaces& surfaces,
                       PathState& rate) -> std::optional<CurveEnd> {
        const auto [point, velocity] = at(s);
        if (!point.allFinite() || !velocity.allFinite()) throw InvalidInput("projection: the curve is not finite");
        const std::optional<Vector2> foot_rate = foot_rates(surfaces[0], point, velocity, sign);
        if (!foot_rate) return CurveEnd::evolute;
        rate[0] = foot_rate->x();
        rate[1] = foot_rate->y();
        rate[projected_length] = projected_speed(surfaces[0], *foot_rate);
        return std::nullopt;
    };
    system.begin_step = [&](double s, const ChartSurfaces&) { step_start = s; };
    system.error = [](const PathState& e, const ChartSurfaces& surfaces) { return chart_error(surfaces[0], e, 0); };
    std::vector<double> breaks;
    for (const double t : curve.breaks) breaks.push_back(t - curve.range.low);
    const SurfacePath path = follow(system, {foot.x(), foot.y()}, {&onto, nullptr},
                                    {.length = curve.range.length(),
                                     .tolerance = options.tolerance * extent(onto),
                                     .longest_step = longest_step * curve.range.length(),
                                     .breaks = std::move(breaks),
                                     .joins = {options.joins, nullptr}},
                                    progress);
    ProjectedCurve result;
    result.projection = sampled(path, 0, options.spacing, true);
    result.left_target = path.ended == CurveEnd::boundary || path.ended == CurveEnd::trim;
    const std::vector<SurfaceCurvePoint> by_parameter = sampled(path, 0, options.spacing).points;
    measure(
        result.projection, [&](std::size_t i) { return curve.at(curve.range.low + by_parameter[i].s).first; },
        target_model(options), onto);
    return result;
}

ProjectedCurve project_line_of_curvature(const Face& from, const Vector2& start, CurvatureFamily family,
                                         const Vector3& direction, double length, const Face& onto,
                                         const ProjectionOptions& options, const Progress& progress) {
    check(options);
    check_length(length);
    check_on_face(from, start, "projection of a line of curvature");
    if (!direction.allFinite() || !(direction.norm() > 0.0))
        throw InvalidInput("projection: the direction must be finite and not zero");
    // The outward side of a reversed face is the other one: there the families change places.
    const bool maximum = (family == CurvatureFamily::maximum) != from.reversed;
    const double size = extent(from);
    const auto tangent_of = [&](const SurfaceDerivatives& d) -> std::optional<Vector3> {
        const Curvature c = curvature(d);
        const double scale = std::max({std::abs(c.kappa_max), std::abs(c.kappa_min), 1 / size});
        if (!c.regular || !(c.kappa_max - c.kappa_min > collapse * scale)) return std::nullopt;
        return maximum ? c.direction_max : c.direction_min;
    };
    const SurfaceDerivatives d = from.surface.derivatives(start.x(), start.y(), 2);
    const std::optional<Vector3> first = tangent_of(d);
    if (!first)
        throw InvalidInput("projection of a line of curvature: the start is umbilic, no direction is defined there");
    Vector3 reference = first->dot(direction) < 0.0 ? Vector3(-*first) : *first;
    const Vector2 foot = start_foot(onto, d.r(), options, progress);
    const double sign = start_sign(onto, foot, d.r());

    PathSystem system;
    system.charts = 2;
    const auto onward = [&](const SurfaceDerivatives& here) -> std::optional<Vector3> {
        std::optional<Vector3> tangent = tangent_of(here);
        if (!tangent) return std::nullopt;
        if (tangent->dot(reference) < 0.0) tangent = -*tangent;
        if (tangent->dot(reference) < forward_cosine) return std::nullopt;
        return tangent;
    };
    system.rates = [&](double, const PathState&, const ChartSurfaces& surfaces,
                       PathState& rate) -> std::optional<CurveEnd> {
        const std::optional<Vector3> tangent = onward(surfaces[0]);
        if (!tangent) return CurveEnd::umbilic;
        const Vector2 own = tangent_components(surfaces[0], *tangent);
        const std::optional<Vector2> foot_rate = foot_rates(surfaces[1], surfaces[0].r(), *tangent, sign);
        if (!foot_rate) return CurveEnd::evolute;
        rate = {own.x(), own.y(), 0.0, 0.0, foot_rate->x(), foot_rate->y(), projected_speed(surfaces[1], *foot_rate)};
        return std::nullopt;
    };
    system.begin_step = [&](double, const ChartSurfaces& surfaces) {
        if (const std::optional<Vector3> tangent = onward(surfaces[0])) reference = *tangent;
    };
    system.error = [](const PathState& e, const ChartSurfaces& surfaces) {
        return chart_error(surfaces[0], e, 0) + chart_error(surfaces[1], e, 1);
    };
    const SurfacePath path = follow(system, {start.x(), start.y(), 0.0, 0.0, foot.x(), foot.y(), 0.0}, {&from, &onto},
                                    {.length = length,
                                     .tolerance = options.tolerance * std::min(extent(onto), size),
                                     .longest_step = longest_step * std::min(length, size),
                                     .joins = {nullptr, options.joins}},
                                    progress);
    return both(path, onto, options);
}

ProjectedCurve project_geodesic(const Face& from, const Vector2& start, const Vector3& direction, double length,
                                const Face& onto, const ProjectionOptions& options, const Progress& progress) {
    check(options);
    check_length(length);
    check_on_face(from, start, "projection of a geodesic");
    const SurfaceDerivatives d = from.surface.derivatives(start.x(), start.y(), 1);
    const Vector3 normal = unit_normal(d);
    const Vector3 along = direction - direction.dot(normal) * normal;
    if (!direction.allFinite() || !(along.norm() > regularity * direction.norm()))
        throw InvalidInput("projection: the direction must be finite and have a part in the tangent plane");
    const Vector2 velocity = tangent_components(d, along.normalized());
    const Vector2 foot = start_foot(onto, d.r(), options, progress);
    const double sign = start_sign(onto, foot, d.r());
    const double size = extent(from);

    PathSystem system;
    system.charts = 2;
    system.rates = [&](double, const PathState& y, const ChartSurfaces& surfaces,
                       PathState& rate) -> std::optional<CurveEnd> {
        const SurfaceDerivatives& own = surfaces[0];
        if (!regular(own)) return CurveEnd::boundary;
        const Vector2 acceleration = geodesic_acceleration(own, {y[2], y[3]});
        const std::optional<Vector2> foot_rate =
            foot_rates(surfaces[1], own.r(), own.r_u() * y[2] + own.r_v() * y[3], sign);
        if (!foot_rate) return CurveEnd::evolute;
        rate = {y[2],
                y[3],
                acceleration.x(),
                acceleration.y(),
                foot_rate->x(),
                foot_rate->y(),
                projected_speed(surfaces[1], *foot_rate)};
        return std::nullopt;
    };
    system.enter = [](int chart, const SurfaceDerivatives& before, const SurfaceDerivatives& after, PathState& y) {
        if (chart == 0) carry_tangent(before, after, y);
    };
    system.error = [size](const PathState& e, const ChartSurfaces& surfaces) {
        const SurfaceDerivatives& own = surfaces[0];
        return chart_error(own, e, 0) + chart_error(surfaces[1], e, 1) +
               size * (own.r_u() * e[2] + own.r_v() * e[3]).norm();
    };
    const SurfacePath path =
        follow(system, {start.x(), start.y(), velocity.x(), velocity.y(), foot.x(), foot.y(), 0.0}, {&from, &onto},
               {.length = length,
                .tolerance = options.tolerance * std::min(extent(onto), size),
                .longest_step = longest_step * std::min(length, size),
                .joins = {options.original_joins, options.joins}},
               progress);
    return both(path, onto, options);
}

ProjectedGeodesicBetween project_geodesic_between(const Face& from, const Vector2& start, const Vector2& end,
                                                  const Face& onto, const ProjectionOptions& options,
                                                  const RelaxationOptions& relaxation, const Progress& progress) {
    check(options);
    check_on_face(from, start, "projection of a geodesic");
    check_on_face(from, end, "projection of a geodesic");
    if ((end - start).norm() == 0.0) throw InvalidInput("projection of a geodesic: both points are the same");
    const Vector3 first = from.surface.value(start.x(), start.y());
    const Vector2 foot = start_foot(onto, first, options, progress);
    const double sign = start_sign(onto, foot, first);
    const BoundaryValueProblem geodesic = geodesic_problem(from, start, end);
    BoundaryValueProblem problem;
    problem.rate = [&](const Eigen::VectorXd& y, Eigen::VectorXd& g) {
        Eigen::VectorXd own(4);
        if (!geodesic.rate(y.head<4>(), own)) return false;
        g.head<4>() = own;
        const SurfaceDerivatives d = from.surface.derivatives(y[0], y[1], 1);
        const std::optional<Vector2> foot_rate =
            foot_rates(onto.surface.derivatives(y[4], y[5], 2), d.r(), d.r_u() * y[2] + d.r_v() * y[3], sign);
        if (!foot_rate) return false;
        g.tail<2>() = *foot_rate;
        return true;
    };
    problem.at_start = geodesic.at_start;
    problem.at_start.emplace_back(4, foot.x());
    problem.at_start.emplace_back(5, foot.y());
    problem.at_end = geodesic.at_end;
    const ParameterBox domain = onto.surface.domain();
    problem.scale.resize(6);
    problem.scale << geodesic.scale, domain.u.length(), domain.v.length();
    problem.distance = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
        return std::max(geodesic.distance(a.head<4>(), b.head<4>()),
                        (onto.surface.value(a[4], a[5]) - onto.surface.value(b[4], b[5])).norm());
    };
    // The straight line on the one surface; on the other one feet from point to point.
    Eigen::MatrixXd guess(6, mesh_points);
    guess.topRows<4>() = straight_guess(start, end, mesh_points);
    Vector2 last = foot;
    for (Eigen::Index k = 0; k < mesh_points; ++k) {
        const Vector3 point = from.surface.value(guess(0, k), guess(1, k));
        last = foot_point(onto.surface, point, last).value_or(last);
        guess.col(k).tail<2>() = last;
    }
    ProjectedGeodesicBetween result{{}, relax(problem, guess, relaxation, progress)};

    SurfaceCurve& original = result.curve.original;
    SurfaceCurve& projection = result.curve.projection;
    const Eigen::MatrixXd& states = result.relaxation.states;
    const SurfaceDerivatives d = from.surface.derivatives(states(0, 0), states(1, 0), 1);
    original.length = (d.r_u() * states(2, 0) + d.r_v() * states(3, 0)).norm();
    const auto part = 1.0 / static_cast<double>(states.cols() - 1);
    double along = 0.0, speed_before = 0.0;
    for (Eigen::Index k = 0; k < states.cols(); ++k) {
        const Eigen::VectorXd y = states.col(k);
        Eigen::VectorXd g(6);
        const double speed =
            problem.rate(y, g) ? projected_speed(onto.surface.derivatives(y[4], y[5], 1), g.tail<2>()) : 0.0;
        if (k > 0) along += 0.5 * part * (speed + speed_before);
        speed_before = speed;
        original.points.push_back({original.length * static_cast<double>(k) * part,
                                   {from.number, y[0], y[1]},
                                   from.surface.value(y[0], y[1])});
        projection.points.push_back({along, {onto.number, y[4], y[5]}, onto.surface.value(y[4], y[5])});
        const bool inside = domain.contains(y[4], y[5]) && onto.region.classify(y[4], y[5]) != Containment::outside;
        result.curve.left_target = result.curve.left_target || !inside;
    }
    projection.length = along;
    original.ended = projection.ended = CurveEnd::point;
    original.error = result.relaxation.error;
    measure(
        projection, [&](std::size_t i) { return original.points[i].point; }, nullptr, onto);
    return result;
}

}  // namespace umbilic
