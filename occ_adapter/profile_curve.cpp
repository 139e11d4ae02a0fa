// SPDX-License-Identifier: LGPL-2.1-or-later
#include "profile_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Line.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <gp_Elips.hxx>
#include <gp_Parab.hxx>

#include <umbilic/core/errors.h>

#include "occ_types.h"

namespace umbilic {

namespace {

/// An angle this near (radians) to a quarter turn is meant to be one: pi itself has a rounding error of this order.
constexpr double quarter_turn_rounding = 1e-15;

/// A parameter this near to a knot, relative to the period, is meant to be the knot.
constexpr double knot_rounding = 1e-9;

/// A face that winds around its surface more often than this is malformed.
constexpr double most_turns = 8.0;

void check_turns(const ParameterInterval& range, double turn) {
    if (!(range.length() > 0.0) || !(std::max(std::abs(range.low), std::abs(range.high)) <= most_turns * turn))
        throw InvalidInput("its parameter range [" + std::to_string(range.low) + ", " + std::to_string(range.high) +
                           "] is empty or winds around the surface many times");
}

/// Cosine and sine, exact at multiples of a quarter turn, so that poles of a sphere are single points.
std::pair<double, double> cosine_sine(double angle) {
    const double quarters = std::round(angle / (std::numbers::pi / 2));
    if (std::abs(angle - quarters * (std::numbers::pi / 2)) <= quarter_turn_rounding * std::max(1.0, std::abs(angle))) {
        constexpr double cosine[] = {1, 0, -1, 0}, sine[] = {0, 1, 0, -1};
        const int quarter = static_cast<int>(std::fmod(std::fmod(quarters, 4.0) + 4.0, 4.0));
        return {cosine[quarter], sine[quarter]};
    }
    return {std::cos(angle), std::sin(angle)};
}

ProfileCurve line_segment(const ParameterInterval& range, const Vector3& start, const Vector3& end) {
    return {KnotVector(1, {range.low, range.low, range.high, range.high}), {start, end}, {1.0, 1.0}, {}};
}

/// Image of the unit arc under (x, y) -> center + x a + y b.
ProfileCurve conic_arc(const ParameterInterval& range, const Vector3& center, const Vector3& a, const Vector3& b) {
    ProfileCurve arc = unit_arc(range);
    for (Vector3& pole : arc.poles) pole = center + pole.x() * a + pole.y() * b;
    return arc;
}

/// A quadratic polynomial curve: its Bernstein points are the polar values at (low, low), (low, high), (high, high).
ProfileCurve parabola_arc(const ParameterInterval& range, const gp_Parab& parabola) {
    const Vector3 vertex = to_vector(parabola.Location());
    const Vector3 x = to_vector(parabola.Position().XDirection()), y = to_vector(parabola.Position().YDirection());
    const double a = range.low, b = range.high;
    const auto polar = [&](double s, double t) -> Vector3 {
        return vertex + s * t / (4 * parabola.Focal()) * x + 0.5 * (s + t) * y;
    };
    return {KnotVector(2, {a, a, a, b, b, b}), {polar(a, a), polar(a, b), polar(b, b)}, {1.0, 1.0, 1.0}, {}};
}

ProfileCurve spline(const Handle(Geom_BSplineCurve) & curve, const ParameterInterval& range) {
    std::vector<double> knots;
    std::vector<int> numbers;
    if (curve->IsPeriodic()) {
        const auto& distinct = curve->Knots();
        const auto& multiplicities = curve->Multiplicities();
        UnrolledKnots unrolled = unroll_periodic(curve->Degree(), std::vector<double>(distinct.begin(), distinct.end()),
                                                 std::vector<int>(multiplicities.begin(), multiplicities.end()), range);
        knots = std::move(unrolled.knots);
        numbers = std::move(unrolled.poles);
    } else {
        const auto& sequence = curve->KnotSequence();
        knots.assign(sequence.begin(), sequence.end());
        for (int i = 0; i < curve->NbPoles(); ++i) numbers.push_back(i);
    }
    ProfileCurve result{KnotVector(curve->Degree(), std::move(knots)), {}, {}, {}};
    for (const int number : numbers) {
        result.poles.push_back(to_vector(curve->Pole(number + 1)));
        result.weights.push_back(curve->Weight(number + 1));
    }
    return result;
}

}  // namespace

ProfileCurve unit_arc(const ParameterInterval& angles) {
    check_turns(angles, 2 * std::numbers::pi);
    const double spans = angles.length() / (std::numbers::pi / 2);
    const int count = std::max(1, static_cast<int>(std::ceil(spans - quarter_turn_rounding * spans)));
    std::vector<double> breaks;
    for (int i = 0; i <= count; ++i) breaks.push_back(angles.low + angles.length() * i / count);
    breaks.back() = angles.high;

    std::vector<double> knots(1, breaks.front());
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i <= count; ++i) {
        knots.insert(knots.end(), 2, breaks[i]);
        const auto [x, y] = cosine_sine(breaks[i]);
        poles.emplace_back(x, y, 0.0);
        weights.push_back(1.0);
        if (i == count) break;
        const double half = 0.5 * (breaks[i + 1] - breaks[i]);
        const auto [next_x, next_y] = cosine_sine(breaks[i + 1]);
        // The tangents at the ends meet at (p + q) / (1 + p.q).
        const double meet = 1.0 + x * next_x + y * next_y;
        poles.emplace_back((x + next_x) / meet, (y + next_y) / meet, 0.0);
        weights.push_back(std::cos(half));
    }
    knots.push_back(breaks.back());
    return {KnotVector(2, std::move(knots)), std::move(poles), std::move(weights),
            ParameterMap::angular(std::move(breaks))};
}

std::optional<ProfileCurve> profile_curve(const Handle(Geom_Curve) & curve, const ParameterInterval& range) {
    if (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve))
        return profile_curve(trimmed->BasisCurve(), range);
    if (const auto line = Handle(Geom_Line)::DownCast(curve))
        return line_segment(range, to_vector(line->Value(range.low)), to_vector(line->Value(range.high)));
    if (const auto circle = Handle(Geom_Circle)::DownCast(curve)) {
        const gp_Ax2& frame = circle->Position();
        return conic_arc(range, to_vector(frame.Location()), circle->Radius() * to_vector(frame.XDirection()),
                         circle->Radius() * to_vector(frame.YDirection()));
    }
    if (const auto ellipse = Handle(Geom_Ellipse)::DownCast(curve)) {
        const gp_Ax2& frame = ellipse->Position();
        return conic_arc(range, to_vector(frame.Location()), ellipse->MajorRadius() * to_vector(frame.XDirection()),
                         ellipse->MinorRadius() * to_vector(frame.YDirection()));
    }
    if (const auto parabola = Handle(Geom_Parabola)::DownCast(curve)) return parabola_arc(range, parabola->Parab());
    if (const auto bspline = Handle(Geom_BSplineCurve)::DownCast(curve)) return spline(bspline, range);
    if (Handle(Geom_BezierCurve)::DownCast(curve)) return spline(GeomConvert::CurveToBSplineCurve(curve), range);
    return std::nullopt;
}

UnrolledKnots unroll_periodic(int degree, const std::vector<double>& knots, const std::vector<int>& multiplicities,
                              const ParameterInterval& range) {
    // One period of flat knots, without the last distinct one, which is the first of the next period. Pole 0 belongs
    // to the basis function whose domain knot number `degree` is the last copy of the first knot.
    std::vector<double> period;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) period.insert(period.end(), multiplicities[i], knots[i]);
    const int count = static_cast<int>(period.size());
    const double length = knots.back() - knots.front();
    check_turns({range.low - knots.front(), range.high - knots.front()}, length);
    const int shift = multiplicities.front() - 1 - degree;
    const auto wrap = [&](int i) { return (i % count + count) % count; };
    const auto knot = [&](int i) {
        const int at = i + shift;
        return period[wrap(at)] + length * std::floor(static_cast<double>(at) / count);
    };
    const double tolerance = knot_rounding * length;
    const int turn = static_cast<int>(std::floor((range.low - knots.front()) / length));
    int first = degree + (turn - 1) * count;
    while (knot(first + 1) <= range.low + tolerance) ++first;
    int last = first;
    while (knot(last + 1) < range.high - tolerance) ++last;

    UnrolledKnots result;
    for (int i = first - degree; i <= last + 1 + degree; ++i) result.knots.push_back(knot(i));
    for (int i = first - degree; i <= last; ++i) result.poles.push_back(wrap(i));
    return result;
}

}  // namespace umbilic
