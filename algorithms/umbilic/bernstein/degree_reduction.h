// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

#include <umbilic/bernstein/subdivision.h>

namespace umbilic {

/// Replaces bivariate polynomials by near ones of lower degree: on a small part of its domain a polynomial of high
/// degree hardly differs from one of degree six, whose coefficients are a small share.
class DegreeReduction {
public:
    /// Degrees of `to` are at most those of `from`.
    DegreeReduction(CoefficientShape from, CoefficientShape to);

    CoefficientShape from() const { return from_; }
    CoefficientShape to() const { return to_; }

    /// Forms the coefficients of the polynomial of lower degree that is nearest in the least squares of coefficients.
    /// Returns a bound on the difference of the two on [0, 1]^2: the largest difference of their coefficients at the
    /// higher degree, rounding included.
    double reduce(const double* coefficients, double* reduced);

private:
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    CoefficientShape from_, to_;
    Matrix u_raise_, v_raise_;    ///< coefficients of degree p as those of a higher degree
    Matrix u_reduce_, v_reduce_;  ///< their pseudo-inverses
    Matrix half_, raised_;
};

}  // namespace umbilic
