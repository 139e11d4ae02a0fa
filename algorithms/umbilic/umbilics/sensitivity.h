// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

/// How an umbilic answers to a displacement of the surface's control points: bounds to first order, each for a
/// displacement of 1 mm at most of every control point in any direction (weights and knots stay).
struct UmbilicSensitivity {
    double kappa = 0.0;   ///< of the normal curvature, 1/mm per mm
    double cubic = 0.0;   ///< of the cubic form in the norm of Cubic::squared_norm(), 1/mm^2 per mm
    double way = 0.0;     ///< of the umbilic along the surface, mm per mm
    double metric = 0.0;  ///< of |r_u| and |r_v|, relative, 1/mm: terms of second order are small while this is
    /// Change of the cubic form and of the curvature per mm of way along the undisplaced surface.
    double cubic_slope = 0.0, kappa_slope = 0.0;
};

/// At the umbilic with parameters (u, v), evaluated in the polynomial piece on the given sides. All members are
/// infinite where the umbilic is not simple (|omega| = 1). The surface must be regular there.
UmbilicSensitivity umbilic_sensitivity(const NurbsSurface& surface, double u, double v, Side u_side, Side v_side);

}  // namespace umbilic
