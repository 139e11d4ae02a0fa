// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/nurbs/nurbs_surface.h>
#include <umbilic/nurbs/trimming.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// Regions of polynomial pieces that are umbilic everywhere, each piece given by its box: pieces that touch and lie on
/// one plane or sphere are one region. Area and boundary are those of the untrimmed surface.
std::vector<UmbilicRegion> make_regions(const NurbsSurface& surface, const std::vector<ParameterBox>& pieces);

/// Sets area and boundary of a region to those of its part inside the loops. The area is that of polygons that follow
/// the loops within TrimmingRegion::polyline_deviation, by Gauss-Legendre quadrature.
void trim(const NurbsSurface& surface, const TrimmingRegion& loops, UmbilicRegion& region);

}  // namespace umbilic
