// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

/// One polynomial or rational piece of a NURBS surface, in the Bernstein basis on [0, 1] x [0, 1].
struct BezierPatch {
    int u_degree = 0;
    int v_degree = 0;
    bool rational = false;
    /// Part of the surface's domain this patch covers: u = domain.u.low + s * length for the local parameter s.
    ParameterBox domain;
    /// Point subtracted from every control point before extraction, so that rounding depends on the patch's own size
    /// and not on its distance from the origin (the subtraction of two doubles has a relative error only).
    Vector3 origin = Vector3::Zero();
    /// Homogeneous control points (w x, w y, w z, w), with x, y, z relative to `origin`; (i, j) at [i * (v_degree + 1)
    /// + j]; w = 1 if not rational.
    std::vector<Vector4> poles;
    /// Bound on the absolute error of each of the first three / the fourth component of `poles`, with the surface's own
    /// poles, weights and knots taken as exact.
    double position_error = 0.0;
    double weight_error = 0.0;

    const Vector4& pole(int i, int j) const { return poles[i * (v_degree + 1) + j]; }
};

/// The pieces of a surface between its distinct knots: piece (i, j) at [i * v_count + j].
struct BezierPatches {
    int u_count = 0;
    int v_count = 0;
    std::vector<BezierPatch> patches;
};

/// What the errors of one pole of a patch are relative to.
struct PoleMagnitude {
    double position = 0.0;  ///< sum of m |w (P - origin)|, m >= 0 the coefficients of the extraction
    double weight = 0.0;    ///< sum of m w
    double distance = 0.0;  ///< max |P - origin| over the control points that take part
};
/// Of every pole of a patch of `surface`.
std::vector<PoleMagnitude> pole_magnitudes(const NurbsSurface& surface, const BezierPatch& patch);

/// Units of roundoff that the extraction of a pole loses at most, relative to its magnitudes.
double extraction_units(int u_degree, int v_degree);

/// Splits a surface at all its distinct knots (thesis 3.6, 4.6.2). Each piece is formed directly from the polar form of
/// the surface with non-negative combinations of its (degree + 1)^2 control points, so the error does not accumulate
/// from piece to piece.
BezierPatches bezier_patches(const NurbsSurface& surface);

}  // namespace umbilic
