// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/nurbs/nurbs_surface.h>
#include <umbilic/nurbs/trimming.h>

namespace umbilic {

/// Extends `box` by the part of a surface that its region keeps, by branch and bound over the control points of its
/// pieces. The box is then short of that part, or larger than needed, by at most about 1e-5 of its diagonal.
void extend_box(const NurbsSurface& surface, const TrimmingRegion& region, BoundingBox& box);

}  // namespace umbilic
