// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <vector>

#include <Geom_BSplineSurface.hxx>
#include <Geom_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>

namespace umbilic::models {

using Surface = Handle(Geom_Surface);
using BSpline = Handle(Geom_BSplineSurface);

/// Control points; first index along u, second along v.
using Net = std::vector<std::vector<gp_Pnt>>;

/// Non-rational surface with clamped uniform knots on [0, 1] x [0, 1].
/// A direction with fewer poles than degree + 1 is given the degree poles - 1.
BSpline clamped_surface(const Net& net, int degree_u = 3, int degree_v = 3);

/// Net of the given size whose point (i, j) is place(i, j).
Net make_net(int size_u, int size_v, const std::function<gp_Pnt(int, int)>& place);

/// Greville abscissa i of a clamped uniform knot vector on [0, 1]: where x = u needs its poles.
double greville(int i, int poles, int degree = 3);

/// The same surface, point for point, in other clothes: degree raised to (degree_u, degree_v), one
/// knot inserted at each of the given parameters, u and v swapped, and both knot vectors mapped
/// affinely onto [0, 7.5] and [-2, 3].
BSpline reparametrised(const BSpline& surface, int degree_u, int degree_v, const std::vector<double>& knots_u,
                       const std::vector<double>& knots_v);

/// Interpolates the surface at the Greville points of a clamped uniform spline of the given degree
/// and size, after a smooth change of parameter, so that no knot line of the two surfaces coincides.
BSpline reapproximated(const BSpline& surface, int degree, int poles_u, int poles_v);

/// Largest distance from points of `from` (grid x grid, boundary included) to the surface `to`.
double largest_distance(const BSpline& from, const BSpline& to, int grid);

/// The face that fills the whole parameter range.
TopoDS_Face whole_face(const Surface& surface);

/// Faces sewn into one shell where their edges coincide.
TopoDS_Shape shell_of(const std::vector<TopoDS_Face>& faces);

}  // namespace umbilic::models
