// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/bernstein/interval.h>

namespace umbilic {

/// Polynomial in any number of unknowns on [0, 1]^l, sum over all (i_0, ..., i_{l-1}) of coefficient times
/// B_{i_0}^{d_0}(x_0) ... B_{i_{l-1}}^{d_{l-1}}(x_{l-1}) (thesis 3.8.2). Coefficients are doubles with one bound on
/// the distance of all of them from the exact ones; every operation keeps that bound true (docs/numerics.md, "Systems
/// of polynomials").
struct MultivariatePolynomial {
    std::vector<int> degrees;          ///< one per unknown, 0 to maximum_product_degree
    std::vector<double> coefficients;  ///< the last unknown runs fastest
    double error = 0.0;                ///< at least |coefficient - exact| of every coefficient

    int unknowns() const { return static_cast<int>(degrees.size()); }
};

/// Number of coefficients of these degrees.
std::size_t coefficient_count(std::span<const int> degrees);

/// Throws InvalidInput, with `name` in its message, unless there is an unknown, the degrees are in range, there are as
/// many coefficients as they ask for, all of them are finite, and the error is finite and not negative.
void check(const MultivariatePolynomial& polynomial, const char* name);

/// Largest |coefficient| stored.
double magnitude(const MultivariatePolynomial& polynomial);

/// Interval that holds every exact coefficient, hence every value on [0, 1]^l.
Interval coefficient_range(const MultivariatePolynomial& polynomial);

/// Interval that holds the exact value at a point, which may lie outside [0, 1]^l.
Interval evaluate(const MultivariatePolynomial& polynomial, std::span<const double> at);

/// Partial derivative; that by an unknown of degree 0 is zero.
MultivariatePolynomial derivative(const MultivariatePolynomial& polynomial, int unknown);

/// The same polynomial with at least the given degrees.
MultivariatePolynomial elevated(const MultivariatePolynomial& polynomial, std::span<const int> degrees);

/// The same polynomial with `box` as its new [0, 1]^l. The box may reach a little outside: errors grow with the power
/// of the degree there. Throws InvalidInput unless each interval has a length and meets (0, 1).
MultivariatePolynomial restricted(const MultivariatePolynomial& polynomial, std::span<const Interval> box);

/// Sum, difference and product of polynomials in the same unknowns, of any degrees. Throw InvalidInput if the numbers
/// of unknowns differ.
MultivariatePolynomial operator+(const MultivariatePolynomial& a, const MultivariatePolynomial& b);
MultivariatePolynomial operator-(const MultivariatePolynomial& a, const MultivariatePolynomial& b);
MultivariatePolynomial operator*(const MultivariatePolynomial& a, const MultivariatePolynomial& b);
MultivariatePolynomial operator*(double factor, const MultivariatePolynomial& polynomial);

/// Restriction of one unknown of raw coefficient arrays to [low, high]; see restrict_unknown.
struct Restriction {
    double growth = 1.0;      ///< factor by which magnitudes and errors may have grown; 1 within [0, 1]
    double arithmetic = 0.0;  ///< rounding, relative to `growth` times the largest coefficient before
};

/// Restricts `blocks` arrays in a row, each of (degree + 1) x inner coefficients, to [low, high] in the outer index.
/// The ends are taken as exact.
Restriction restrict_unknown(std::size_t blocks, int degree, std::size_t inner, double* coefficients, double low,
                             double high);

}  // namespace umbilic
