// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/net_start.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <umbilic/curves/line_of_curvature.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

namespace {

/// Two distances that differ by less than this share of the step are a tie, which nothing in the shape decides.
constexpr double tie = 0.05;
/// Axes are told apart if their variances differ by more than this share.
constexpr double distinct_variance = 0.02;
/// Nodes of the grid on which the search for the point nearest to the centroid starts, along each parameter.
constexpr int fewest_grid = 8, most_grid = 40, grid_per_span = 3;
/// Best places of the grid that are followed.
constexpr int followed = 4;
constexpr int most_corrections = 60;
/// Least share of the metric in a convex squared distance.
constexpr double least_convexity = 1e-6;
/// Accuracy of the nearest point, relative to sqrt(area).
constexpr double relative_foot = 1e-13;
/// Start of the half-lines from a star, relative to the step.
constexpr double spoke_start = 1e-3;
/// Border places that are tried.
constexpr int most_border_starts = 16;

constexpr std::array<double, 3> gauss_node = {-0.7745966692414834, 0.0, 0.7745966692414834};
constexpr std::array<double, 3> gauss_weight = {0.5555555555555556, 0.8888888888888888, 0.5555555555555556};

/// Points with weights that depend on the shape alone.
struct Cloud {
    std::vector<Vector3> points;
    std::vector<double> weights;

    Vector3 centroid() const {
        Vector3 sum = Vector3::Zero();
        double weight = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            sum += weights[i] * points[i];
            weight += weights[i];
        }
        return weight > 0.0 ? Vector3(sum / weight) : sum;
    }
};

Cloud border_cloud(const FaceBorder& border) {
    Cloud cloud;
    for (const std::vector<BorderNode>& loop : border.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const BorderNode& node = loop[i];
            if (node.kind != BorderKind::border) continue;
            // Trapezoidal rule on the equal parts of the stretch.
            const double part = node.length / (between_count + 1);
            cloud.points.push_back(node.point);
            cloud.weights.push_back(0.5 * part);
            for (const Vector3& p : node.between) {
                cloud.points.push_back(p);
                cloud.weights.push_back(part);
            }
            cloud.points.push_back(loop[(i + 1) % loop.size()].point);
            cloud.weights.push_back(0.5 * part);
        }
    return cloud;
}

Cloud area_cloud(const NurbsSurface& surface) {
    Cloud cloud;
    const std::vector<double>&u = surface.u_knots().breaks(), &v = surface.v_knots().breaks();
    for (std::size_t i = 0; i + 1 < u.size(); ++i)
        for (std::size_t j = 0; j + 1 < v.size(); ++j)
            for (int g = 0; g < 3; ++g)
                for (int h = 0; h < 3; ++h) {
                    const double du = u[i + 1] - u[i], dv = v[j + 1] - v[j];
                    const SurfaceDerivatives d = surface.derivatives(u[i] + 0.5 * du * (1 + gauss_node[g]),
                                                                     v[j] + 0.5 * dv * (1 + gauss_node[h]), 1);
                    cloud.points.push_back(d.r());
                    cloud.weights.push_back(gauss_weight[g] * gauss_weight[h] * du * dv *
                                            d.r_u().cross(d.r_v()).norm());
                }
    return cloud;
}

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

/// The principal axis of a cloud that is farthest from the normal, or, where the axes are alike, the direction of the
/// point farthest from the centroid.
Vector3 tangential_axis(const Cloud& cloud, const Vector3& centroid, const Vector3& normal) {
    Matrix3 covariance = Matrix3::Zero();
    Vector3 farthest = Vector3::Zero();
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        const Vector3 d = cloud.points[i] - centroid, t = d - d.dot(normal) * normal;
        covariance += cloud.weights[i] * t * t.transpose();
        if (t.norm() > farthest.norm()) farthest = t;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(covariance);
    if (solver.eigenvalues()[2] > (1 + distinct_variance) * solver.eigenvalues()[1])
        return solver.eigenvectors().col(2);
    if (farthest.norm() > 0.0) return farthest.normalized();
    return normal.unitOrthogonal();
}

}  // namespace

std::optional<NetStart> net_start(const Face& face, const FaceBorder& border, const FaceUmbilics& umbilics,
                                  double step) {
    Cloud cloud = border_cloud(border);
    const Cloud edge_cloud = cloud;
    if (cloud.points.empty()) cloud = area_cloud(face.surface);
    const Vector3 centroid = cloud.centroid();
    const auto border_distance = [&](const Vector3& p) {
        double distance = std::numeric_limits<double>::infinity();
        for (const Vector3& q : edge_cloud.points) distance = std::min(distance, (q - p).norm());
        return distance;
    };

    // A star umbilic.
    const Umbilic* star = nullptr;
    double first = std::numeric_limits<double>::infinity(), second = first;
    for (const Umbilic& umbilic : umbilics.umbilics) {
        if (umbilic.kind.type != UmbilicType::star || !umbilic.certified || !inside(face, {umbilic.at.u, umbilic.at.v}))
            continue;
        if (!(border_distance(umbilic.point) > step)) continue;
        const double distance = (umbilic.point - centroid).norm();
        if (distance < first) {
            second = first;
            first = distance;
            star = &umbilic;
        } else {
            second = std::min(second, distance);
        }
    }
    if (star && second - first > tie * step) {
        NetStart start{.parameters = {star->at.u, star->at.v}};
        for (const SeparatrixStart& spoke : separatrix_starts(face, *star, spoke_start * step))
            start.spokes.push_back({spoke.parameters, spoke.direction, spoke.family});
        if (start.spokes.size() == 6) return start;
    }

    // The point nearest to the centroid.
    const LineTracer lines(face);
    std::vector<Vector2> places = grid_places(face);
    const bool all_umbilic = !places.empty() && std::all_of(places.begin(), places.end(), [&](const Vector2& p) {
        const FieldValue value = lines.value(p, CurvatureFamily::maximum);
        return lines.indeterminate(value);
    });
    std::vector<std::pair<double, Vector2>> candidates;
    for (const Vector2& p : places) candidates.emplace_back((face.surface.value(p.x(), p.y()) - centroid).norm(), p);
    const auto nearer = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::sort(candidates.begin(), candidates.end(), nearer);
    candidates.resize(std::min<std::size_t>(candidates.size(), followed));
    for (auto& [distance, p] : candidates) {
        const std::optional<Vector2> foot = nearest(lines, p, centroid);
        if (!foot || !inside(face, *foot)) {
            distance = std::numeric_limits<double>::infinity();
            continue;
        }
        p = *foot;
        distance = (face.surface.value(p.x(), p.y()) - centroid).norm();
    }
    std::stable_sort(candidates.begin(), candidates.end(), nearer);
    std::optional<Vector2> foot;
    if (!candidates.empty() && std::isfinite(candidates.front().first)) foot = candidates.front().second;

    NetStart start;
    if (all_umbilic) {
        const Vector2 at = foot.value_or(places[places.size() / 2]);
        const SurfaceDerivatives d = face.surface.derivatives(at.x(), at.y(), 1);
        if (!regular(d)) return std::nullopt;
        start.field.axis = tangential_axis(cloud, centroid, unit_normal(d));
    }
    const LineTracer tracer(face, start.field);
    if (foot) {
        const FieldValue value = tracer.value(*foot, CurvatureFamily::maximum);
        const bool away = !(border_distance(value.point) < tie * step);
        // Next to a pole of the parametrisation lines cannot start.
        const ParameterBox domain = face.surface.domain();
        const bool pole = value.r_u.norm() * domain.u.length() < step || value.r_v.norm() * domain.v.length() < step;
        if (!tracer.indeterminate(value) && away && !pole) {
            start.parameters = *foot;
            return start;
        }
    }

    // A surface without border that is alike around its centroid: any point will do.
    if (edge_cloud.points.empty())
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
                    {(loop[i].point - centroid).norm(), {&loop[i], loop[(i + 1) % loop.size()].point - loop[i].point}});
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
