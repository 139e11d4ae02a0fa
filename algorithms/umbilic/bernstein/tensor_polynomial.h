// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/bernstein/interval.h>

namespace umbilic {

/// Bounds on the distance of every Bernstein coefficient of an array from the exact one.
struct CoefficientBound {
    double rounding = 0.0;  ///< the input numbers taken as exact
    /// The input numbers taken as rounded values of others, so that the exact array is only known up to this.
    double input = 0.0;
};

/// Bivariate polynomial sum b_ij B_i^m(u) B_j^n(v), held in the scaled Bernstein basis: scaled[i * (n + 1) + j] =
/// binomial(m, i) binomial(n, j) b_ij. There a product is a plain convolution (thesis 3.6; Farouki and Rajan,
/// Algorithms for polynomials in Bernstein form, 1988). One bound for all b_ij is carried along; its derivation stands
/// in docs/numerics.md. Storage is kept when a polynomial is formed again.
struct TensorPolynomial {
    int u_degree = 0;
    int v_degree = 0;
    std::vector<double> scaled;
    double magnitude = 0.0;  ///< at least max |b_ij| of the stored coefficients
    CoefficientBound bound;
    /// Bounds on the error of each entry of `scaled`, the input numbers taken as rounded; empty unless asked for by
    /// giving them to the factors. They follow the variation over the array that `bound` loses, at three times the
    /// cost.
    std::vector<double> errors;

    int row_length() const { return v_degree + 1; }
    /// Zero polynomial of the given degrees.
    void set_zero(int m, int n);
    /// Sets `magnitude` from the coefficients.
    void measure();
    /// Interval that holds every Bernstein coefficient b_ij, hence every value on [0, 1]^2, for all inputs within their
    /// rounding.
    Interval coefficient_hull() const;
    /// The coefficients b_ij, row-major; `result` has (u_degree + 1) * (v_degree + 1) entries. Their distance from the
    /// exact ones is within what is returned.
    CoefficientBound bernstein_coefficients(std::span<double> result) const;
    /// Bounds on the error of each of those coefficients. Needs `errors`.
    void bernstein_errors(std::span<double> result) const;
};

/// sign * left * right, with sign +1 or -1.
struct ProductTerm {
    const TensorPolynomial* left = nullptr;
    const TensorPolynomial* right = nullptr;
    double sign = 1.0;
};

/// Sum of products that all have the same bidegree, with `errors` if a factor has them (those of the others are then
/// 0). `result` must not be one of the factors.
void sum_of_products(std::span<const ProductTerm> terms, TensorPolynomial& result);

/// Sum of products of any bidegrees, of the smallest bidegree that holds all of them: factors are raised where needed.
/// A factor that is exactly zero, as a second derivative across a linear direction, has no degree. `result` must not be
/// one of the factors.
void sum_of_unequal_products(std::span<const ProductTerm> terms, TensorPolynomial& result);

/// The same polynomial with its degrees raised.
void elevate(TensorPolynomial& polynomial, int u_raise, int v_raise);

/// Raises all to the smallest bidegree that holds each of them.
void raise_to_common_degree(std::span<TensorPolynomial* const> polynomials);

/// left + right, of the same bidegree; without `errors`.
void add(const TensorPolynomial& left, const TensorPolynomial& right, TensorPolynomial& result);

/// Partial derivatives with respect to u or v; that of degree 0 is the zero polynomial of degree 0. Without `errors`.
void derivative_u(const TensorPolynomial& polynomial, TensorPolynomial& result);
void derivative_v(const TensorPolynomial& polynomial, TensorPolynomial& result);

/// Side of the unit square.
enum class PatchEdge { u_low, u_high, v_low, v_high };

/// Divides by the linear factor that vanishes on `edge` (u, 1 - u, v or 1 - v). The row or column of coefficients on
/// that edge must be zero within its bound and is dropped; the bounds grow by the degree.
void divide_by_edge(TensorPolynomial& polynomial, PatchEdge edge);

/// Largest |b_ij| on an edge.
double edge_magnitude(const TensorPolynomial& polynomial, PatchEdge edge);

}  // namespace umbilic
