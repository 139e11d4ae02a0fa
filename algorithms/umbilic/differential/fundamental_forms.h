// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/nurbs/surface_derivatives.h>

namespace umbilic {

/// Coefficients of the first fundamental form E du^2 + 2 F du dv + G dv^2 (thesis 2.1.1, (2.1)-(2.2)).
struct FirstForm {
    double E = 0.0, F = 0.0, G = 0.0;

    /// E G - F^2 = |r_u x r_v|^2, the square of the area element.
    double determinant() const { return E * G - F * F; }
};

/// Coefficients of the second fundamental form L du^2 + 2 M du dv + N dv^2 with L = n . r_uu and so on, n = r_u x r_v /
/// |r_u x r_v| (thesis (2.3)). Normal curvature is kappa = -II / I.
struct SecondForm {
    double L = 0.0, M = 0.0, N = 0.0;
};

/// Christoffel symbols: r_ij = gamma_ij^k r_k + b_ij n (thesis 2.1.3, (2.15), with the signs of gamma_uu^v and
/// gamma_vv^u corrected).
struct Christoffel {
    double u_uu = 0.0, u_uv = 0.0, u_vv = 0.0;  ///< upper index u
    double v_uu = 0.0, v_uv = 0.0, v_vv = 0.0;  ///< upper index v
};

/// A point is regular if |r_u x r_v| > regularity * |r_u| |r_v|: below, rounding decides the direction of the normal.
inline constexpr double regularity = 1e-12;

FirstForm first_form(const SurfaceDerivatives& d);
/// True if the normal is defined (see `regularity`).
bool regular(const SurfaceDerivatives& d);
/// Unit normal along r_u x r_v. The point must be regular.
Vector3 unit_normal(const SurfaceDerivatives& d);
/// Needs order 2 and a regular point.
SecondForm second_form(const SurfaceDerivatives& d);
/// Needs order 2 and a regular point.
Christoffel christoffel(const SurfaceDerivatives& d);
/// Normal curvature kappa = -II / I in the direction du : dv (thesis (2.5)-(2.8)), needs order 2 and a regular point.
double normal_curvature(const SurfaceDerivatives& d, double du, double dv);

}  // namespace umbilic
