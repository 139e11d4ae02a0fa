// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/line_of_curvature.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Geometry>

#include <umbilic/core/errors.h>
#include <umbilic/curves/line_tracer.h>

namespace umbilic {

namespace {

/// Longest step of the integration, relative to sqrt(area).
constexpr double longest_step = 0.1;
/// A line that passes its start within this distance, relative to sqrt(area), is closed.
constexpr double closing_distance = 1e-6;
/// Radius of the circle around an umbilic from which its lines start, relative to sqrt(area).
constexpr double start_radius = 1e-4;
/// The line on that circle lies within this angle of its tangent at the umbilic.
constexpr double start_window = 0.1;
constexpr int start_halvings = 45;

std::string place(const Face& face, const Vector2& at) {
    return "line of curvature on face " + std::to_string(face.number) + " from u = " + std::to_string(at.x()) +
           ", v = " + std::to_string(at.y());
}

void check(const Face& face, const Vector2& start, const LineOfCurvatureOptions& options) {
    const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
    if (options.length && !positive(*options.length))
        throw InvalidInput("line of curvature: the length must be finite and positive");
    if (!positive(options.tolerance))
        throw InvalidInput("line of curvature: the tolerance must be finite and positive");
    if (!std::isfinite(options.spacing) || options.spacing < 0.0)
        throw InvalidInput("line of curvature: the spacing must be finite and not negative");
    if (options.direction && !(options.direction->allFinite() && options.direction->norm() > 0.0))
        throw InvalidInput("line of curvature: the direction must be finite and not zero");
    if (!start.allFinite()) throw InvalidInput(place(face, start) + ": the start is not finite");
    if (!face.surface.domain().contains(start.x(), start.y()))
        throw InvalidInput(place(face, start) + ": the start is outside of the surface's domain");
    if (!face.region.whole_domain() && face.region.classify(start.x(), start.y()) == Containment::outside)
        throw InvalidInput(place(face, start) + ": the start is outside of the face's trimming loops");
}

void check(const LineTracer& tracer, const TracedLine& line) {
    if (!line.stuck) return;
    const Vector2 end = line.steps.empty() ? Vector2::Zero() : line.steps.back().end;
    throw NumericFailure("face " + std::to_string(tracer.face().number) +
                         ": a line of curvature cannot be continued at u = " + std::to_string(end.x()) +
                         ", v = " + std::to_string(end.y()) + "; the surface is not smooth enough there");
}

/// Appends the points of a traced line, shifted by s0; its first one is left out if the curve has points already.
void append(SurfaceCurve& curve, const LineTracer& tracer, const TracedLine& line, double s0, double spacing) {
    check(tracer, line);
    const Face& face = tracer.face();
    const auto add = [&](double s, const Vector2& at) {
        const Vector2 p = tracer.wrapped(at);
        curve.points.push_back({s0 + s, {face.number, p.x(), p.y()}, face.surface.value(p.x(), p.y())});
    };
    if (line.steps.empty()) return;
    if (curve.points.empty()) add(0.0, line.steps.front().start);
    if (spacing > 0.0) {
        const int parts = parts_of(line.length, spacing);
        for (int i = 1; i < parts; ++i) add(line.length * i / parts, line.at(line.length * i / parts));
        add(line.length, line.steps.back().end);
    } else {
        for (const TracedStep& step : line.steps) add(step.s + step.length, step.end);
    }
}

TraceOptions trace_options(const LineTracer& tracer, const LineOfCurvatureOptions& options) {
    const double size = tracer.size();
    return {.length = options.length.value_or(LineOfCurvatureOptions::longest * size),
            .tolerance = options.tolerance * size,
            .longest_step = longest_step * size,
            .closing_distance = closing_distance * size};
}

void reverse(SurfaceCurve& curve) {
    std::reverse(curve.points.begin(), curve.points.end());
    for (SurfaceCurvePoint& point : curve.points) point.s = curve.length - point.s;
}

}  // namespace

SurfaceCurve line_of_curvature(const Face& face, const Vector2& start, CurvatureFamily family,
                               const LineOfCurvatureOptions& options, const Progress& progress) {
    check(face, start, options);
    const LineTracer tracer(face);
    const FieldValue value = tracer.value(start, family);
    if (tracer.indeterminate(value))
        throw InvalidInput(place(face, start) + ": the start is umbilic or singular, no direction is defined there");
    const TraceOptions trace = trace_options(tracer, options);
    const Vector3 forward =
        options.direction && options.direction->dot(value.tangent) < 0.0 ? Vector3(-value.tangent) : value.tangent;

    SurfaceCurve curve;
    const TracedLine ahead = tracer.trace(start, family, forward, trace, progress);
    double before = 0.0;
    if (!options.direction && ahead.ended != CurveEnd::closed) {
        const TracedLine behind = tracer.trace(start, family, -forward, trace, progress);
        append(curve, tracer, behind, 0.0, options.spacing);
        curve.length = before = behind.length;
        reverse(curve);
        curve.started = behind.ended;
        curve.error = behind.error;
    }
    append(curve, tracer, ahead, before, options.spacing);
    curve.length = before + ahead.length;
    curve.error += ahead.error;
    curve.ended = ahead.ended;
    curve.closed = ahead.ended == CurveEnd::closed;
    if (curve.closed) curve.started = CurveEnd::closed;
    if (curve.points.empty()) curve.points.push_back({0.0, {face.number, start.x(), start.y()}, value.point});
    return curve;
}

std::vector<SeparatrixStart> separatrix_starts(const Face& face, const Umbilic& umbilic, double radius) {
    const Vector2 centre(umbilic.at.u, umbilic.at.v);
    if (umbilic.kind.type == UmbilicType::non_generic || umbilic.directions.empty())
        throw InvalidInput(place(face, centre) + ": the umbilic is not generic, its directions are not known");
    const LineTracer tracer(face);
    const FieldValue at_centre = tracer.value(centre, CurvatureFamily::maximum);
    std::vector<SeparatrixStart> result;
    for (const Vector3& direction : umbilic.directions)
        for (const double sense : {1.0, -1.0}) {
            const Vector3 x = (sense * direction).normalized(), y = umbilic.normal.cross(x);
            const auto at = [&](double angle) -> Vector2 {
                return centre + at_centre.rates(radius * (std::cos(angle) * x + std::sin(angle) * y));
            };
            const Vector2 middle = at(0.0);
            if (!face.surface.domain().contains(middle.x(), middle.y())) continue;
            // Sine of the angle from the radius to the direction of the family.
            const auto across = [&](double angle, CurvatureFamily family) {
                const Vector2 p = at(angle);
                const FieldValue value = tracer.value(p, family);
                const Vector3 radial = (value.point - umbilic.point).normalized();
                const Vector3 tangent = value.tangent.dot(radial) < 0.0 ? Vector3(-value.tangent) : value.tangent;
                return value.normal.dot(radial.cross(tangent));
            };
            SeparatrixStart start{.direction = x};
            start.family =
                std::abs(across(0.0, CurvatureFamily::maximum)) < std::abs(across(0.0, CurvatureFamily::minimum))
                    ? CurvatureFamily::maximum
                    : CurvatureFamily::minimum;
            double low = -start_window, high = start_window;
            const double low_value = across(low, start.family);
            if (low_value * across(high, start.family) < 0.0)
                for (int i = 0; i < start_halvings; ++i) {
                    const double angle = 0.5 * (low + high);
                    (across(angle, start.family) * low_value > 0.0 ? low : high) = angle;
                }
            start.parameters = at(0.5 * (low + high));
            if (!face.region.whole_domain() &&
                face.region.classify(start.parameters.x(), start.parameters.y()) == Containment::outside)
                continue;
            result.push_back(start);
        }
    return result;
}

std::vector<Separatrix> separatrices(const Face& face, const Umbilic& umbilic, const LineOfCurvatureOptions& options,
                                     const Progress& progress) {
    check(face, {umbilic.at.u, umbilic.at.v}, options);
    const LineTracer tracer(face);
    const TraceOptions trace = trace_options(tracer, options);
    const double radius = std::min(start_radius * tracer.size(), 0.5 * trace.length);
    std::vector<Separatrix> result;
    for (const SeparatrixStart& start : separatrix_starts(face, umbilic, radius)) {
        const TracedLine line = tracer.trace(start.parameters, start.family, start.direction, trace, progress);
        Separatrix separatrix{.family = start.family, .direction = start.direction};
        SurfaceCurve& curve = separatrix.curve;
        const Vector3 first = face.surface.value(start.parameters.x(), start.parameters.y());
        const double gap = (first - umbilic.point).norm();
        curve.points.push_back({0.0, umbilic.at, umbilic.point});
        curve.points.push_back({gap, {face.number, start.parameters.x(), start.parameters.y()}, first});
        append(curve, tracer, line, gap, options.spacing);
        curve.started = CurveEnd::umbilic;
        curve.ended = line.ended;
        curve.length = gap + line.length;
        curve.error = line.error;
        result.push_back(std::move(separatrix));
    }
    return result;
}

}  // namespace umbilic
