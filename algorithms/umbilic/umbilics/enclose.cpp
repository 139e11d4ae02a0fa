// SPDX-License-Identifier: LGPL-2.1-or-later
#include <array>

#include <umbilic/bernstein/subdivision.h>
#include <umbilic/nurbs/knot_vector.h>
#include <umbilic/umbilics/equations.h>

namespace umbilic {

namespace {

using Basis = std::array<Interval, maximum_degree + 1>;
using Vector = std::array<Interval, 4>;

Interval dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], Interval()};
}

/// N4 with N4 . Y = det(P, P_u, P_v, Y).
Vector wedge(const Vector& p, const Vector& u, const Vector& v) {
    const auto minor = [&](int i, int j, int k) {
        return p[i] * (u[j] * v[k] - u[k] * v[j]) - p[j] * (u[i] * v[k] - u[k] * v[i]) +
               p[k] * (u[i] * v[j] - u[j] * v[i]);
    };
    return {-minor(1, 2, 3), minor(0, 2, 3), -minor(0, 1, 3), minor(0, 1, 2)};
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
        Vector result;
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
    Vector u = derivative(1, 0), v = derivative(0, 1);
    const Vector uu = derivative(2, 0), uv = derivative(1, 1), vv = derivative(0, 2);
    Vector normal;
    if (rational_) {
        const Vector point = derivative(0, 0);
        normal = wedge(point, u, v);
        for (int k = 0; k < 3; ++k) {
            u[k] = point[3] * u[k] - point[k] * u[3];
            v[k] = point[3] * v[k] - point[k] * v[3];
        }
        // u[3] and v[3] are used up: dot() takes the first three components.
    } else {
        normal = cross(u, v);
    }
    const auto normal_dot = [&](const Vector& x) { return dot(normal, x) + normal[3] * x[3]; };
    const Interval e = dot(u, u), f = dot(u, v), g = dot(v, v);
    const Interval l = normal_dot(uu), m = normal_dot(uv), n = normal_dot(vv);
    return {e * m - f * l, e * n - g * l};
}

}  // namespace umbilic
