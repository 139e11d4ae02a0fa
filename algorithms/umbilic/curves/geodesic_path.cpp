// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/geodesic_path.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include <umbilic/core/errors.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

namespace {

/// Longest step of the integration, relative to the length of the path and to sqrt(area).
constexpr double longest_step = 0.25;
/// The thesis's scale factor of p and q against that of u and v (3.19).
constexpr double velocity_scale = 10.0;
/// Where a turn around a pole is shorter than this, relative to sqrt(area), parameters say nothing any more: a path
/// that comes so near goes straight through the pole.
constexpr double pole_turn = 1e-7;
/// Behind a pole a path goes on at this distance from it, relative to the domain.
constexpr double beyond_pole = 1e-6;
/// Directions at a pole that are tried, and halvings between them.
constexpr int pole_samples = 64, pole_halvings = 60;
/// At a smooth pole some direction continues a tangent up to this cosine (0.08 degrees).
constexpr double pole_cosine = 1 - 1e-6;
/// A path does not go through more poles than this.
constexpr int most_poles = 16;

/// At a collapsed side of the domain.
bool at_pole(const SurfaceDerivatives& d, const ParameterBox& domain, double size) {
    return std::min(d.r_u().norm() * domain.u.length(), d.r_v().norm() * domain.v.length()) < pole_turn * size;
}

bool rates(const PathState& y, const SurfaceDerivatives& d, PathState& rate) {
    if (!regular(d)) return false;
    const Vector2 velocity(y[2], y[3]);
    const Vector2 acceleration = geodesic_acceleration(d, velocity);
    const SecondForm second = second_form(d);
    const double gauss = (second.L * second.N - second.M * second.M) / first_form(d).determinant();
    rate = {y[2], y[3], acceleration.x(), acceleration.y(), y[5], -gauss * y[4], 0.0};
    return acceleration.allFinite();
}

void enter(int, const SurfaceDerivatives& before, const SurfaceDerivatives& after, PathState& y) {
    carry_tangent(before, after, y);
    // Seen from the other side of the surface the Jacobi field changes its sign.
    if (unit_normal(after).dot(unit_normal(before)) < 0.0) {
        y[4] = -y[4];
        y[5] = -y[5];
    }
}

PathSystem geodesic_system(const ParameterBox& domain, double size) {
    PathSystem system;
    system.rates = [domain, size](double, const PathState& y, const ChartSurfaces& surfaces,
                                  PathState& rate) -> std::optional<CurveEnd> {
        if (at_pole(surfaces[0], domain, size) || !rates(y, surfaces[0], rate)) return CurveEnd::boundary;
        return std::nullopt;
    };
    system.enter = enter;
    // An error of the tangent is an angle; over the face it grows to a distance.
    system.error = [size](const PathState& e, const ChartSurfaces& surfaces) {
        const SurfaceDerivatives& d = surfaces[0];
        return (d.r_u() * e[0] + d.r_v() * e[1]).norm() + size * (d.r_u() * e[2] + d.r_v() * e[3]).norm();
    };
    return system;
}

struct Restart {
    PathState state{};
    double skipped = 0.0;  ///< mm
};

/// Where a path goes on that has run into a collapsed side of the surface's domain along `tangent`.
std::optional<Restart> through_pole(const Face& face, const PathState& y) {
    const ParameterBox domain = face.surface.domain();
    const SurfaceDerivatives here = face.surface.derivatives(y[0], y[1], 1);
    const Vector3 tangent = (here.r_u() * y[2] + here.r_v() * y[3]).normalized();
    for (int k = 0; k < 2; ++k) {
        const ParameterInterval& range = k == 0 ? domain.u : domain.v;
        const ParameterInterval& around = k == 0 ? domain.v : domain.u;
        const bool low = y[k] < range.middle();
        const double end = low ? range.low : range.high;
        const auto inward = [&](double t) -> Vector3 {
            const Vector2 at = k == 0 ? Vector2(end, t) : Vector2(t, end);
            const SurfaceDerivatives d = face.surface.derivatives(at.x(), at.y(), 1);
            return (low ? 1.0 : -1.0) * (k == 0 ? d.r_u() : d.r_v());
        };
        const auto cosine = [&](double t) {
            const Vector3 direction = inward(t);
            return direction.norm() > 0.0 ? direction.dot(tangent) / direction.norm() : -1.0;
        };
        const Vector2 side = k == 0 ? Vector2(end, around.middle()) : Vector2(around.middle(), end);
        const SurfaceDerivatives at_end = face.surface.derivatives(side.x(), side.y(), 1);
        // Paths end a little before the pole; a few times as far is still there.
        if (regular(at_end) || (at_end.r() - here.r()).norm() > 4 * pole_turn * extent(face)) continue;
        int best = 0;
        for (int i = 1; i <= pole_samples; ++i)
            if (cosine(around.low + around.length() * i / pole_samples) >
                cosine(around.low + around.length() * best / pole_samples))
                best = i;
        double a = around.clamp(around.low + around.length() * (best - 1) / pole_samples);
        double b = around.clamp(around.low + around.length() * (best + 1) / pole_samples);
        // Directions turn one way around the pole: the tangent lies between those at a and b.
        const Vector3 normal = inward(a).cross(inward(b));
        const bool between = normal.dot(inward(a).cross(tangent)) > 0.0 && normal.dot(tangent.cross(inward(b))) > 0.0;
        for (int i = 0; between && i < pole_halvings; ++i) {
            const double middle = 0.5 * (a + b);
            (normal.dot(inward(middle).cross(tangent)) > 0.0 ? a : b) = middle;
        }
        const double t = between ? 0.5 * (a + b) : around.low + around.length() * best / pole_samples;
        if (cosine(t) < pole_cosine) return std::nullopt;
        const double offset = (low ? 1.0 : -1.0) * beyond_pole * range.length();
        const Vector2 start = k == 0 ? Vector2(end + offset, t) : Vector2(t, end + offset);
        const SurfaceDerivatives d = face.surface.derivatives(start.x(), start.y(), 1);
        if (!regular(d)) return std::nullopt;
        const Vector3 along = (low ? 1.0 : -1.0) * (k == 0 ? d.r_u() : d.r_v()).normalized();
        const Vector2 velocity = tangent_components(d, along);
        Restart restart;
        restart.state = {start.x(), start.y(), velocity.x(), velocity.y(), y[4], y[5], 0.0};
        restart.skipped = (d.r() - at_end.r()).norm() + (at_end.r() - here.r()).norm();
        restart.state[4] += restart.skipped * y[5];
        return restart;
    }
    return std::nullopt;
}

}  // namespace

Vector2 geodesic_acceleration(const SurfaceDerivatives& d, const Vector2& velocity) {
    const double p = velocity.x(), q = velocity.y();
    const Christoffel c = christoffel(d);
    return {-(c.u_uu * p * p + 2 * c.u_uv * p * q + c.u_vv * q * q),
            -(c.v_uu * p * p + 2 * c.v_uv * p * q + c.v_vv * q * q)};
}

void carry_tangent(const SurfaceDerivatives& before, const SurfaceDerivatives& after, PathState& y) {
    const Vector3 tangent = before.r_u() * y[2] + before.r_v() * y[3];
    const Vector3 normal = unit_normal(after);
    const Vector3 along = (tangent - tangent.dot(normal) * normal).normalized() * tangent.norm();
    const Vector2 velocity = tangent_components(after, along);
    y[2] = velocity.x();
    y[3] = velocity.y();
}

SurfacePath geodesic_path(const Face& face, const Vector2& start, const Vector3& direction, double length,
                          const GeodesicBounds& bounds, const Progress& progress) {
    const double size = extent(face);
    const PathSystem system = geodesic_system(face.surface.domain(), size);
    const SurfaceDerivatives d = face.surface.derivatives(start.x(), start.y(), 1);
    const Vector3 normal = unit_normal(d);
    const Vector3 tangent = (direction - direction.dot(normal) * normal).normalized();
    const Vector2 velocity = tangent_components(d, tangent);
    PathState state = {start.x(), start.y(), velocity.x(), velocity.y(), 0.0, 1.0, 0.0};
    SurfacePathOptions options{.length = length,
                               .tolerance = bounds.tolerance * size,
                               .longest_step = std::min(longest_step * size, length),
                               .joins = {bounds.joins, nullptr}};
    SurfacePath result = follow(system, state, {&face, nullptr}, options, progress);
    for (int poles = 0; poles < most_poles && !result.steps.empty() && result.ended != CurveEnd::length; ++poles) {
        const Face& here = *result.steps.back().pieces[0].face;
        const double before = result.length;
        const std::optional<Restart> restart = through_pole(here, result.steps.back().end);
        if (!restart || before + restart->skipped >= length) break;
        options.length = length - before - restart->skipped;
        SurfacePath more = follow(system, restart->state, {&here, nullptr}, options, progress);
        for (PathStep& step : more.steps) {
            step.s += before + restart->skipped;
            result.steps.push_back(step);
        }
        result.ended = more.ended;
        result.ended_chart = more.ended_chart;
        result.error += more.error;
        result.length = before + restart->skipped + more.length;
    }
    return result;
}

GeodesicState geodesic_state(const PathStep& step, double x) {
    const PathState y = step.at(x);
    const SurfaceDerivatives d = step.pieces[0].derivatives({y[0], y[1]}, 1);
    GeodesicState state;
    state.point = d.r();
    state.normal = unit_normal(d);
    state.tangent = (d.r_u() * y[2] + d.r_v() * y[3]).normalized();
    state.jacobi = y[4];
    state.jacobi_slope = y[5];
    return state;
}

BoundaryValueProblem geodesic_problem(const Face& face, const Vector2& from, const Vector2& to) {
    BoundaryValueProblem problem;
    const NurbsSurface* surface = &face.surface;
    problem.rate = [surface](const Eigen::VectorXd& y, Eigen::VectorXd& g) {
        const SurfaceDerivatives d = surface->derivatives(y[0], y[1], 2);
        if (!regular(d)) return false;
        g.head<2>() = y.segment<2>(2);
        g.segment<2>(2) = geodesic_acceleration(d, Vector2(y[2], y[3]));
        return true;
    };
    problem.at_start = {{0, from.x()}, {1, from.y()}};
    problem.at_end = {{0, to.x()}, {1, to.y()}};
    const ParameterBox domain = surface->domain();
    problem.scale = Eigen::Vector4d(domain.u.length(), domain.v.length(), velocity_scale * domain.u.length(),
                                    velocity_scale * domain.v.length());
    problem.distance = [surface](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
        return (surface->value(a[0], a[1]) - surface->value(b[0], b[1])).norm();
    };
    return problem;
}

Eigen::MatrixXd straight_guess(const Vector2& from, const Vector2& to, int points) {
    Eigen::MatrixXd guess(4, points);
    for (int k = 0; k < points; ++k) {
        guess.col(k).head<2>() = from + (to - from) * k / (points - 1);
        guess.col(k).tail<2>() = to - from;
    }
    return guess;
}

void check_on_face(const Face& face, const Vector2& at, const std::string& what) {
    const std::string place = what + ": the point u = " + std::to_string(at.x()) + ", v = " + std::to_string(at.y()) +
                              " of face " + std::to_string(face.number);
    if (!at.allFinite()) throw InvalidInput(place + " is not finite");
    if (!face.surface.domain().contains(at.x(), at.y()))
        throw InvalidInput(place + " is outside of the surface's domain");
    if (face.region.classify(at.x(), at.y()) == Containment::outside)
        throw InvalidInput(place + " is outside of the face's trimming loops");
    if (!regular(face.surface.derivatives(at.x(), at.y(), 1)))
        throw InvalidInput(place + " is singular: the surface has no tangent plane there");
}

}  // namespace umbilic
