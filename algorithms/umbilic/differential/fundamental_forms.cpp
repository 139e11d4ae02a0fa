// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/differential/fundamental_forms.h>

#include <Eigen/Geometry>

namespace umbilic {

FirstForm first_form(const SurfaceDerivatives& d) {
    return {d.r_u().squaredNorm(), d.r_u().dot(d.r_v()), d.r_v().squaredNorm()};
}

bool regular(const SurfaceDerivatives& d) {
    const double cross = d.r_u().cross(d.r_v()).norm();
    return cross > regularity * d.r_u().norm() * d.r_v().norm();
}

Vector3 unit_normal(const SurfaceDerivatives& d) {
    return d.r_u().cross(d.r_v()).normalized();
}

SecondForm second_form(const SurfaceDerivatives& d) {
    const Vector3 n = unit_normal(d);
    return {n.dot(d.r_uu()), n.dot(d.r_uv()), n.dot(d.r_vv())};
}

Christoffel christoffel(const SurfaceDerivatives& d) {
    const auto [E, F, G] = first_form(d);
    const double determinant = E * G - F * F;
    // r_ij . r_k = gamma_ij^l g_lk, solved for gamma.
    const auto solve = [&](const Vector3& second) {
        const double a = second.dot(d.r_u());
        const double b = second.dot(d.r_v());
        return Vector2((G * a - F * b) / determinant, (E * b - F * a) / determinant);
    };
    const Vector2 uu = solve(d.r_uu()), uv = solve(d.r_uv()), vv = solve(d.r_vv());
    return {uu.x(), uv.x(), vv.x(), uu.y(), uv.y(), vv.y()};
}

double normal_curvature(const SurfaceDerivatives& d, double du, double dv) {
    const auto [E, F, G] = first_form(d);
    const auto [L, M, N] = second_form(d);
    return -(L * du * du + 2 * M * du * dv + N * dv * dv) / (E * du * du + 2 * F * du * dv + G * dv * dv);
}

}  // namespace umbilic
