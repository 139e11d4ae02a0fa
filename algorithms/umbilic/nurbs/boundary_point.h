// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/nurbs/nurbs_surface.h>
#include <umbilic/nurbs/trimming.h>

namespace umbilic {

/// Point of a trimming curve in space with two derivatives by the curve's parameter, and its surface parameters.
struct BoundaryPoint {
    Vector2 parameters = Vector2::Zero();
    Vector2 parameters_t = Vector2::Zero();  ///< derivative of the parameters
    Vector3 r, r_t, r_tt;
};

/// Image of a trimming curve on its surface at t. Parameters outside the surface's domain are clamped to it.
BoundaryPoint boundary_point(const NurbsSurface& surface, const TrimmingRegion& region, const TrimmingCurve& curve,
                             double t);

}  // namespace umbilic
