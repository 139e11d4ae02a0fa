// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <vector>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/model/model.h>
#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic::support {

/// Bicubic Bezier patch of Table 3.1 of the thesis as rebuilt: control points (i/3, j/3, z_ij), z_ij = 0 except
/// z_11 = 1, z_12 = 0.6, z_21 = -1, z_22 = -0.6. It has exactly five umbilics.
NurbsSurface table_3_1_patch();

/// Bezier patch of the graph z = f(x, y) of a polynomial of degree at most (m, n) over [-1, 1]^2, by exact
/// interpolation on a tensor grid.
NurbsSurface graph_patch(int m, int n, const std::function<double(double, double)>& f);

/// Graph over [-1, 1]^2 whose umbilic at the origin has normal curvature kappa and cubic coefficients a, b, c, d
/// (thesis convention): z = -(kappa / 2)(x^2 + y^2) + (a x^3 + 3 b x^2 y + 3 c x y^2 + d y^3) / 6.
NurbsSurface monge_patch(double kappa, double a, double b, double c, double d);

/// Exact rational biquadratic ellipsoid octant x, y, z >= 0 (one collapsed edge at v = 1), half axes a, b, c; normal
/// outward.
NurbsSurface ellipsoid_octant(double a, double b, double c);

/// Exact rational biquadratic torus quarter-by-quarter patch set as one surface: 90 degrees of each circle, radii R >
/// r.
NurbsSurface torus_quarter(double major, double minor);

/// Exact surface of revolution about the z axis, in four quarters along u: the quadratic profile with the points (x,
/// z), x >= 0, and the weights given, along v. A closed profile makes a surface closed in v. Normal r_u x r_v.
NurbsSurface revolved(const KnotVector& knots, const std::vector<Vector2>& points, const std::vector<double>& weights);
/// Full sphere about the origin; u the longitude from the x axis, v from the south to the north pole; normal outward.
NurbsSurface full_sphere(double radius);
/// Full torus about the z axis; normal outward.
NurbsSurface full_torus(double major, double minor);
/// Full cone frustum about the z axis of radius r0 at z = 0 and r1 at z = height (a cylinder if equal); normal outward.
NurbsSurface full_cone(double r0, double r1, double height);

/// Bicubic B-spline graph over [0, 1]^2, n x n poles, uniform clamped knots, heights from a few sines ("smooth") with
/// the given seed.
NurbsSurface smooth_bicubic(int n, unsigned seed, double height = 0.2);
/// The same with independent random heights ("rough").
NurbsSurface rough_bicubic(int n, unsigned seed, double height = 0.05);
/// Polynomial or rational B-spline graph of any degree with random heights and, if rational, weights in [1,
/// weight_ratio].
NurbsSurface random_surface(int p, int q, int nu, int nv, unsigned seed, double height, double weight_ratio = 1.0);

/// The surface with every pole moved.
NurbsSurface transformed(const NurbsSurface& surface, const SimilarityTransform& transform);

/// Random similarity: rotation uniform, translation within a cube of half side `reach`, the given scale and hand.
SimilarityTransform random_similarity(unsigned seed, double scale, bool mirrored, double reach = 10.0);

/// Model of one untrimmed B-spline face per surface.
Model model_of(std::vector<NurbsSurface> surfaces);

}  // namespace umbilic::support
