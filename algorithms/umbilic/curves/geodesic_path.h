// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <umbilic/curves/relaxation.h>
#include <umbilic/curves/surface_path.h>

namespace umbilic {

/// Acceleration (u'', v'') of a geodesic of the velocity (p, q): -Gamma p q (thesis (2.21)-(2.22)).
Vector2 geodesic_acceleration(const SurfaceDerivatives& d, const Vector2& velocity);

/// Carries the velocity in the components 2 and 3 of a state to another piece or face at the same point: the tangent in
/// space and its length stay, up to the bend between the two.
void carry_tangent(const SurfaceDerivatives& before, const SurfaceDerivatives& after, PathState& y);

/// State of a geodesic by arc length: u, v, p = u', q = v', and the Jacobi field J with its derivative (J'' = -K J,
/// J(0) = 0, J'(0) = 1): turning the start by an angle moves a point sideways by J times that angle.
struct GeodesicState {
    Vector3 point, normal, tangent;  ///< tangent and normal of length 1, normal along r_u x r_v
    double jacobi = 0.0, jacobi_slope = 0.0;

    /// Tangential direction to the left.
    Vector3 side() const { return normal.cross(tangent); }
};

/// What a geodesic may not leave, and how exactly it is followed.
struct GeodesicBounds {
    const SmoothJoins* joins = nullptr;
    double tolerance = 1e-10;  ///< relative to sqrt(area of the face)
};

/// Geodesic from the parameters `start` along the tangent `direction`, which need not have length 1. It goes on
/// through the poles of a surface that is smooth there.
SurfacePath geodesic_path(const Face& face, const Vector2& start, const Vector3& direction, double length,
                          const GeodesicBounds& bounds, const Progress& progress = {});

/// Place of a geodesic path at the fraction x of a step.
GeodesicState geodesic_state(const PathStep& step, double x);

/// The boundary value problem of a geodesic on a face (thesis (3.12), with T 14's count: u and v at both ends), in the
/// components u, v, p, q by a parameter that runs from 0 to 1 at constant speed.
BoundaryValueProblem geodesic_problem(const Face& face, const Vector2& from, const Vector2& to);

/// Its usual first mesh: the straight line in the parameter plane.
Eigen::MatrixXd straight_guess(const Vector2& from, const Vector2& to, int points);

/// Throws InvalidInput, beginning with `what`, if the point is not finite or outside of the face or singular.
void check_on_face(const Face& face, const Vector2& at, const std::string& what);

}  // namespace umbilic
