// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/core/types.h>
#include <umbilic/nurbs/surface_derivatives.h>

namespace umbilic {

/// Gaussian and mean curvature and how they change along the surface, in an orthonormal tangent frame.
struct CurvatureGradient {
    double gaussian = 0.0;                     ///< K, 1/mm^2
    double mean = 0.0;                         ///< H, 1/mm, of kappa = -II / I
    Vector2 gaussian_slope = Vector2::Zero();  ///< 1/mm^3
    Vector2 mean_slope = Vector2::Zero();      ///< 1/mm^2

    /// Determinant of the two gradients, 1/mm^5: where it is 0 the values do not tell the place.
    double determinant() const { return gaussian_slope.x() * mean_slope.y() - gaussian_slope.y() * mean_slope.x(); }
};

/// Needs derivatives of order 3 at a regular point.
CurvatureGradient curvature_gradient(const SurfaceDerivatives& d);

}  // namespace umbilic
