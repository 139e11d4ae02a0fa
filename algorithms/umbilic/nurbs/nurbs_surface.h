// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/nurbs/knot_vector.h>
#include <umbilic/nurbs/surface_derivatives.h>

namespace umbilic {

/// Tensor-product NURBS surface (thesis 2.2, (2.35)). A value type: immutable after construction.
class NurbsSurface {
public:
    /// `poles`: control points, pole (i, j) at [i * v_knots.pole_count() + j], i along u. `weights`: as many positive
    /// numbers, or none for a polynomial surface; equal weights are dropped. Throws InvalidInput if sizes do not fit, a
    /// coordinate is not finite, or a weight is not finite and positive.
    NurbsSurface(KnotVector u_knots, KnotVector v_knots, std::vector<Vector3> poles, std::vector<double> weights = {});

    const KnotVector& u_knots() const { return u_knots_; }
    const KnotVector& v_knots() const { return v_knots_; }
    int u_degree() const { return u_knots_.degree(); }
    int v_degree() const { return v_knots_.degree(); }
    int u_pole_count() const { return u_knots_.pole_count(); }
    int v_pole_count() const { return v_knots_.pole_count(); }
    ParameterBox domain() const { return {u_knots_.domain(), v_knots_.domain()}; }

    bool rational() const { return !weights_.empty(); }
    const std::vector<Vector3>& poles() const { return poles_; }
    /// Empty if not rational.
    const std::vector<double>& weights() const { return weights_; }
    const Vector3& pole(int i, int j) const { return poles_[i * v_pole_count() + j]; }
    double weight(int i, int j) const { return weights_.empty() ? 1.0 : weights_[i * v_pole_count() + j]; }
    /// Box of the poles; it contains the surface (convex hull property).
    BoundingBox pole_box() const;

    /// Point at (u, v). Parameters outside the domain continue the outermost polynomial piece.
    Vector3 value(double u, double v) const;

    /// All partial derivatives up to `order` (0 to maximum_derivative) at (u, v), quotient rule for rational surfaces
    /// (thesis (2.36)-(2.38)). `u_side` and `v_side` choose the polynomial piece at a knot.
    SurfaceDerivatives derivatives(double u, double v, int order, Side u_side = Side::right,
                                   Side v_side = Side::right) const;

    /// The same of the polynomial piece (u_piece, v_piece), numbered as KnotVector::piece() does, continued beyond its
    /// own knots: what an integration that shall not see a jump of the third derivative needs.
    SurfaceDerivatives piece_derivatives(int u_piece, int v_piece, double u, double v, int order) const;

    /// Derivatives at many parameters (u, v); `result` has as many entries as `parameters`.
    void derivatives(std::span<const Vector2> parameters, int order, std::span<SurfaceDerivatives> result) const;

    /// Surface whose u and v are exchanged (the normal r_u x r_v changes sign).
    NurbsSurface swapped() const;
    /// Surface with u replaced by (low + high - u): the parameter runs backwards (the normal changes sign).
    NurbsSurface u_reversed() const;

private:
    SurfaceDerivatives span_derivatives(int u_span, int v_span, double u, double v, int order) const;

    KnotVector u_knots_;
    KnotVector v_knots_;
    std::vector<Vector3> poles_;
    std::vector<double> weights_;
};

}  // namespace umbilic
