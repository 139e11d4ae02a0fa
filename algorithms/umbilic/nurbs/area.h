// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

/// Area of the whole surface, its trimming left out of account: adaptive Gauss-Legendre quadrature on every polynomial
/// piece until halving both sides changes the piece by less than `relative_accuracy` of its area, or of the mean area
/// of all pieces if that is more, or for `area_halvings` levels (edges that collapse with a root-like area element).
double surface_area(const NurbsSurface& surface, double relative_accuracy = 1e-9);

inline constexpr int area_halvings = 6;

}  // namespace umbilic
