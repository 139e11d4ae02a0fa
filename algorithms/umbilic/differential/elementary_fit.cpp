// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/differential/elementary_fit.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

constexpr int most_steps = 30;
constexpr int most_halvings = 6;
/// The method ends where a step changes no parameter by more than this share of the points' extent.
constexpr double smallest_step = 1e-15;
/// Below this size of the quadratic coefficient, relative to the linear one and the points' extent, an algebraic sphere
/// or circle is a plane or line: radii beyond 10^7 extents are not told apart in double precision.
constexpr double flat = 1e-7;

struct Kind {
    int shape_parameters;
    int symmetries;  ///< dimension of the motions, with changes of the shape, that change no distance
};

Kind properties(SurfaceKind kind) {
    switch (kind) {
        case SurfaceKind::plane:
            return {0, 3};
        case SurfaceKind::sphere:
            return {1, 3};
        case SurfaceKind::cylinder:
            return {1, 2};
        case SurfaceKind::cone:
            return {2, 2};
        case SurfaceKind::torus:
            return {2, 1};
        default:
            throw InvalidInput(std::string("a surface of kind ") + name(kind) +
                               " has no elementary parameters: give a plane, cylinder, cone, sphere or torus");
    }
}

/// Position relative to an axis.
struct Meridian {
    double radius = 0.0, height = 0.0;
    Vector3 outward = Vector3::Zero();  ///< unit, or zero on the axis
};

Meridian meridian(const ElementarySurface& surface, const Vector3& point) {
    const Vector3 from = point - surface.location;
    Meridian result;
    result.height = from.dot(surface.axis);
    const Vector3 across = from - result.height * surface.axis;
    result.radius = across.norm();
    if (result.radius > 0.0) result.outward = across / result.radius;
    return result;
}

Vector3 centroid(std::span<const Vector3> points) {
    Vector3 sum = Vector3::Zero();
    for (const Vector3& point : points) sum += point;
    return sum / static_cast<double>(points.size());
}

double extent(std::span<const Vector3> points, const Vector3& centre) {
    double largest = 0.0;
    for (const Vector3& point : points) largest = std::max(largest, (point - centre).norm());
    return largest;
}

/// Distances and, if wanted, their derivatives: translation, rotation about `centre` times `length`, shape parameters.
double distances(SurfaceKind kind, const ElementarySurface& surface, std::span<const Vector3> points,
                 const Vector3& centre, double length, Eigen::VectorXd& values, Eigen::MatrixXd* jacobian) {
    double largest = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const SignedDistance distance = elementary_distance(kind, surface, points[k]);
        values[k] = distance.value;
        largest = std::max(largest, std::abs(distance.value));
        if (!jacobian) continue;
        auto row = jacobian->row(k);
        row.segment<3>(0) = -distance.gradient;
        row.segment<3>(3) = -(points[k] - centre).cross(distance.gradient) / length;
        const Meridian at = meridian(surface, points[k]);
        if (kind == SurfaceKind::sphere || kind == SurfaceKind::cylinder) row[6] = -1.0;
        if (kind == SurfaceKind::cone) {
            const double sine = std::sin(surface.semi_angle), cosine = std::cos(surface.semi_angle);
            row[6] = -cosine;
            row[7] = (-(at.radius - surface.radius) * sine - at.height * cosine) / length;
        }
        if (kind == SurfaceKind::torus) {
            row[6] = -distance.gradient.dot(at.outward);
            row[7] = -1.0;
        }
    }
    return largest;
}

ElementarySurface changed(SurfaceKind kind, const ElementarySurface& surface, const Eigen::VectorXd& step,
                          const Vector3& centre, double length) {
    ElementarySurface result = surface;
    const Vector3 turn = step.segment<3>(3) / length;
    const double angle = turn.norm();
    const Matrix3 rotation =
        angle > 0.0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Matrix3(Matrix3::Identity());
    result.location = centre + rotation * (surface.location - centre) + Vector3(step.segment<3>(0));
    result.axis = (rotation * surface.axis).normalized();
    if (kind != SurfaceKind::plane) result.radius += step[6];
    if (kind == SurfaceKind::cone) result.semi_angle += step[7] / length;
    if (kind == SurfaceKind::torus) result.minor_radius += step[7];
    return result;
}

/// Direction in which the rows of a matrix have the least scalar products.
Eigen::VectorXd null_direction(const Eigen::MatrixXd& rows) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeThinU | Eigen::ComputeThinV);
    return svd.matrixV().col(rows.cols() - 1);
}

struct Circle {
    Vector2 centre = Vector2::Zero();
    double radius = 0.0;
};

std::optional<Circle> circle_through(std::span<const Vector2> points) {
    Vector2 middle = Vector2::Zero();
    for (const Vector2& point : points) middle += point;
    middle /= static_cast<double>(points.size());
    double length = 0.0;
    for (const Vector2& point : points) length = std::max(length, (point - middle).norm());
    if (!(length > 0.0)) return std::nullopt;
    Eigen::MatrixXd rows(points.size(), 4);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vector2 p = (points[k] - middle) / length;
        rows.row(k) << p.squaredNorm(), p.x(), p.y(), 1.0;
    }
    const Eigen::Vector4d a = null_direction(rows);
    const double squared = a.segment<2>(1).squaredNorm() - 4.0 * a[0] * a[3];
    if (!(squared > 0.0) || std::abs(a[0]) <= flat * std::sqrt(squared)) return std::nullopt;
    return Circle{middle - length * a.segment<2>(1) / (2.0 * a[0]),
                  length * std::sqrt(squared) / (2.0 * std::abs(a[0]))};
}

std::vector<Vector2> profile(std::span<const Vector3> points, const ElementarySurface& axis) {
    std::vector<Vector2> result;
    result.reserve(points.size());
    for (const Vector3& point : points) {
        const Meridian at = meridian(axis, point);
        result.emplace_back(at.radius, at.height);
    }
    return result;
}

}  // namespace

SignedDistance elementary_distance(SurfaceKind kind, const ElementarySurface& surface, const Vector3& point) {
    properties(kind);
    if (kind == SurfaceKind::plane) return {(point - surface.location).dot(surface.axis), surface.axis};
    if (kind == SurfaceKind::sphere) {
        const Vector3 from = point - surface.location;
        const double radius = from.norm();
        return {radius - surface.radius, radius > 0.0 ? Vector3(from / radius) : surface.axis};
    }
    const Meridian at = meridian(surface, point);
    if (kind == SurfaceKind::cylinder) return {at.radius - surface.radius, at.outward};
    if (kind == SurfaceKind::cone) {
        const double sine = std::sin(surface.semi_angle), cosine = std::cos(surface.semi_angle);
        return {(at.radius - surface.radius) * cosine - at.height * sine, cosine * at.outward - sine * surface.axis};
    }
    const double across = at.radius - surface.radius;
    const double from_tube = std::hypot(across, at.height);
    if (!(from_tube > 0.0)) return {-surface.minor_radius, at.outward};
    return {from_tube - surface.minor_radius, (across * at.outward + at.height * surface.axis) / from_tube};
}

ElementaryFit fit_elementary(SurfaceKind kind, const ElementarySurface& start, std::span<const Vector3> points) {
    const Kind of = properties(kind);
    const int columns = 6 + of.shape_parameters, rank = columns - of.symmetries;
    const int rows = static_cast<int>(points.size());
    if (rows <= columns) throw InvalidInput("fit of an elementary surface: too few points");
    const Vector3 centre = centroid(points);
    const double length = extent(points, centre);
    if (!(length > 0.0)) throw InvalidInput("fit of an elementary surface: all points coincide");

    ElementaryFit result;
    result.surface = start;
    Eigen::VectorXd values(rows), trial_values(rows);
    Eigen::MatrixXd jacobian(rows, columns);
    for (int step = 0; step < most_steps; ++step) {
        result.deviation = distances(kind, result.surface, points, centre, length, values, &jacobian);
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
        const double least = svd.singularValues()[rank - 1];
        result.condition = std::sqrt(rows) / least;
        if (!(least > 0.0)) break;
        const Eigen::VectorXd change =
            -svd.matrixV().leftCols(rank) *
            ((svd.matrixU().leftCols(rank).transpose() * values).array() / svd.singularValues().head(rank).array())
                .matrix();
        const double old_sum = values.squaredNorm();
        double factor = 1.0;
        bool better = false;
        for (int halving = 0; halving <= most_halvings && !better; ++halving, factor *= 0.5) {
            const ElementarySurface trial = changed(kind, result.surface, factor * change, centre, length);
            const double deviation = distances(kind, trial, points, centre, length, trial_values, nullptr);
            better = trial_values.squaredNorm() < old_sum;
            if (better) {
                result.surface = trial;
                result.deviation = deviation;
            }
        }
        if (!better || change.cwiseAbs().maxCoeff() <= smallest_step * length) break;
    }
    return result;
}

std::optional<ElementarySurface> plane_through(std::span<const Vector3> points) {
    const Vector3 centre = centroid(points);
    Eigen::MatrixXd rows(points.size(), 3);
    for (std::size_t k = 0; k < points.size(); ++k) rows.row(k) = points[k] - centre;
    ElementarySurface result;
    result.location = centre;
    result.axis = null_direction(rows);
    return result;
}

std::optional<ElementarySurface> sphere_through(std::span<const Vector3> points) {
    const Vector3 middle = centroid(points);
    const double length = extent(points, middle);
    if (!(length > 0.0)) return std::nullopt;
    Eigen::MatrixXd rows(points.size(), 5);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vector3 p = (points[k] - middle) / length;
        rows.row(k) << p.squaredNorm(), p.x(), p.y(), p.z(), 1.0;
    }
    const Eigen::VectorXd a = null_direction(rows);
    const double squared = a.segment<3>(1).squaredNorm() - 4.0 * a[0] * a[4];
    if (!(squared > 0.0) || std::abs(a[0]) <= flat * std::sqrt(squared)) return std::nullopt;
    ElementarySurface result;
    result.location = middle - length * a.segment<3>(1) / (2.0 * a[0]);
    result.radius = length * std::sqrt(squared) / (2.0 * std::abs(a[0]));
    return result;
}

std::optional<ElementarySurface> cylinder_through(std::span<const Vector3> points, const Vector3& direction) {
    ElementarySurface result;
    result.axis = direction.normalized();
    const Vector3 x = result.axis.unitOrthogonal(), y = result.axis.cross(x), middle = centroid(points);
    std::vector<Vector2> flat_points;
    for (const Vector3& point : points) flat_points.emplace_back((point - middle).dot(x), (point - middle).dot(y));
    const std::optional<Circle> circle = circle_through(flat_points);
    if (!circle) return std::nullopt;
    result.location = middle + circle->centre.x() * x + circle->centre.y() * y;
    result.radius = circle->radius;
    return result;
}

std::optional<ElementarySurface> cone_through(std::span<const Vector3> points, const ElementarySurface& axis) {
    const std::vector<Vector2> curve = profile(points, axis);
    Vector2 middle = Vector2::Zero();
    for (const Vector2& point : curve) middle += point;
    middle /= static_cast<double>(curve.size());
    Eigen::MatrixXd rows(curve.size(), 2);
    for (std::size_t k = 0; k < curve.size(); ++k) rows.row(k) = curve[k] - middle;
    const Vector2 normal = null_direction(rows);
    ElementarySurface result = axis;
    result.location = axis.location + middle.y() * axis.axis;
    result.radius = middle.x();
    // The line's normal is (cos, -sin) of the half angle.
    result.semi_angle = std::atan2(-normal.y(), normal.x());
    if (std::abs(result.semi_angle) > std::numbers::pi / 2)
        result.semi_angle -= std::copysign(std::numbers::pi, result.semi_angle);
    if (std::cos(result.semi_angle) < flat) return std::nullopt;
    return result;
}

std::optional<ElementarySurface> torus_through(std::span<const Vector3> points, const ElementarySurface& axis) {
    const std::optional<Circle> circle = circle_through(profile(points, axis));
    if (!circle) return std::nullopt;
    ElementarySurface result = axis;
    result.location = axis.location + circle->centre.y() * axis.axis;
    result.radius = circle->centre.x();
    result.minor_radius = circle->radius;
    return result;
}

}  // namespace umbilic
