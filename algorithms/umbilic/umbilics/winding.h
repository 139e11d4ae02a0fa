// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include <umbilic/nurbs/bezier_patch.h>
#include <umbilic/umbilics/equations.h>

namespace umbilic {

/// Angle in radians through which the vector (A, B) turns along an edge with increasing parameter, within rounding of
/// its exact value; none if the edge may hold a common zero. `u_length` and `v_length` are the sides of the patch's
/// part of the surface's domain: A / u_length and B / v_length are in the surface's parameters up to one common factor,
/// so that angles of neighbouring patches add up (docs/numerics.md).
std::optional<double> turning(const EdgeEquations& edge, double u_length, double v_length);

/// Winding number of (A, B), twice the sum of the indices inside, along the border of a rectangle within the surface's
/// domain. None if a common zero may lie on the border or the surface is not twice continuously differentiable across a
/// knot inside.
std::optional<double> rectangle_winding(const NurbsSurface& surface, const BezierPatches& patches,
                                        const InputRounding& input, const ParameterBox& rectangle);

/// Winding number from an angle that adds up to whole turns; none if it does not.
std::optional<double> whole_turns(double angle);

}  // namespace umbilic
