// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/stationary_points.h>
#include <umbilic/model/model.h>
#include <umbilic/nurbs/surface_derivatives.h>

namespace umbilic {

/// Orthogonal projection of a point: Newton's method on (r - p).r_u = (r - p).r_v = 0 from a guess (thesis 3.5.2,
/// (3.20)-(3.24)). Nothing if it does not converge, or to a point outside of the surface's domain.
std::optional<Vector2> foot_point(const NurbsSurface& surface, const Vector3& point, const Vector2& guess);

/// All feet of a point on a face: the stationary points of the distance inside the surface (find_stationary_points())
/// that the face's loops do not cut away, nearest first (thesis 3.5.6). A point whose feet fill a curve or a region,
/// such as a centre of curvature, has those that were told apart. Throws InvalidInput if the point is not finite.
std::vector<StationaryPoint> feet(const Face& face, const Vector3& point, const Progress& progress = {});

/// K of (3.32), with the sign of rho (T 15): the metric seen from a point above the foot at which `d` is taken.
Matrix2 projection_matrix(const SurfaceDerivatives& d, const Vector3& point);

/// |evolute_margin()| below which a foot counts as one of the evolute.
inline constexpr double least_evolute_margin = 1e-6;
/// Product of 1 + rho kappa over both principal curvatures, rho the signed distance: its sign changes at the evolute.
double evolute_margin(const SurfaceDerivatives& d, const Vector3& point);

/// Rates of the foot of a point that moves with the given velocity (3.29), on the side of the evolute where the margin
/// has the given sign; none at the evolute or where the surface is singular.
std::optional<Vector2> foot_rates(const SurfaceDerivatives& target, const Vector3& point, const Vector3& velocity,
                                  double sign);

}  // namespace umbilic
