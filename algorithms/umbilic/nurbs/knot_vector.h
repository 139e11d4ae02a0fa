// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <umbilic/core/types.h>

namespace umbilic {

/// Side from which a piecewise polynomial is evaluated at a knot.
enum class Side { left, right };

/// Highest degree accepted: OpenCASCADE's own limit.
inline constexpr int maximum_degree = 25;

/// Highest order of derivative the evaluators offer.
inline constexpr int maximum_derivative = 4;

/// Degrees up to this one are evaluated by tables of their basis functions.
inline constexpr int maximum_tabulated_degree = 3;

/// The basis functions of degree at most maximum_tabulated_degree on one polynomial piece [low, high], in the Bernstein
/// basis of that piece: column k belongs to control point first_pole + k.
struct BasisPiece {
    using Row = std::array<double, maximum_tabulated_degree + 1>;

    double low = 0.0, high = 1.0;
    int first_pole = 0;
    /// Row j: Bernstein coefficients number j of all functions (of degree p), of their first (p - 1) and second
    /// derivatives (p - 2).
    std::array<Row, maximum_tabulated_degree + 1> value{};
    std::array<Row, maximum_tabulated_degree> first{};
    std::array<Row, maximum_tabulated_degree - 1> second{};
};

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

    /// Number i of the polynomial piece [breaks[i], breaks[i + 1]) that holds u; the first or last outside the domain.
    int piece(double u) const;

    /// Span index (see span()) of polynomial piece number `piece`.
    int piece_span(int piece) const { return piece_spans_[piece]; }

    /// One table for each polynomial piece; empty above maximum_tabulated_degree.
    const std::vector<BasisPiece>& basis_pieces() const { return basis_pieces_; }

    /// Row-major (degree + 1)^2 matrix that takes the control points span - degree ... span to the Bernstein
    /// coefficients on that span. Non-negative; each entry has a relative error of at most 6 degree unit roundoffs.
    std::vector<double> bernstein_matrix(int span) const;

    /// Values and derivatives of the degree + 1 basis functions that do not vanish on `span`, at u (Cox-de Boor,
    /// thesis (2.33); algorithm A2.3 of The NURBS Book). Row k (k = 0..order) of `result`, of stride degree + 1, holds
    /// the k-th derivatives.
    void basis(int span, double u, int order, double* result) const;

private:
    BasisPiece tabulate(int span) const;

    int degree_;
    std::vector<double> knots_;
    std::vector<double> breaks_;
    std::vector<int> continuity_;
    std::vector<int> piece_spans_;
    /// Piece that holds the start of each of equally long parts of the domain, where the search for a span begins.
    std::vector<int> directory_;
    double directory_scale_ = 0.0;
    std::vector<BasisPiece> basis_pieces_;
};

}  // namespace umbilic
