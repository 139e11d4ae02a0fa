// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <umbilic/bernstein/subdivision.h>
#include <umbilic/core/types.h>

namespace umbilic {

// What searches ask of one array of Bernstein coefficients on [0, 1]^2, in floating point without bounds on rounding.

/// Range of `count` > 0 coefficients, between which the values lie.
Interval coefficient_range(const double* coefficients, int count);

/// Ranges of the differences of neighbouring coefficients along u and along v: the derivatives lie in them times the
/// degree. 0 along a direction of degree 0.
std::array<Interval, 2> difference_hulls(CoefficientShape shape, const double* coefficients);

/// Range of the coefficients less those of the linear polynomial slope . (u, v).
Interval range_beside(CoefficientShape shape, const double* coefficients, const Vector2& slope);

/// Mean derivatives over [0, 1]^2.
Vector2 mean_derivative(CoefficientShape shape, const double* coefficients);

/// Sums of |differences| along u and along v, means over the columns and rows.
Vector2 mean_variation(CoefficientShape shape, const double* coefficients);

/// A point at which several arrays of one shape are evaluated. Memory is kept from point to point.
class BernsteinPoint {
public:
    /// In [0, 1]^2 or near it.
    void move_to(CoefficientShape shape, const Vector2& at);
    /// Value of the polynomial, and its derivatives where `gradient` is given.
    double value(const double* coefficients, Vector2* gradient = nullptr) const;

private:
    CoefficientShape shape_;
    std::vector<double> basis_;  ///< along u, its derivatives, along v, its derivatives
};

inline Vector2 mean_derivative(CoefficientShape shape, const double* c) {
    const Eigen::Map<const Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> rows(
        c, shape.p + 1, shape.row_length());
    return {(rows.row(shape.p) - rows.row(0)).mean(), (rows.col(shape.q) - rows.col(0)).mean()};
}

inline Vector2 mean_variation(CoefficientShape shape, const double* c) {
    const Eigen::Map<const Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> rows(
        c, shape.p + 1, shape.row_length());
    const int p = shape.p, q = shape.q;
    return {p == 0 ? 0.0 : (rows.bottomRows(p) - rows.topRows(p)).abs().sum() / shape.row_length(),
            q == 0 ? 0.0 : (rows.rightCols(q) - rows.leftCols(q)).abs().sum() / (p + 1)};
}

inline void BernsteinPoint::move_to(CoefficientShape shape, const Vector2& at) {
    shape_ = shape;
    basis_.resize(2 * (shape.p + shape.q + 2));
    double* const u = basis_.data();
    double* const v = u + 2 * (shape.p + 1);
    bernstein_basis(shape.p, at.x(), u, u + shape.p + 1);
    bernstein_basis(shape.q, at.y(), v, v + shape.q + 1);
}

inline double BernsteinPoint::value(const double* row, Vector2* gradient) const {
    const int p = shape_.p, length = shape_.row_length();
    const double* const bu = basis_.data();
    const double* const du = bu + p + 1;
    const double* const bv = du + p + 1;
    const double* const dv = bv + length;
    double f = 0.0, f_u = 0.0, f_v = 0.0;
    for (int i = 0; i <= p; ++i, row += length) {
        double along = 0.0, slope = 0.0;
        for (int j = 0; j < length; ++j) {
            along += bv[j] * row[j];
            if (gradient) slope += dv[j] * row[j];
        }
        f += bu[i] * along;
        f_u += du[i] * along;
        f_v += bu[i] * slope;
    }
    if (gradient) *gradient = {f_u, f_v};
    return f;
}

}  // namespace umbilic
