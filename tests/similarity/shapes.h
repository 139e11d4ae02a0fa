// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/matching/prepared_model.h>
#include <umbilic/model/model.h>

namespace umbilic::test {

/// The free-form original of these tests: a smooth bicubic graph of side 1 with 9 x 9 poles.
NurbsSurface design();

/// B-spline surface of the given degree and pole count that interpolates `surface` at the Greville abscissae of uniform
/// knots: a re-approximation.
NurbsSurface reapproximated(const NurbsSurface& surface, int degree, int poles);

/// The surface with its pole (i, j) and the eight around it lifted along z: a local redesign.
NurbsSurface with_bump(const NurbsSurface& surface, int i, int j, double height);

/// The Bezier pieces of the surface with piece numbers below (u_pieces, v_pieces), each as a surface of its own.
std::vector<NurbsSurface> pieces(const NurbsSurface& surface, int u_pieces, int v_pieces);

/// Parabolic cylinder z = -x^2 for x < 0, flat for x > 0: quadratic in u with a simple knot at 0, so that the curvature
/// there jumps from 2 to 0.
NurbsSurface half_flat();

/// Features without umbilics: the nodes are the midpoints of n x n parameter cells of every whole face, with their
/// areas. A second way to the samples, independent of area_samples().
PreparedModel prepared_on_grid(const Model& model, int n = 40);

/// Certified star at the parameters given, as a search would report one.
Umbilic star_at(const Face& face, double u, double v);

}  // namespace umbilic::test
