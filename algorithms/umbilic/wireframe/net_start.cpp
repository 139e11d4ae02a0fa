// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/net_start.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <umbilic/curves/line_of_curvature.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

namespace {

/// How far beside the centroid, relative to the radius, the net begins: what is equally near to the centroid differs by
/// more than rounding from there.
constexpr double lean_share = 3e-3;
/// Two distances that differ by less than this share of the step are a tie.
constexpr double tie = 0.05;
/// Axes are told apart if their variances differ by more than this share.
constexpr double distinct_variance = 0.02;
/// Nodes of the grid on which the search for the point nearest to the centroid starts, along each parameter.
constexpr int fewest_grid = 8, most_grid = 40, grid_per_span = 3;
/// Best places of the grid that are followed.
constexpr int followed = 12;
constexpr int most_corrections = 60;
/// Least share of the metric in a convex squared distance.
constexpr double least_convexity = 1e-6;
/// Accuracy of the nearest point, relative to sqrt(area).
constexpr double relative_foot = 1e-13;
/// Start of the half-lines from a star, relative to the step.
constexpr double spoke_start = 1e-3;
/// Error of a step of their integration, relative to the step of the net.
constexpr double spoke_tolerance = 1e-7;
/// A net begins no nearer to a pole of the parametrisation than this, relative to the step.
constexpr double least_pole_distance = 0.213;
/// The first lines pass such a pole at this distance, relative to the step: not half a step, or the middle between two
/// of them would lead through it.
constexpr double pole_passage = 0.37;
/// Border places that are tried.
constexpr int most_border_starts = 16;

bool inside(const Face& face, const Vector2& p) {
    return face.surface.domain().contains(p.x(), p.y()) &&
           (face.region.whole_domain() || face.region.classify(p.x(), p.y()) == Containment::inside);
}

/// Places of a grid over the face's parameters that lie on the face.
std::vector<Vector2> grid_places(const Face& face) {
    const ParameterBox box = face.region.box();
    const auto count = [](const KnotVector& knots) {
        return std::clamp(grid_per_span * (static_cast<int>(knots.breaks().size()) - 1), fewest_grid, most_grid);
    };
    const int nu = count(face.surface.u_knots()), nv = count(face.surface.v_knots());
    std::vector<Vector2> result;
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
            const Vector2 p(box.u.low + box.u.length() * (i + 0.5) / nu, box.v.low + box.v.length() * (j + 0.5) / nv);
            if (inside(face, p)) result.push_back(p);
        }
    return result;
}

/// Newton's method for the point of the surface nearest to `target`.
std::optional<Vector2> nearest(const LineTracer& tracer, Vector2 p, const Vector3& target) {
    const NurbsSurface& surface = tracer.face().surface;
    for (int i = 0; i < most_corrections; ++i) {
        const SurfaceDerivatives d = surface.derivatives(p.x(), p.y(), 2);
        const Vector3 gap = d.r() - target;
        const Vector2 gradient(gap.dot(d.r_u()), gap.dot(d.r_v()));
        if (std::abs(gradient.x()) <= relative_foot * tracer.size() * d.r_u().norm() &&
            std::abs(gradient.y()) <= relative_foot * tracer.size() * d.r_v().norm())
            return p;
        Matrix2 hessian;
        hessian << d.r_u().squaredNorm() + gap.dot(d.r_uu()), d.r_u().dot(d.r_v()) + gap.dot(d.r_uv()),
            d.r_u().dot(d.r_v()) + gap.dot(d.r_uv()), d.r_v().squaredNorm() + gap.dot(d.r_vv());
        Matrix2 metric;
        metric << d.r_u().squaredNorm(), d.r_u().dot(d.r_v()), d.r_u().dot(d.r_v()), d.r_v().squaredNorm();
        // Where the squared distance is not convex, as much of the metric is added as makes it so.
        const double least = least_convexity * metric.determinant();
        for (double share = least_convexity; !(hessian(0, 0) > 0.0 && hessian.determinant() > least) && share < 10.0;
             share *= 10.0)
            hessian += share * metric;
        const Vector2 step = hessian.fullPivLu().solve(gradient);
        if (!step.allFinite()) return std::nullopt;
        const Vector2 before = p;
        p = tracer.wrapped(p - step);
        const ParameterBox domain = surface.domain();
        p = {domain.u.clamp(p.x()), domain.v.clamp(p.y())};
        if ((d.r_u() * (p - before).x() + d.r_v() * (p - before).y()).norm() <= relative_foot * tracer.size()) return p;
    }
    return std::nullopt;
}

/// The principal axis of the border, or surface, that is farthest from the normal, or, where the axes are alike, the
/// direction of the farthest corner.
Vector3 tangential_axis(const FaceFrame& frame, const Vector3& normal) {
    const auto tangential = [&](const Vector3& d) -> Vector3 { return d - d.dot(normal) * normal; };
    Matrix3 covariance = Matrix3::Zero();
    for (std::size_t i = 0; i < frame.points.points.size(); ++i) {
        const Vector3 t = tangential(frame.points.points[i] - frame.centroid);
        covariance += frame.points.weights[i] * t * t.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(covariance);
    if (solver.eigenvalues()[2] > (1 + distinct_variance) * solver.eigenvalues()[1])
        return solver.eigenvectors().col(2);
    for (const Vector3& way : {tangential(frame.corner), tangential(frame.lean)})
        if (way.norm() > tie * frame.corner.norm()) return way.normalized();
    return normal.unitOrthogonal();
}

/// The pole of the parametrisation nearest to a place.
std::optional<Vector3> nearest_pole(const FaceBorder& border, const Vector3& place) {
    std::optional<Vector3> nearest;
    for (const std::vector<BorderNode>& loop : border.loops)
        for (const BorderNode& node : loop)
            if (node.kind == BorderKind::pole && (!nearest || (node.point - place).norm() < (*nearest - place).norm()))
                nearest = node.point;
    return nearest;
}

/// The six half-lines of a star, if all are a step long or longer: among umbilics closer than that, or where curvature
/// jumps from piece to piece, no net grows from them.
std::vector<NetStart::Spoke> spokes(const LineTracer& tracer, const Umbilic& star, double step) {
    std::vector<NetStart::Spoke> result;
    for (const SeparatrixStart& spoke : separatrix_starts(tracer.face(), star, spoke_start * step)) {
        const TracedLine line = tracer.trace(
            spoke.parameters, spoke.family, spoke.direction,
            {.length = step, .tolerance = spoke_tolerance * step, .longest_step = 0.25 * step, .close = false});
        if (line.ended == CurveEnd::length) result.push_back({spoke.parameters, spoke.direction, spoke.family});
    }
    if (result.size() != 6) result.clear();
    return result;
}

}  // namespace

std::optional<NetStart> net_start(const Face& face, const FaceBorder& border, const FaceFrame& frame,
                                  const FaceUmbilics& umbilics, double step) {
    // A little beside the centroid: of points that are equally near to it one is nearer to this one.
    const Vector3 target = frame.centroid + lean_share * frame.radius * frame.lean;
    const std::vector<Vector3> border_places = border_points(border).points;
    const auto border_distance = [&](const Vector3& p) {
        double distance = std::numeric_limits<double>::infinity();
        for (const Vector3& q : border_places) distance = std::min(distance, (q - p).norm());
        return distance;
    };

    // A star umbilic.
    const LineTracer lines(face);
    std::vector<std::pair<double, const Umbilic*>> stars;
    for (const Umbilic& umbilic : umbilics.umbilics)
        if (umbilic.kind.type == UmbilicType::star && umbilic.certified && inside(face, {umbilic.at.u, umbilic.at.v}) &&
            border_distance(umbilic.point) > step)
            stars.emplace_back((umbilic.point - target).norm(), &umbilic);
    const auto nearer = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::sort(stars.begin(), stars.end(), nearer);
    for (auto star = stars.begin(); star != stars.end(); ++star) {
        NetStart start{.parameters = {star->second->at.u, star->second->at.v},
                       .spokes = spokes(lines, *star->second, step)};
        if (start.spokes.empty()) continue;
        const bool clearly = std::none_of(std::next(star), stars.end(), [&](const auto& other) {
            return other.first - star->first <= tie * step && !spokes(lines, *other.second, step).empty();
        });
        if (clearly) return start;
        break;
    }

    // The point nearest to the centroid.
    std::vector<Vector2> places = grid_places(face);
    const bool all_umbilic = !places.empty() && std::all_of(places.begin(), places.end(), [&](const Vector2& p) {
        const FieldValue value = lines.value(p, CurvatureFamily::maximum);
        return lines.indeterminate(value);
    });
    const auto nearest_to = [&](const Vector3& wanted) -> std::optional<Vector2> {
        std::vector<std::pair<double, Vector2>> candidates;
        for (const Vector2& p : places) candidates.emplace_back((face.surface.value(p.x(), p.y()) - wanted).norm(), p);
        std::sort(candidates.begin(), candidates.end(), nearer);
        candidates.resize(std::min<std::size_t>(candidates.size(), followed));
        std::optional<std::pair<double, Vector2>> best;
        for (const auto& candidate : candidates) {
            const std::optional<Vector2> foot = nearest(lines, candidate.second, wanted);
            if (!foot || !inside(face, *foot)) continue;
            const double distance = (face.surface.value(foot->x(), foot->y()) - wanted).norm();
            if (!best || distance < best->first) best = {distance, *foot};
        }
        return best ? std::optional(best->second) : std::nullopt;
    };
    std::optional<Vector2> foot = nearest_to(target);
    // Next to a pole of the parametrisation lines cannot start, nor go through: they pass beside it.
    std::optional<Vector3> pole;
    if (foot) {
        const Vector3 point = face.surface.value(foot->x(), foot->y());
        pole = nearest_pole(border, point);
        if (pole && (*pole - point).norm() > least_pole_distance * step) pole.reset();
    }
    if (pole) {
        const Vector3 out = *pole - frame.centroid;
        const Vector3 beside = out.squaredNorm() * frame.lean - out.dot(frame.lean) * out;
        foot = nearest_to(*pole + step * (beside.norm() > 0.0 ? beside.normalized() : out.unitOrthogonal()));
    }

    NetStart start;
    if (all_umbilic) {
        const Vector2 at = foot.value_or(places[places.size() / 2]);
        const SurfaceDerivatives d = face.surface.derivatives(at.x(), at.y(), 1);
        if (!regular(d)) return std::nullopt;
        start.field.axis = tangential_axis(frame, unit_normal(d));
    }
    const LineTracer tracer(face, start.field);
    if (foot && pole) {
        Vector3 way = Vector3::Zero();
        for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum}) {
            const Vector3 tangent = tracer.value(*foot, family).tangent;
            way += std::copysign(pole_passage * step, tangent.dot(frame.lean)) * tangent;
        }
        foot = nearest_to(*pole + way);
    }
    const auto fit = [&](const std::optional<Vector2>& place) {
        if (!place) return false;
        const FieldValue value = tracer.value(*place, CurvatureFamily::maximum);
        return !tracer.indeterminate(value) && !(border_distance(value.point) < tie * step);
    };
    // Where a face bulges out of a small border, the centroid of its area is nearer to its middle.
    if (!fit(foot) && frame.area_centroid)
        foot = nearest_to(*frame.area_centroid + lean_share * frame.radius * frame.lean);
    if (fit(foot)) {
        start.parameters = *foot;
        return start;
    }

    // A surface without border that is alike around its centroid: any point will do.
    if (border_places.empty())
        for (const Vector2& p : places)
            if (!tracer.indeterminate(tracer.value(p, CurvatureFamily::maximum))) {
                start.parameters = p;
                return start;
            }

    // One step inside of the border.
    std::vector<std::pair<double, std::pair<const BorderNode*, Vector3>>> ways;
    for (const std::vector<BorderNode>& loop : border.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            if (loop[i].kind == BorderKind::border)
                ways.push_back(
                    {(loop[i].point - target).norm(), {&loop[i], loop[(i + 1) % loop.size()].point - loop[i].point}});
    std::stable_sort(ways.begin(), ways.end(), nearer);
    if (ways.size() > most_border_starts) ways.resize(most_border_starts);
    for (const auto& [distance, way] : ways) {
        const Vector2 from = way.first->parameters;
        for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum}) {
            const FieldValue value = tracer.value(from, family);
            if (tracer.indeterminate(value) || std::abs(value.tangent.dot(way.second.normalized())) > 0.8) continue;
            for (const double sense : {1.0, -1.0}) {
                const TracedLine line = tracer.trace(
                    from, family, sense * value.tangent,
                    {.length = step, .tolerance = 1e-8 * step, .longest_step = 0.25 * step, .close = false});
                if (line.ended != CurveEnd::length || line.steps.empty()) continue;
                const Vector2 end = tracer.wrapped(line.steps.back().end);
                if (!inside(face, end)) continue;
                start.parameters = end;
                return start;
            }
        }
    }
    return std::nullopt;
}

}  // namespace umbilic
