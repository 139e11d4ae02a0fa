// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <umbilic/bernstein/rounding.h>
#include <umbilic/bernstein/subdivision.h>
#include <umbilic/nurbs/knot_vector.h>
#include <umbilic/umbilics/equations.h>

namespace umbilic {

namespace {

using Basis = std::array<Interval, maximum_degree + 1>;
template <typename Number>
using Vector = std::array<Number, 4>;

template <typename Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <typename Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], Number()};
}

/// N4 with N4 . Y = det(P, P_u, P_v, Y).
template <typename Number>
Vector<Number> wedge(const Vector<Number>& p, const Vector<Number>& u, const Vector<Number>& v) {
    const auto minor = [&](int i, int j, int k) {
        return p[i] * (u[j] * v[k] - u[k] * v[j]) - p[j] * (u[i] * v[k] - u[k] * v[i]) +
               p[k] * (u[i] * v[j] - u[j] * v[i]);
    };
    return {Number() - minor(1, 2, 3), minor(0, 2, 3), Number() - minor(0, 1, 3), minor(0, 1, 2)};
}

/// A and B from the derivatives of the homogeneous form at a point: derivative(k, l).
template <typename Number, typename Derivative>
std::array<Number, 2> umbilic_pair(const Derivative& derivative, bool rational) {
    Vector<Number> u = derivative(1, 0), v = derivative(0, 1);
    const Vector<Number> uu = derivative(2, 0), uv = derivative(1, 1), vv = derivative(0, 2);
    Vector<Number> normal;
    if (rational) {
        const Vector<Number> point = derivative(0, 0);
        normal = wedge(point, u, v);
        for (int k = 0; k < 3; ++k) {
            u[k] = point[3] * u[k] - point[k] * u[3];
            v[k] = point[3] * v[k] - point[k] * v[3];
        }
        // u[3] and v[3] are used up: dot() takes the first three components.
    } else {
        normal = cross(u, v);
    }
    const auto normal_dot = [&](const Vector<Number>& x) {
        return rational ? dot(normal, x) + normal[3] * x[3] : dot(normal, x);
    };
    const Number e = dot(u, u), f = dot(u, v), g = dot(v, v);
    const Number l = normal_dot(uu), m = normal_dot(uv), n = normal_dot(vv);
    return {e * m - f * l, e * n - g * l};
}

using Quad =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<113, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;
/// Largest relative error of one operation with Quad, a factor of two spared.
constexpr double quad_roundoff = 0x1p-112;

/// A number with what its error is relative to: the same expression in magnitudes, and the number of roundings on the
/// longest way to it. |value - exact| <= k u / (1 - k u) * magnitude with k roundings (Higham, Accuracy and Stability
/// of Numerical Algorithms, chapter 3: a product adds the counts of its factors and one, a sum takes the larger and
/// one).
struct Tracked {
    Quad value = 0;
    double magnitude = 0.0;
    int roundings = 0;

    Tracked() = default;
    Tracked(const Quad& exact) : value(exact), magnitude(std::abs(exact.convert_to<double>())) {}
    Tracked(double exact) : value(exact), magnitude(std::abs(exact)) {}
};

Tracked sum(const Tracked& a, const Tracked& b, const Quad& value) {
    Tracked result;
    result.value = value;
    result.magnitude = a.magnitude + b.magnitude;
    result.roundings = std::max(a.roundings, b.roundings) + 1;
    return result;
}
Tracked operator+(const Tracked& a, const Tracked& b) {
    return sum(a, b, a.value + b.value);
}
Tracked operator-(const Tracked& a, const Tracked& b) {
    return sum(a, b, a.value - b.value);
}
Tracked operator*(const Tracked& a, const Tracked& b) {
    Tracked result;
    result.value = a.value * b.value;
    result.magnitude = a.magnitude * b.magnitude;
    result.roundings = a.roundings + b.roundings + 1;
    return result;
}

Tracked rounded_once(const Quad& value) {
    Tracked result(value);
    result.roundings = 1;
    return result;
}
/// The difference of two doubles, and its reciprocal.
Tracked difference(double a, double b) {
    return rounded_once(Quad(a) - Quad(b));
}
Tracked reciprocal_difference(double a, double b) {
    Tracked result(Quad(1) / (Quad(a) - Quad(b)));
    result.roundings = 2;
    return result;
}

Interval enclosed(const Tracked& number) {
    const double value = number.value.convert_to<double>();
    const double units = number.roundings * quad_roundoff;
    return inflated(Interval(rounded_down(value), rounded_up(value)),
                    units / (1.0 - units) * number.magnitude * bound_slack * bound_slack);
}

/// The B-spline basis functions of one span with their first and second derivatives by the span's own parameter t in
/// [0, 1]: row k, column i belongs to control point span - degree + i.
std::array<std::vector<Tracked>, 3> spline_basis(const KnotVector& knots, const ParameterInterval& interval, double t) {
    const int p = knots.degree(), span = knots.span(interval.middle());
    const std::vector<double>& x = knots.knots();
    const Tracked length = difference(interval.high, interval.low);
    // This number is the place; its rounding moves it by less than 2^-58 of the patch, as knots are doubles.
    const Quad place = Quad(interval.low) + Quad(t) * length.value;
    const auto above = [&](int i) { return rounded_once(place - Quad(x[i])); };
    const auto below = [&](int i) { return rounded_once(Quad(x[i]) - place); };
    std::vector<Tracked> values = {Tracked(1.0)};
    std::array<std::vector<Tracked>, 3> result;
    // Derivative of the functions of degree k from those, or derivatives, of degree k - 1.
    const auto differentiated = [&](const std::vector<Tracked>& lower, int k) {
        std::vector<Tracked> higher(k + 1);
        for (int i = 0; i < k; ++i) {
            const int at = span - k + 1 + i;
            const Tracked slope =
                Tracked(static_cast<double>(k)) * length * lower[i] * reciprocal_difference(x[at + k], x[at]);
            higher[i] = higher[i] - slope;
            higher[i + 1] = higher[i + 1] + slope;
        }
        return higher;
    };
    for (int k = 1; k <= p; ++k) {
        if (k == p) result[1] = differentiated(values, k);
        if (k == p - 1) result[2] = differentiated(values, k);
        std::vector<Tracked> higher(k + 1);
        for (int i = 0; i < k; ++i) {
            const int at = span - k + 1 + i;
            const Tracked share = values[i] * reciprocal_difference(x[at + k], x[at]);
            higher[i] = higher[i] + below(at + k) * share;
            higher[i + 1] = higher[i + 1] + above(at) * share;
        }
        values = std::move(higher);
    }
    result[0] = std::move(values);
    if (p >= 2) result[2] = differentiated(result[2], p);
    return result;
}

}  // namespace

std::array<Interval, 2> UmbilicEquations::enclose(const Vector2& at) const {
    std::array<Basis, 3> u_basis, v_basis;
    for (int order = 0; order <= 2; ++order) {
        if (p_ >= order) bernstein_basis(p_ - order, at.x(), u_basis[order].data());
        if (q_ >= order) bernstein_basis(q_ - order, at.y(), v_basis[order].data());
    }
    const auto derivative = [&](int u_order, int v_order) {
        static constexpr double stencil[3][3] = {{1, 0, 0}, {-1, 1, 0}, {1, -2, 1}};
        const auto falling = [](int n, int order) { return order == 0 ? 1.0 : order == 1 ? n : n * (n - 1.0); };
        Vector<Interval> result;
        if (p_ < u_order || q_ < v_order) return result;
        for (int k = 0; k < (rational_ ? 4 : 3); ++k) {
            Interval sum;
            for (int i = 0; i <= p_ - u_order; ++i) {
                Interval row;
                for (int j = 0; j <= q_ - v_order; ++j) {
                    Interval difference;
                    for (int s = 0; s <= u_order; ++s)
                        for (int t = 0; t <= v_order; ++t) {
                            const double value = net_[k][(i + s) * (q_ + 1) + j + t];
                            difference = difference + Interval(stencil[u_order][s] * stencil[v_order][t] * value);
                        }
                    const double spread = net_bound_[k].rounding * static_cast<double>(1 << (u_order + v_order));
                    row = row + v_basis[v_order][j] * inflated(difference, rounded_up(spread));
                }
                sum = sum + u_basis[u_order][i] * row;
            }
            result[k] = Interval(falling(p_, u_order) * falling(q_, v_order)) * sum;
        }
        return result;
    };
    return umbilic_pair<Interval>(derivative, rational_);
}

std::array<Interval, 2> enclose_precisely(const NurbsSurface& surface, const BezierPatch& patch, const Vector2& at) {
    const int p = patch.u_degree, q = patch.v_degree;
    const EquationScale scale = equation_scale(patch);
    const auto u_basis = spline_basis(surface.u_knots(), patch.domain.u, at.x());
    const auto v_basis = spline_basis(surface.v_knots(), patch.domain.v, at.y());
    const int u_first = surface.u_knots().span(patch.domain.u.middle()) - p;
    const int v_first = surface.v_knots().span(patch.domain.v.middle()) - q;
    // Sums over i first, for each order in u.
    std::array<std::vector<Vector<Tracked>>, 3> columns;
    for (std::vector<Vector<Tracked>>& column : columns) column.resize(q + 1);
    for (int j = 0; j <= q; ++j)
        for (int i = 0; i <= p; ++i) {
            const Vector3& pole = surface.pole(u_first + i, v_first + j);
            const double weight = surface.weight(u_first + i, v_first + j);
            Vector<Tracked> point;
            for (int k = 0; k < 3; ++k)
                point[k] = Tracked(weight) * difference(pole[k] * scale.position, patch.origin[k] * scale.position);
            point[3] = Tracked(weight * scale.weight);
            for (int order = 0; order <= std::min(p, 2); ++order)
                for (int k = 0; k < (patch.rational ? 4 : 3); ++k)
                    columns[order][j][k] = columns[order][j][k] + u_basis[order][i] * point[k];
        }
    const auto derivative = [&](int u_order, int v_order) {
        Vector<Tracked> result;
        if (p < u_order || q < v_order) return result;
        for (int j = 0; j <= q; ++j)
            for (int k = 0; k < (patch.rational ? 4 : 3); ++k)
                result[k] = result[k] + v_basis[v_order][j] * columns[u_order][j][k];
        return result;
    };
    const std::array<Tracked, 2> pair = umbilic_pair<Tracked>(derivative, patch.rational);
    return {enclosed(pair[0]), enclosed(pair[1])};
}

}  // namespace umbilic
