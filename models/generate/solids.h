// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <TopoDS_Shape.hxx>

namespace umbilic::models {

/// Bracket of planes, cylinders, a cone and a torus fillet; three different moments of inertia and
/// no symmetry. Inside a box of 120 x 80 x 70 mm.
TopoDS_Shape bracket();

/// Ball of radius 25 mm round (40, -10, 15).
TopoDS_Shape ball();

/// Solid ring: major radius 40 mm, minor radius 12 mm, axis z.
TopoDS_Shape ring();

/// The ellipsoid with semi-axes 30, 20, 10 mm along x, y, z as one exact rational surface, closed,
/// with a seam and two poles. The seam is turned away from the umbilics, which lie in y = 0.
TopoDS_Shape ellipsoid();

}  // namespace umbilic::models
