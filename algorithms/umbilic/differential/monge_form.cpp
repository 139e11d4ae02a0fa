// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/differential/monge_form.h>

#include <cmath>

#include <Eigen/Geometry>

#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

Cubic Cubic::rotated(double angle) const {
    const double co = std::cos(angle), si = std::sin(angle);
    // (x, y) = (co x' - si y', si x' + co y'); each new coefficient is the polar form at the new axes.
    const auto polar = [&](double x1, double y1, double x2, double y2, double x3, double y3) {
        return a * x1 * x2 * x3 + b * (x1 * x2 * y3 + x1 * y2 * x3 + y1 * x2 * x3) +
               c * (x1 * y2 * y3 + y1 * x2 * y3 + y1 * y2 * x3) + d * y1 * y2 * y3;
    };
    return {polar(co, si, co, si, co, si), polar(co, si, co, si, -si, co), polar(co, si, -si, co, -si, co),
            polar(-si, co, -si, co, -si, co)};
}

MongeForm monge_form(const SurfaceDerivatives& d) {
    MongeForm result;
    result.normal = unit_normal(d);
    const double speed = d.r_u().norm();
    result.x = d.r_u() / speed;
    result.y = result.normal.cross(result.x);

    const auto [L, M, N] = second_form(d);
    const Christoffel g = christoffel(d);
    // C_ijk = n . r_ijk - (b_kl Gamma^l_ij + b_jl Gamma^l_ik + b_il Gamma^l_jk)
    const double uuu = result.normal.dot(d(3, 0)) - 3 * (L * g.u_uu + M * g.v_uu);
    const double uuv = result.normal.dot(d(2, 1)) - (M * g.u_uu + N * g.v_uu) - 2 * (L * g.u_uv + M * g.v_uv);
    const double uvv = result.normal.dot(d(1, 2)) - (L * g.u_vv + M * g.v_vv) - 2 * (M * g.u_uv + N * g.v_uv);
    const double vvv = result.normal.dot(d(0, 3)) - 3 * (M * g.u_vv + N * g.v_vv);

    // x = (1/speed, 0) and y = (p, q) as tangent vectors in the basis (r_u, r_v).
    const double b = d.r_v().dot(result.y);
    const double s = 1.0 / speed;
    const double q = 1.0 / b;
    const double p = -d.r_v().dot(result.x) / (speed * b);
    result.cubic.a = s * s * s * uuu;
    result.cubic.b = s * s * (p * uuu + q * uuv);
    result.cubic.c = s * (p * p * uuu + 2 * p * q * uuv + q * q * uvv);
    result.cubic.d = p * p * p * uuu + 3 * p * p * q * uuv + 3 * p * q * q * uvv + q * q * q * vvv;
    return result;
}

}  // namespace umbilic
