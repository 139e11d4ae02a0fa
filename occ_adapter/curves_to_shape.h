// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <TopoDS_Shape.hxx>

#include <umbilic/core/types.h>

namespace umbilic {

/// Edges through points in space, as one compound: a straight edge for two points, a cubic B-spline that interpolates
/// more. Points that coincide with the one before are left out; a curve of which fewer than two remain is none. Throws
/// NumericFailure if the kernel refuses a curve, or none is left.
TopoDS_Shape shape_of(const std::vector<std::vector<Vector3>>& curves);

}  // namespace umbilic
