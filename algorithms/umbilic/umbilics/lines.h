// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/nurbs/nurbs_surface.h>
#include <umbilic/nurbs/trimming.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// Traces the lines of umbilics that run through the boxes: along a smooth line both equations vanish and their
/// Jacobian has rank 1, so each point is found by Newton's method across the line, and the next one along the null
/// direction. Lines keep to the boxes and to the parts of the surface that are twice continuously differentiable; they
/// are joined where two ends meet in space. A line takes the boxes it runs through with it; those it leaves stay in
/// `boxes`. `resolution` is the boxes' size relative to the domain.
std::vector<UmbilicLine> trace_lines(const NurbsSurface& surface, std::vector<ParameterBox>& boxes, double resolution);

/// Where a line lies with respect to the loops of its face.
Containment containment(const TrimmingRegion& region, const UmbilicLine& line);

}  // namespace umbilic
