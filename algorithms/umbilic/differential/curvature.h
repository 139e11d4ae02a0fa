// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

/// Principal frame of a surface at a regular point, in the thesis's sign: kappa = -II / I, so a sphere whose normal
/// points outward has positive curvatures (OpenCASCADE's are the negatives, with maximum and minimum exchanged).
struct Curvature {
    Vector3 point = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();
    double kappa_max = 0.0;                    ///< greater principal curvature, 1/mm
    double kappa_min = 0.0;                    ///< smaller principal curvature, 1/mm
    Vector3 direction_max = Vector3::UnitX();  ///< unit tangent of kappa_max; its sign is arbitrary
    Vector3 direction_min = Vector3::UnitY();  ///< normal x direction_max: (max, min, normal) is right-handed
    /// False at singular points (normal undefined): nothing else is meaningful there.
    bool regular = false;

    double gaussian() const { return kappa_max * kappa_min; }
    double mean() const { return 0.5 * (kappa_max + kappa_min); }
};

/// Principal curvatures and directions (thesis (2.9)-(2.11), (2.23)) from derivatives of order 2. Computed in an
/// orthonormal tangent frame, so that the directions stay orthogonal in space; at an umbilic they are that frame.
Curvature curvature(const SurfaceDerivatives& d);

/// The same at (u, v) of a surface.
Curvature curvature(const NurbsSurface& surface, double u, double v);

/// Curvatures at many parameters; `result` has as many entries as `parameters`.
void curvatures(const NurbsSurface& surface, std::span<const Vector2> parameters, std::span<Curvature> result);

/// The same surface point seen from the other side: normal reversed, kappa_max and kappa_min negated and exchanged.
Curvature flipped(const Curvature& curvature);

}  // namespace umbilic
