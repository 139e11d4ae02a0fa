// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/way_turning.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <umbilic/bernstein/rounding.h>
#include <umbilic/bernstein/subdivision.h>

namespace umbilic {

namespace {

/// Pieces an edge is halved into, one within the other, before it is given up.
constexpr int maximum_depth = 40;

/// Units of roundoff, relative to its terms, below which the sign of a cross product of two directions is not known.
constexpr double cross_units = 16.0;
/// Sums of angles between the same directions differ from whole turns (in turns) by roundings only.
constexpr double closure = 1e-6;

double turn_between(const Vector2& from, const Vector2& to) {
    return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

/// The sense of turning from one to the other is not known.
bool opposed(const Vector2& a, const Vector2& b) {
    const double first = a.x() * b.y(), second = a.y() * b.x();
    return a.dot(b) < 0.0 &&
           std::abs(first - second) <= cross_units * unit_roundoff * (std::abs(first) + std::abs(second));
}

double largest(const std::vector<double>& values) {
    double result = 0.0;
    for (const double value : values) result = std::max(result, std::abs(value));
    return result;
}

struct Curve {
    BoundedCurve a, b;
};

/// All coefficients are within their errors of zero.
bool lost(const BoundedCurve& polynomial) {
    for (int k = 0; k <= polynomial.degree(); ++k)
        if (std::abs(polynomial.coefficients[k]) > polynomial.error_of(k)) return false;
    return true;
}

/// The sign of all coefficients; 0 if they have none in common.
double sign_of(const BoundedCurve& polynomial) {
    const double sign = polynomial.coefficients.front() > 0.0 ? 1.0 : -1.0;
    for (int k = 0; k <= polynomial.degree(); ++k)
        if (!(sign * polynomial.coefficients[k] > polynomial.error_of(k))) return 0.0;
    return sign;
}

/// A direction (x, y) with a x + b y > 0 for all coefficients, whatever their errors; none if none is found. The two
/// axes serve where one of the polynomials is lost in rounding, the mean serves elsewhere.
std::optional<Vector2> common_direction(const Curve& curve) {
    if (const double sign = sign_of(curve.a); sign != 0.0) return Vector2(sign, 0.0);
    if (const double sign = sign_of(curve.b); sign != 0.0) return Vector2(0.0, sign);
    const std::vector<double>&a = curve.a.coefficients, &b = curve.b.coefficients;
    const double a_size = largest(a), b_size = largest(b);
    if (!(a_size > 0.0 && b_size > 0.0)) return std::nullopt;
    // The mean of (a / a_size, b / b_size), as a direction for (a, b) itself.
    Vector2 mean(0.0, 0.0);
    for (std::size_t k = 0; k < a.size(); ++k) mean += Vector2(a[k] / a_size, b[k] / b_size);
    mean = Vector2(mean.x() / a_size, mean.y() / b_size);
    for (std::size_t k = 0; k < a.size(); ++k) {
        const double error = (std::abs(mean.x()) * (curve.a.error_of(k) + 3 * unit_roundoff * a_size) +
                              std::abs(mean.y()) * (curve.b.error_of(k) + 3 * unit_roundoff * b_size)) *
                             bound_slack;
        if (!(mean.x() * a[k] + mean.y() * b[k] > error)) return std::nullopt;
    }
    return mean;
}

/// Cuts `polynomial` to its second half; returns the first.
BoundedCurve halve(BoundedCurve& polynomial) {
    const int degree = polynomial.degree();
    const double relative = gamma_bound(degree), arithmetic = relative * largest(polynomial.coefficients);
    BoundedCurve first = polynomial;
    halve_v({0, degree}, polynomial.coefficients.data(), first.coefficients.data());
    if (!polynomial.errors.empty()) halve_v({0, degree}, polynomial.errors.data(), first.errors.data());
    first.widen(arithmetic, relative);
    polynomial.widen(arithmetic, relative);
    return first;
}

/// Sides of a patch's domain. A / u and B / v are in the surface's parameters up to one common factor.
struct PatchSize {
    double u, v;

    /// The vector (A, B) in the surface's parameters, up to a common factor, from one in the patch's.
    Vector2 vector(double a, double b) const { return Vector2(a * v, b * u) / std::max(u, v); }
    /// The same for a direction whose scalar product with it counts.
    Vector2 direction(const Vector2& d) const { return Vector2(d.x() * u, d.y() * v).normalized(); }
};

/// Follows a curve in a patch's parameters piece by piece from `turning.last`, which is zero at its start. `part`: of
/// the whole curve's range; `obstacle` becomes the first part that may hold a common zero where the result is false.
bool follow(Curve curve, const PatchSize& size, int depth, const ParameterInterval& part, WayTurning& turning,
            ParameterInterval& obstacle) {
    if (const std::optional<Vector2> direction = common_direction(curve)) {
        const Vector2 normal = size.direction(*direction);
        if (turning.append({.first = normal, .last = normal})) return true;
        obstacle = part;
        return false;
    }
    if (depth == maximum_depth || (lost(curve.a) && lost(curve.b))) {
        obstacle = part;
        return false;
    }
    Curve first{halve(curve.a), halve(curve.b)};
    return follow(std::move(first), size, depth + 1, {part.low, part.middle()}, turning, obstacle) &&
           follow(std::move(curve), size, depth + 1, {part.middle(), part.high}, turning, obstacle);
}

}  // namespace

void BoundedCurve::widen(double arithmetic, double relative) {
    error = (error + arithmetic) * bound_slack;
    const double of_errors = relative * largest(errors);
    for (double& each : errors) each = (std::abs(each) + arithmetic + of_errors) * bound_slack;
}

std::optional<WayTurning> turning(const BoundedCurve& a, const BoundedCurve& b, double u_length, double v_length,
                                  ParameterInterval& obstacle) {
    const PatchSize size{u_length, v_length};
    WayTurning result;
    if (!follow({a, b}, size, 0, {0.0, 1.0}, result, obstacle)) return std::nullopt;
    result.start = size.vector(a.coefficients.front(), b.coefficients.front());
    result.end = size.vector(a.coefficients.back(), b.coefficients.back());
    return result;
}

std::optional<WayTurning> turning(const EdgeEquations& edge, double u_length, double v_length) {
    ParameterInterval obstacle;
    return turning({edge.a, edge.a_error, {}}, {edge.b, edge.b_error, {}}, u_length, v_length, obstacle);
}

double WayTurning::between_ends() const {
    return turn_between(start, first) + angle + turn_between(last, end);
}

WayTurning WayTurning::reversed() const {
    return {end, start, last, first, -angle};
}

bool WayTurning::append(const WayTurning& next) {
    if (last.isZero()) {
        *this = next;
        return true;
    }
    if (opposed(last, next.first)) return false;
    angle += turn_between(last, next.first) + next.angle;
    last = next.last;
    end = next.end;
    return true;
}

std::optional<double> winding(std::span<const DirectedWay> ways) {
    // At a common end of two ways (A, B) is within a right angle of the directions of both, so that the angle from one
    // to the other is below half a turn; where more than two meet it does not matter which follows which.
    struct End {
        Vector2 at, direction;
    };
    std::vector<End> arrivals, departures;
    double angle = 0.0;
    for (const DirectedWay& way : ways) {
        departures.push_back({way.side.from, way.turning.first});
        arrivals.push_back({way.side.to, way.turning.last});
        angle += way.turning.angle;
    }
    const auto before = [](const End& a, const End& b) {
        return std::tie(a.at.x(), a.at.y()) < std::tie(b.at.x(), b.at.y());
    };
    std::stable_sort(arrivals.begin(), arrivals.end(), before);
    std::stable_sort(departures.begin(), departures.end(), before);
    for (std::size_t k = 0; k < arrivals.size(); ++k) {
        if (arrivals[k].at != departures[k].at || opposed(arrivals[k].direction, departures[k].direction))
            return std::nullopt;
        angle += turn_between(arrivals[k].direction, departures[k].direction);
    }
    const double turns = angle / (2 * std::numbers::pi);
    if (std::abs(turns - std::round(turns)) > closure) return std::nullopt;
    return std::round(turns);
}

}  // namespace umbilic
