// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/sensitivity.h>

#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/differential/monge_form.h>

namespace umbilic {

namespace {

/// Order of the derivatives that the cubic form is made of.
constexpr int form_order = 3;
/// Relative change of |r_u| or |r_v|, and share of a polynomial piece, by which difference quotients step.
constexpr double relative_step = 1e-5;

/// What is observed at a point: both parts of the traceless second fundamental form (zero at an umbilic), the curvature
/// and the cubic form in an orthonormal basis of the cubic forms.
using Observed = Eigen::Matrix<double, 7, 1>;
constexpr int kappa_row = 2, cubic_row = 3, cubic_size = 4;

Observed observed(const SurfaceDerivatives& d) {
    const MongeForm monge = monge_form(d);
    const auto [L, M, N] = second_form(d);
    // x = (s, 0) and y = (p, q) as tangent vectors in the basis (r_u, r_v).
    const double s = 1.0 / d.r_u().norm(), q = 1.0 / d.r_v().dot(monge.y), p = -d.r_v().dot(monge.x) * s * q;
    const double xx = s * s * L, xy = s * (p * L + q * M), yy = p * p * L + 2 * p * q * M + q * q * N;
    const auto& [a, b, c, cubic_d] = monge.cubic;
    Observed result;
    result << (xx - yy) / 2, xy, -(xx + yy) / 2, a, std::sqrt(3.0) * b, std::sqrt(3.0) * c, cubic_d;
    return result;
}

/// Derivatives of order up to three after a small step (du, dv) in the parameters. Needs order 4.
SurfaceDerivatives after_step(const SurfaceDerivatives& d, double du, double dv) {
    SurfaceDerivatives result = d;
    for (int k = 0; k <= form_order; ++k)
        for (int l = 0; k + l <= form_order; ++l) result(k, l) = d(k, l) + du * d(k + 1, l) + dv * d(k, l + 1);
    return result;
}

using Bounds = std::array<std::array<double, form_order + 1>, form_order + 1>;

/// Bounds on |d^(k+l) s / du^k dv^l| for the displacement s of the surface when no control point moves by more than 1.
Bounds displacement_bounds(const NurbsSurface& surface, double u, double v, Side u_side, Side v_side) {
    constexpr std::array<std::array<double, form_order + 1>, form_order + 1> binomial = {
        {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}}};
    const int p = surface.u_degree(), q = surface.v_degree();
    const int u_span = surface.u_knots().span(u, u_side), v_span = surface.v_knots().span(v, v_side);
    std::array<double, (form_order + 1) * (maximum_degree + 1)> u_basis, v_basis;
    surface.u_knots().basis(u_span, u, form_order, u_basis.data());
    surface.v_knots().basis(v_span, v, form_order, v_basis.data());
    Bounds weight{}, bound{};
    for (int i = 0; i <= p; ++i)
        for (int j = 0; j <= q; ++j) {
            const double w = surface.weight(u_span - p + i, v_span - q + j);
            for (int k = 0; k <= form_order; ++k)
                for (int l = 0; k + l <= form_order; ++l) {
                    const double product = w * u_basis[k * (p + 1) + i] * v_basis[l * (q + 1) + j];
                    weight[k][l] += product;
                    bound[k][l] += std::abs(product);
                }
        }
    // The quotient rule in magnitudes; without weights all derivatives of the denominator vanish.
    for (int n = 0; n <= form_order; ++n)
        for (int k = n; k >= 0; --k) {
            const int l = n - k;
            if (surface.rational())
                for (int i = 0; i <= k; ++i)
                    for (int j = 0; j <= l; ++j)
                        if (i + j > 0)
                            bound[k][l] +=
                                binomial[k][i] * binomial[l][j] * std::abs(weight[i][j]) * bound[k - i][l - j];
            bound[k][l] /= weight[0][0];
        }
    return bound;
}

/// Length of the polynomial piece that holds u.
double piece_length(const KnotVector& knots, double u, Side side) {
    const int span = knots.span(u, side);
    return knots.knots()[span + 1] - knots.knots()[span];
}

}  // namespace

UmbilicSensitivity umbilic_sensitivity(const NurbsSurface& surface, double u, double v, Side u_side, Side v_side) {
    const SurfaceDerivatives d = surface.derivatives(u, v, form_order + 1, u_side, v_side);
    const auto [E, F, G] = first_form(d);
    const double determinant = E * G - F * F;
    const Observed here = observed(d);

    Eigen::Matrix<double, 7, 2> slope;
    const double du = relative_step * piece_length(surface.u_knots(), u, u_side);
    const double dv = relative_step * piece_length(surface.v_knots(), v, v_side);
    slope.col(0) = (observed(after_step(d, du, 0.0)) - here) / du;
    slope.col(1) = (observed(after_step(d, 0.0, dv)) - here) / dv;
    // The umbilic follows the zero of the first two rows.
    const Matrix2 follow = -Matrix2(slope.topRows<2>()).inverse();
    if (!follow.allFinite()) {
        constexpr double unbounded = std::numeric_limits<double>::infinity();
        return {unbounded, unbounded, unbounded, unbounded, unbounded, unbounded};
    }

    UmbilicSensitivity result;
    // Per mm along the surface u changes by at most |grad u|, and so on.
    const double u_gradient = std::sqrt(G / determinant), v_gradient = std::sqrt(E / determinant);
    result.cubic_slope = slope.col(0).segment<cubic_size>(cubic_row).norm() * u_gradient +
                         slope.col(1).segment<cubic_size>(cubic_row).norm() * v_gradient;
    result.kappa_slope = std::abs(slope(kappa_row, 0)) * u_gradient + std::abs(slope(kappa_row, 1)) * v_gradient;

    const Bounds bounds = displacement_bounds(surface, u, v, u_side, v_side);
    result.metric = bounds[1][0] * u_gradient + bounds[0][1] * v_gradient;
    const double step = relative_step / result.metric;
    Matrix2 metric;
    metric << E, F, F, G;
    for (int n = 1; n <= form_order; ++n)
        for (int k = 0; k <= n; ++k) {
            const int l = n - k;
            if (bounds[k][l] == 0.0) continue;
            double kappa = 0.0, cubic = 0.0, way = 0.0;  // squares
            for (int axis = 0; axis < 3; ++axis) {
                SurfaceDerivatives displaced = d;
                displaced(k, l)[axis] += step * bounds[k][l];
                const Observed change = (observed(displaced) - here) / step;
                const Vector2 shift = follow * change.head<2>();
                const Observed total = change + slope * shift;
                kappa += total[kappa_row] * total[kappa_row];
                cubic += total.segment<cubic_size>(cubic_row).squaredNorm();
                way += shift.dot(metric * shift);
            }
            result.kappa += std::sqrt(kappa);
            result.cubic += std::sqrt(cubic);
            result.way += std::sqrt(way);
        }
    return result;
}

}  // namespace umbilic
