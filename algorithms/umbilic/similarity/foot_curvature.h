// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/differential/curvature.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Every curvature a face may be said to have at (u, v) when the point is known within `radius` (mm): the one at (u, v)
/// and, where a knot line across which the curvature jumps (continuity below 2) or the seam of a closed surface passes
/// that close, the one-sided ones there. Normals point to the face's outward side. Singular points are left out.
std::vector<Curvature> curvatures_within(const Face& face, double u, double v, double radius);

/// Continuity a surface needs across a knot line for its curvature to be continuous, and for the cubic form of an
/// umbilic to be.
inline constexpr int curvature_continuity = 2;
inline constexpr int cubic_form_continuity = 3;

/// True if a knot line across which the surface has a continuity below `continuity` passes within `radius` (mm, to
/// first order) of (u, v).
bool near_knot_line(const NurbsSurface& surface, double u, double v, double radius, int continuity);

}  // namespace umbilic
