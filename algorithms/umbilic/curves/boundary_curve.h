// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/curves/bezier_cell.h>
#include <umbilic/nurbs/boundary_point.h>
#include <umbilic/nurbs/nurbs_surface.h>
#include <umbilic/nurbs/trimming.h>

namespace umbilic {

/// Parameters at which the image of a trimming curve may lack a second derivative: breaks of the curve and crossings
/// with the breaks of the angular maps and with knot lines of the surface where it is less than C2, both ends included,
/// increasing.
std::vector<double> smooth_pieces(const NurbsSurface& surface, const TrimmingRegion& region,
                                  const TrimmingCurve& curve);

/// Model of the piece [low, high] of a trimming curve. Its second derivative is sampled; the error is twice the
/// greatest difference from the mean of the samples.
CellModel boundary_model(const NurbsSurface& surface, const TrimmingRegion& region, const TrimmingCurve& curve,
                         double low, double high);

/// The surface-parameter box of a curve that is a straight line along u or v in surface parameters.
std::optional<ParameterBox> iso_line(const TrimmingRegion& region, const TrimmingCurve& curve);

/// The image of a trimming curve on a flat surface, exactly: one Bezier curve for each span of the curve's knots.
/// Empty if the surface is not an affine image of its domain, or its parameters are not native.
std::vector<LocalPatch> flat_images(const NurbsSurface& surface, const TrimmingRegion& region,
                                    const TrimmingCurve& curve, const Vector3& origin);

}  // namespace umbilic
