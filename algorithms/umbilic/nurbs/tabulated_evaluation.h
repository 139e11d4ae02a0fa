// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <limits>
#include <span>

#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

/// Evaluates surfaces of degrees P and Q up to maximum_tabulated_degree by the tables of their knot vectors, with loops
/// of fixed length, derivatives up to order 2.
template <int P, int Q, int Order, bool Rational>
struct TabulatedEvaluation {
    static constexpr int dimension = Rational ? 4 : 3;
    /// Row k: sums over u with the k-th derivatives, for each of the Q + 1 control points along v.
    using Sums = std::array<std::array<double, dimension*(Q + 1)>, Order + 1>;

    static void point(const NurbsSurface& surface, double u, double v, SurfaceDerivatives& result) {
        point(surface, surface.u_knots().piece(u), surface.v_knots().piece(v), u, v, result);
    }

    static void point(const NurbsSurface& surface, int u_number, int v_number, double u, double v,
                      SurfaceDerivatives& result) {
        const BasisPiece& v_piece = surface.v_knots().basis_pieces()[v_number];
        Sums sums;
        sum_over_u(surface, u_number, u, v_piece.first_pole, sums);
        sum_over_v(sums, v_piece, v, result);
    }

    /// Many points; consecutive ones on a row u = const within one polynomial piece share the sums over u.
    static void points(const NurbsSurface& surface, std::span<const Vector2> parameters,
                       std::span<SurfaceDerivatives> results) {
        Sums sums{};
        double last_u = std::numeric_limits<double>::quiet_NaN();  // unequal to every parameter
        int last_v_piece = -1;
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            const double u = parameters[i].x(), v = parameters[i].y();
            const int number = surface.v_knots().piece(v);
            const BasisPiece& v_piece = surface.v_knots().basis_pieces()[number];
            if (u != last_u || number != last_v_piece)
                sum_over_u(surface, surface.u_knots().piece(u), u, v_piece.first_pole, sums);
            last_u = u;
            last_v_piece = number;
            sum_over_v(sums, v_piece, v, results[i]);
        }
    }

private:
    static void sum_over_v(const Sums& sums, const BasisPiece& piece, double v, SurfaceDerivatives& result) {
        const auto functions = basis<Q>(piece, v);
        result.order = Order;
        std::array<std::array<double, dimension>, (Order + 1) * (Order + 2) / 2> h;
        for (int n = 0, at = 0; n <= Order; ++n)
            for (int l = 0; l <= n; ++l, ++at)
                for (int c = 0; c < dimension; ++c) {
                    double sum = functions[l][0] * sums[n - l][c];
                    for (int j = 1; j <= Q; ++j) sum += functions[l][j] * sums[n - l][dimension * j + c];
                    h[at][c] = sum;
                }
        if constexpr (Rational) {
            // Quotient rule (thesis (2.36)-(2.38)) up to order 2. Divided, not multiplied by a reciprocal: derivatives
            // along a collapsed edge then vanish exactly more often.
            const double w = h[0][3];
            const auto vector = [&](int at) { return Vector3(h[at][0], h[at][1], h[at][2]); };
            result(0, 0) = vector(0) / w;
            if constexpr (Order >= 1) {
                result(1, 0) = (vector(1) - h[1][3] * result(0, 0)) / w;
                result(0, 1) = (vector(2) - h[2][3] * result(0, 0)) / w;
            }
            if constexpr (Order >= 2) {
                result(2, 0) = (vector(3) - 2 * h[1][3] * result(1, 0) - h[3][3] * result(0, 0)) / w;
                result(1, 1) =
                    (vector(4) - h[1][3] * result(0, 1) - h[2][3] * result(1, 0) - h[4][3] * result(0, 0)) / w;
                result(0, 2) = (vector(5) - 2 * h[2][3] * result(0, 1) - h[5][3] * result(0, 0)) / w;
            }
        } else {
            for (int n = 0, at = 0; n <= Order; ++n)
                for (int l = 0; l <= n; ++l, ++at) result(n - l, l) = Vector3(h[at][0], h[at][1], h[at][2]);
        }
    }

    /// Row k: k-th derivatives of the basis functions of degree D at t.
    template <int D>
    static std::array<std::array<double, D + 1>, Order + 1> basis(const BasisPiece& piece, double t) {
        // Quotients, not products with a reciprocal: they are exactly 0 and 1 at the ends.
        const double length = piece.high - piece.low;
        const double x = (t - piece.low) / length, y = (piece.high - t) / length;
        std::array<std::array<double, D + 1>, Order + 1> result;
        combine<D, D>(bernstein<D>(x, y), piece.value, result[0]);
        if constexpr (Order >= 1) combine<D, D - 1>(bernstein<D - 1>(x, y), piece.first, result[1]);
        if constexpr (Order >= 2) {
            if constexpr (D >= 2)
                combine<D, D - 2>(bernstein<D - 2>(x, y), piece.second, result[2]);
            else
                result[2].fill(0.0);
        }
        return result;
    }

    template <int D>
    static std::array<double, D + 1> bernstein(double x, double y) {
        if constexpr (D == 0) return {1.0};
        if constexpr (D == 1) return {y, x};
        if constexpr (D == 2) return {y * y, 2 * x * y, x * x};
        if constexpr (D == 3) return {y * y * y, 3 * x * (y * y), 3 * (x * x) * y, x * x * x};
    }

    template <int D, int N, typename Table>
    static void combine(const std::array<double, N + 1>& factors, const Table& table,
                        std::array<double, D + 1>& result) {
        for (int k = 0; k <= D; ++k) result[k] = factors[0] * table[0][k];
        for (int j = 1; j <= N; ++j)
            for (int k = 0; k <= D; ++k) result[k] += factors[j] * table[j][k];
    }

    static void sum_over_u(const NurbsSurface& surface, int u_number, double u, int v_first, Sums& sums) {
        const BasisPiece& u_piece = surface.u_knots().basis_pieces()[u_number];
        const auto functions = basis<P>(u_piece, u);
        const int stride = surface.v_pole_count();
        for (int i = 0; i <= P; ++i) {
            const int start = (u_piece.first_pole + i) * stride + v_first;
            std::array<double, dimension*(Q + 1)> weighted;
            const double* row = surface.poles()[start].data();
            if constexpr (Rational) {
                for (int j = 0; j <= Q; ++j) {
                    const double w = surface.weights()[start + j];
                    for (int c = 0; c < 3; ++c) weighted[4 * j + c] = w * row[3 * j + c];
                    weighted[4 * j + 3] = w;
                }
                row = weighted.data();
            }
            for (int k = 0; k <= Order; ++k) {
                const double factor = functions[k][i];
                if (i == 0) {
                    for (int m = 0; m < dimension * (Q + 1); ++m) sums[k][m] = factor * row[m];
                } else {
                    for (int m = 0; m < dimension * (Q + 1); ++m) sums[k][m] += factor * row[m];
                }
            }
        }
    }
};

/// Calls `use` with the evaluation for the surface's degrees; false, without a call, if there is none.
template <int Order, typename Use>
bool with_tabulated_evaluation(const NurbsSurface& surface, const Use& use) {
    const auto with_degrees = [&]<int P, int Q>() {
        if (surface.rational()) {
            use(TabulatedEvaluation<P, Q, Order, true>());
        } else {
            use(TabulatedEvaluation<P, Q, Order, false>());
        }
        return true;
    };
    static_assert(maximum_tabulated_degree == 3);
    if (surface.u_degree() > maximum_tabulated_degree || surface.v_degree() > maximum_tabulated_degree) return false;
    switch (4 * surface.u_degree() + surface.v_degree()) {
        case 4 * 3 + 3:
            return with_degrees.template operator()<3, 3>();
        case 4 * 2 + 2:
            return with_degrees.template operator()<2, 2>();
        case 4 * 1 + 1:
            return with_degrees.template operator()<1, 1>();
        case 4 * 3 + 2:
            return with_degrees.template operator()<3, 2>();
        case 4 * 3 + 1:
            return with_degrees.template operator()<3, 1>();
        case 4 * 2 + 3:
            return with_degrees.template operator()<2, 3>();
        case 4 * 2 + 1:
            return with_degrees.template operator()<2, 1>();
        case 4 * 1 + 3:
            return with_degrees.template operator()<1, 3>();
        case 4 * 1 + 2:
            return with_degrees.template operator()<1, 2>();
        default:
            return false;
    }
}

}  // namespace umbilic
