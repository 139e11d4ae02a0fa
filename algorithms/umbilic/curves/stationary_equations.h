// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include <umbilic/bernstein/multivariate_polynomial.h>
#include <umbilic/bernstein/tensor_polynomial.h>
#include <umbilic/nurbs/bezier_patch.h>
#include <umbilic/umbilics/equations.h>

namespace umbilic {

/// Polynomials f_u, f_v with the zeros and signs of the derivatives of |r - p|^2 on a Bezier patch, in its own
/// parameters: (r - p).r_u and (r - p).r_v times powers of the weight, X.X_u and X.(w0 X1 - X0 w1) with the control
/// points X relative to w p and the halves of the net 0, 1. Their errors cover every surface that rounds to the given
/// one. At a collapsed edge the factors that vanish there are divided out.
struct StationaryEquations {
    std::array<MultivariatePolynomial, 2> f;
    /// By PatchEdge: all control points of the edge coincide within the input's rounding.
    std::array<bool, 4> collapsed{};
    /// By PatchEdge: it is collapsed and the distance is stationary at its point, within rounding.
    std::array<bool, 4> stationary_pole{};
};

StationaryEquations stationary_equations(const BezierPatch& patch, const InputRounding& input, const Vector3& point);

/// Whether all control points of an edge coincide within the input's rounding.
bool collapsed(const BezierPatch& patch, const InputRounding& input, PatchEdge edge);

/// The equation of one edge of a patch: a polynomial of its parameter.
MultivariatePolynomial stationary_edge_equation(const BezierPatch& patch, const InputRounding& input,
                                                const Vector3& point, PatchEdge edge);

}  // namespace umbilic
