// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/differential/sweep_motion.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace umbilic {

namespace {

/// A rotation about an axis farther away than 1 / this, in extents of the points, counts as a translation.
constexpr double smallest_rotation = 1e-6;
/// Advance along the axis per radian, in extents of the points, above which a motion is helical.
constexpr double largest_pitch = 1e-2;
/// Points are compared with others at least this share of the sweep away.
constexpr double least_share = 0.25;
/// Closer to the axis than this share of the extent a point does not move.
constexpr double on_axis = 1e-6;
constexpr int walk_steps = 12;
/// A walk has arrived where a step is below this share of the extent (its square is lost in the distance), and may
/// leave the domain by `beyond` of it.
constexpr double arrived = 1e-9;
constexpr double beyond = 0.02;

struct Frame {
    Vector3 centre = Vector3::Zero();
    double length = 0.0;
};

Frame frame_of(std::span<const OrientedPoint> points) {
    Frame frame;
    for (const OrientedPoint& point : points) frame.centre += point.point;
    frame.centre /= static_cast<double>(points.size());
    for (const OrientedPoint& point : points)
        frame.length = std::max(frame.length, (point.point - frame.centre).norm());
    return frame;
}

/// What a sweep leaves unchanged of a point (its place in the generating curve's plane), and what it changes.
struct Station {
    Vector2 profile = Vector2::Zero();
    double sweep = 0.0;               ///< angle or length
    Vector3 along = Vector3::Zero();  ///< direction of the velocity; zero on the axis
    Vector3 x = Vector3::Zero();      ///< directions of the profile's coordinates, at this point
    Vector3 y = Vector3::Zero();
};

class Sweep {
public:
    Sweep(const SweepMotion& motion, double length) : motion_(motion), length_(length) {
        x_ = motion.axis.unitOrthogonal();
        y_ = motion.axis.cross(x_);
    }

    Station station(const Vector3& point) const {
        const Vector3 from = point - motion_.location;
        const double x = from.dot(x_), y = from.dot(y_), z = from.dot(motion_.axis);
        if (!motion_.rotation) return {{x, y}, z, motion_.axis, x_, y_};
        const double radius = std::hypot(x, y);
        Station result;
        result.profile = {radius, z};
        result.sweep = std::atan2(y, x);
        if (radius <= on_axis * length_) return result;
        result.x = (x * x_ + y * y_) / radius;
        result.y = motion_.axis;
        result.along = motion_.axis.cross(result.x);
        return result;
    }

    double apart(const Station& a, const Station& b) const {
        const double difference = std::abs(a.sweep - b.sweep);
        return motion_.rotation ? std::min(difference, 2.0 * std::numbers::pi - difference) : difference;
    }

private:
    const SweepMotion& motion_;
    double length_;
    Vector3 x_, y_;
};

/// Distance from `target` to the surface's profile near (u, v), walking on the surface across the sweep; none if that
/// leaves the domain.
std::optional<double> profile_distance(const NurbsSurface& surface, const Sweep& sweep, const Vector2& target,
                                       Vector2 at, double length) {
    const ParameterBox domain = surface.domain();
    const ParameterBox allowed{{domain.u.low - beyond * domain.u.length(), domain.u.high + beyond * domain.u.length()},
                               {domain.v.low - beyond * domain.v.length(), domain.v.high + beyond * domain.v.length()}};
    for (int step = 0; step < walk_steps; ++step) {
        const SurfaceDerivatives d = surface.derivatives(at.x(), at.y(), 1);
        const Station here = sweep.station(d.r());
        const Vector3 across = d.r_u().cross(d.r_v()).cross(here.along);
        if (!(across.norm() > 0.0)) return std::nullopt;
        const Vector3 tangent = across.normalized();
        const Vector2 gap = target - here.profile;
        const Vector2 ahead(tangent.dot(here.x), tangent.dot(here.y));
        const double advance = gap.dot(ahead);
        if (std::abs(advance) <= arrived * length) return std::abs(gap.x() * ahead.y() - gap.y() * ahead.x());
        Matrix2 form;
        form << d.r_u().squaredNorm(), d.r_u().dot(d.r_v()), d.r_u().dot(d.r_v()), d.r_v().squaredNorm();
        const double determinant = form.determinant();
        if (!(determinant > 0.0)) return std::nullopt;
        at += form.inverse() * Vector2(tangent.dot(d.r_u()), tangent.dot(d.r_v())) * advance;
        if (!allowed.contains(at.x(), at.y())) return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

std::optional<SweepMotion> sweep_motion(std::span<const OrientedPoint> points) {
    constexpr int unknowns = 6;
    if (points.size() <= unknowns) return std::nullopt;
    const Frame frame = frame_of(points);
    if (!(frame.length > 0.0)) return std::nullopt;
    Eigen::MatrixXd complex(points.size(), unknowns);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vector3 p = (points[k].point - frame.centre) / frame.length;
        complex.row(k) << points[k].normal.transpose(), p.cross(points[k].normal).transpose();
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(complex, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd best = svd.matrixV().col(unknowns - 1);
    const Vector3 shift = best.head<3>(), turn = best.tail<3>();
    const double root = std::sqrt(static_cast<double>(points.size()));
    SweepMotion result;
    result.slope = svd.singularValues()[unknowns - 1] / root;
    result.next_slope = svd.singularValues()[unknowns - 2] / root;
    result.rotation = turn.norm() > smallest_rotation;
    if (!result.rotation) {
        result.axis = shift.normalized();
        result.location = frame.centre;
        return result;
    }
    if (std::abs(turn.dot(shift)) > largest_pitch * turn.squaredNorm()) return std::nullopt;
    result.axis = turn.normalized();
    // The point of the axis nearest to the points' centre.
    result.location = frame.centre + frame.length * turn.cross(shift) / turn.squaredNorm();
    return result;
}

std::optional<double> sweep_deviation(const NurbsSurface& surface, const SweepMotion& motion,
                                      std::span<const OrientedPoint> points) {
    const double length = frame_of(points).length;
    const Sweep sweep(motion, length);
    std::vector<Station> stations;
    stations.reserve(points.size());
    for (const OrientedPoint& point : points) stations.push_back(sweep.station(point.point));
    double extent = 0.0;
    for (const Station& station : stations) extent = std::max(extent, sweep.apart(station, stations.front()));

    std::size_t moving = 0, met = 0;
    double largest = 0.0;
    for (const Station& station : stations) {
        if (station.along.isZero()) continue;
        ++moving;
        std::size_t partner = stations.size();
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < stations.size(); ++k) {
            if (stations[k].along.isZero() || sweep.apart(station, stations[k]) < least_share * extent) continue;
            const double gap = (station.profile - stations[k].profile).squaredNorm();
            if (gap < least) {
                least = gap;
                partner = k;
            }
        }
        if (partner == stations.size()) continue;
        if (const std::optional<double> distance =
                profile_distance(surface, sweep, station.profile, points[partner].at, length)) {
            ++met;
            largest = std::max(largest, *distance);
        }
    }
    if (2 * met < moving || met == 0) return std::nullopt;
    return largest;
}

}  // namespace umbilic
