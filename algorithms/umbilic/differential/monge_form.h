// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/nurbs/surface_derivatives.h>

namespace umbilic {

/// Symmetric cubic form C(x, y) = a x^3 + 3 b x^2 y + 3 c x y^2 + d y^3 in an orthonormal tangent frame.
struct Cubic {
    double a = 0.0, b = 0.0, c = 0.0, d = 0.0;

    /// The form in the frame turned by `angle` (radians, counter-clockwise about the normal): C'(x', y') = C(x, y).
    Cubic rotated(double angle) const;
    /// a^2 + 3 b^2 + 3 c^2 + d^2, invariant to rotation.
    double squared_norm() const { return a * a + 3 * b * b + 3 * c * c + d * d; }
};

/// Covariant derivative of the second fundamental form (1/mm^2), a symmetric cubic by Codazzi's equations: at an
/// umbilic it is the cubic part times 6 of the height of the surface over its tangent plane along the normal
/// (thesis 2.1.4, (2.26)-(2.27)).
struct MongeForm {
    Vector3 x = Vector3::UnitX();  ///< r_u / |r_u|
    Vector3 y = Vector3::UnitY();  ///< normal x x
    Vector3 normal = Vector3::UnitZ();
    Cubic cubic;  ///< in the frame (x, y)
};

/// Needs derivatives of order 3 at a regular point.
MongeForm monge_form(const SurfaceDerivatives& d);

}  // namespace umbilic
