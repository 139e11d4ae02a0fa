// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/types.h>

namespace umbilic {

/// Side from which a piecewise polynomial is evaluated at a knot.
enum class Side { left, right };

/// Highest degree accepted: OpenCASCADE's own limit.
inline constexpr int maximum_degree = 25;

/// Highest order of derivative the evaluators offer.
inline constexpr int maximum_derivative = 4;

/// Knot vector of a B-spline of a given degree, clamped or not (thesis 2.2, (2.32)-(2.33)).
/// The parameter domain is [knots[degree], knots[pole_count]].
class KnotVector {
public:
    /// Checks and takes the knots, with multiplicities written out (pole_count + degree + 1 numbers).
    /// Throws InvalidInput if the degree is outside [1, maximum_degree], there are fewer than 2 (degree + 1) knots, a
    /// knot is not finite or smaller than its predecessor, an interior multiplicity exceeds the degree, or the domain
    /// is empty.
    KnotVector(int degree, std::vector<double> knots);

    /// Knot vector of a single Bezier segment on [0, 1].
    static KnotVector bezier(int degree);

    int degree() const { return degree_; }
    int pole_count() const { return static_cast<int>(knots_.size()) - degree_ - 1; }
    const std::vector<double>& knots() const { return knots_; }
    ParameterInterval domain() const { return {knots_[degree_], knots_[pole_count()]}; }

    /// Distinct knots of the domain, both ends included, increasing.
    const std::vector<double>& breaks() const { return breaks_; }

    /// Order of continuity guaranteed at break number `index`: degree - multiplicity (interior breaks); -1 at the two
    /// ends.
    int continuity(int index) const { return continuity_[index]; }

    /// Index i with knots[i] <= u < knots[i+1] (side right) or knots[i] < u <= knots[i+1] (side left), a non-empty
    /// span; parameters outside the domain give the first or last span of the domain.
    int span(double u, Side side = Side::right) const;

    /// Values and derivatives of the degree + 1 basis functions that do not vanish on `span`, at u (Cox-de Boor,
    /// thesis (2.33); algorithm A2.3 of The NURBS Book). Row k (k = 0..order) of `result`, of stride degree + 1, holds
    /// the k-th derivatives.
    void basis(int span, double u, int order, double* result) const;

private:
    int degree_;
    std::vector<double> knots_;
    std::vector<double> breaks_;
    std::vector<int> continuity_;
};

}  // namespace umbilic
