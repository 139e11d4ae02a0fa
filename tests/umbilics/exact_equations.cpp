// SPDX-License-Identifier: LGPL-2.1-or-later
#include "exact_equations.h"

#include <algorithm>

namespace umbilic {

Power Power::u() const {
    Power result(std::max(m - 1, 0), n);
    for (int i = 1; i <= m; ++i)
        for (int j = 0; j <= n; ++j) result.at(i - 1, j) = i * at(i, j);
    return result;
}

Power Power::v() const {
    Power result(m, std::max(n - 1, 0));
    for (int i = 0; i <= m; ++i)
        for (int j = 1; j <= n; ++j) result.at(i, j - 1) = j * at(i, j);
    return result;
}

namespace {

Power operator*(const Power& a, const Power& b) {
    Power result(a.m + b.m, a.n + b.n);
    for (int i = 0; i <= a.m; ++i)
        for (int j = 0; j <= a.n; ++j) {
            if (a.at(i, j) == 0) continue;
            for (int k = 0; k <= b.m; ++k)
                for (int l = 0; l <= b.n; ++l) result.at(i + k, j + l) += a.at(i, j) * b.at(k, l);
        }
    return result;
}

Power combine(const Power& a, const Power& b, int sign) {
    Power result(std::max(a.m, b.m), std::max(a.n, b.n));
    for (int i = 0; i <= a.m; ++i)
        for (int j = 0; j <= a.n; ++j) result.at(i, j) += a.at(i, j);
    for (int i = 0; i <= b.m; ++i)
        for (int j = 0; j <= b.n; ++j) result.at(i, j) += sign * b.at(i, j);
    return result;
}
Power operator+(const Power& a, const Power& b) {
    return combine(a, b, 1);
}
Power operator-(const Power& a, const Power& b) {
    return combine(a, b, -1);
}

const Exact& binomial(int n, int k) {
    constexpr int most = 64;
    static const std::vector<std::vector<Exact>> table = [] {
        std::vector<std::vector<Exact>> result(most + 1);
        for (int row = 0; row <= most; ++row)
            for (int at = 0; at <= row; ++at)
                result[row].push_back(at == 0 || at == row ? Exact(1) : result[row - 1][at - 1] + result[row - 1][at]);
        return result;
    }();
    return table.at(n).at(k);
}

Power power_form(const std::vector<Exact>& b, int p, int q) {
    Power result(p, q);
    for (int i = 0; i <= p; ++i)
        for (int j = 0; j <= q; ++j)
            for (int k = 0; k <= i; ++k)
                for (int l = 0; l <= j; ++l)
                    result.at(i, j) += ((i - k + j - l) % 2 ? -1 : 1) * binomial(p, i) * binomial(i, k) *
                                       binomial(q, j) * binomial(j, l) * b[k * (q + 1) + l];
    return result;
}

}  // namespace

std::vector<Exact> bernstein(const Power& f, int p, int q) {
    const auto weights = [](int degree) {
        std::vector<std::vector<Exact>> result(degree + 1);
        for (int k = 0; k <= degree; ++k)
            for (int i = 0; i <= k; ++i) result[k].push_back(binomial(k, i) / binomial(degree, i));
        return result;
    };
    const auto u = weights(p), v = weights(q);
    std::vector<Exact> half((f.m + 1) * (q + 1), Exact(0)), result((p + 1) * (q + 1), Exact(0));
    for (int i = 0; i <= f.m; ++i)
        for (int l = 0; l <= q; ++l)
            for (int j = 0; j <= std::min(f.n, l); ++j) half[i * (q + 1) + l] += v[l][j] * f.at(i, j);
    for (int k = 0; k <= p; ++k)
        for (int i = 0; i <= std::min(f.m, k); ++i)
            for (int l = 0; l <= q; ++l) result[k * (q + 1) + l] += u[k][i] * half[i * (q + 1) + l];
    return result;
}

Pair exact_equations(const Net& net, int p, int q, bool rational) {
    std::array<Power, 4> x;
    for (int k = 0; k < (rational ? 4 : 3); ++k) x[k] = power_form(net[k], p, q);
    using Vector = std::array<Power, 3>;
    const auto dot = [](const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    Vector u, v, normal;
    std::array<Power, 3> second;
    if (rational) {
        // r_u w^2 and r_v w^2, and the normal N = (r_u x r_v), each up to a power of w that is divided out below.
        for (int k = 0; k < 3; ++k) {
            u[k] = x[3] * x[k].u() - x[k] * x[3].u();
            v[k] = x[3] * x[k].v() - x[k] * x[3].v();
        }
        // det(P, P_u, P_v, Y) expanded by its last column.
        const auto determinant = [&](const std::array<Power, 4>& y) {
            const auto minor = [&](int i, int j, int k) {
                return x[i] * (x[j].u() * x[k].v() - x[k].u() * x[j].v()) -
                       x[j] * (x[i].u() * x[k].v() - x[k].u() * x[i].v()) +
                       x[k] * (x[i].u() * x[j].v() - x[j].u() * x[i].v());
            };
            return minor(0, 1, 2) * y[3] - minor(0, 1, 3) * y[2] + minor(0, 2, 3) * y[1] - minor(1, 2, 3) * y[0];
        };
        second = {determinant({x[0].u().u(), x[1].u().u(), x[2].u().u(), x[3].u().u()}),
                  determinant({x[0].u().v(), x[1].u().v(), x[2].u().v(), x[3].u().v()}),
                  determinant({x[0].v().v(), x[1].v().v(), x[2].v().v(), x[3].v().v()})};
    } else {
        for (int k = 0; k < 3; ++k) {
            u[k] = x[k].u();
            v[k] = x[k].v();
        }
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            normal[k] = u[i] * v[j] - u[j] * v[i];
        }
        second = {dot(normal, {x[0].u().u(), x[1].u().u(), x[2].u().u()}),
                  dot(normal, {x[0].u().v(), x[1].u().v(), x[2].u().v()}),
                  dot(normal, {x[0].v().v(), x[1].v().v(), x[2].v().v()})};
    }
    const Power e = dot(u, u), f = dot(u, v), g = dot(v, v);
    return {e * second[1] - f * second[0], e * second[2] - g * second[0]};
}

Net exact_patch(const NurbsSurface& surface, int u_span, int v_span, const Vector3& origin) {
    const int p = surface.u_degree(), q = surface.v_degree();
    const auto polar = [](const KnotVector& knots, int span, int low_arguments, std::vector<Exact> d) {
        const int degree = knots.degree();
        const std::vector<double>& t = knots.knots();
        for (int level = 1; level <= degree; ++level) {
            const Exact argument = level <= low_arguments ? t[span] : t[span + 1];
            for (int i = degree; i >= level; --i) {
                const Exact low = t[span - degree + i], high = t[span + 1 + i - level];
                const Exact alpha = (argument - low) / (high - low);
                d[i] = (1 - alpha) * d[i - 1] + alpha * d[i];
            }
        }
        return d[degree];
    };
    Net result;
    for (int k = 0; k < 4; ++k)
        for (int i = 0; i <= p; ++i)
            for (int j = 0; j <= q; ++j) {
                std::vector<Exact> column;
                for (int a = 0; a <= p; ++a) {
                    std::vector<Exact> row;
                    for (int b = 0; b <= q; ++b) {
                        const int iu = u_span - p + a, iv = v_span - q + b;
                        const Exact w = surface.weight(iu, iv);
                        row.push_back(k == 3 ? w : w * (Exact(surface.pole(iu, iv)[k]) - Exact(origin[k])));
                    }
                    column.push_back(polar(surface.v_knots(), v_span, q - j, row));
                }
                result[k].push_back(polar(surface.u_knots(), u_span, p - i, column));
            }
    return result;
}

void keep(std::vector<Exact>& e, CoefficientShape shape, bool along_u, const Exact& t, bool low_part) {
    const int rows = shape.p + 1, length = shape.row_length();
    const int n = along_u ? shape.p : shape.q, lines = along_u ? length : rows;
    const auto at = [&](int line, int k) -> Exact& { return along_u ? e[k * length + line] : e[line * length + k]; };
    for (int line = 0; line < lines; ++line)
        for (int step = 1; step <= n; ++step) {
            if (low_part)
                for (int k = n; k >= step; --k) at(line, k) = (1 - t) * at(line, k - 1) + t * at(line, k);
            else
                for (int k = 0; k <= n - step; ++k) at(line, k) = (1 - t) * at(line, k) + t * at(line, k + 1);
        }
}

}  // namespace umbilic
