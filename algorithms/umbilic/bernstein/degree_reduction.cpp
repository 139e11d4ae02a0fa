// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/degree_reduction.h>

#include <cassert>

#include <Eigen/QR>

#include <umbilic/bernstein/binomials.h>
#include <umbilic/bernstein/rounding.h>

namespace umbilic {

namespace {

/// (high + 1) x (low + 1), rows of non-negative entries with sum 1: b_i = sum_j C(i, j) C(high - i, low - j) /
/// C(high, low) a_j.
Eigen::MatrixXd raising(int low, int high) {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(high + 1, low + 1);
    const double* all = binomials(high);
    for (int i = 0; i <= high; ++i)
        for (int j = 0; j <= low; ++j)
            if (j <= i && low - j <= high - i) result(i, j) = binomials(i)[j] * binomials(high - i)[low - j] / all[low];
    return result;
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
    return matrix.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace

DegreeReduction::DegreeReduction(CoefficientShape from, CoefficientShape to) : from_(from), to_(to) {
    assert(to.p <= from.p && to.q <= from.q);
    u_raise_ = raising(to.p, from.p);
    v_raise_ = raising(to.q, from.q);
    u_reduce_ = pseudo_inverse(u_raise_);
    v_reduce_ = pseudo_inverse(v_raise_);
}

double DegreeReduction::reduce(const double* coefficients, double* reduced) {
    const Eigen::Map<const Matrix> high(coefficients, from_.p + 1, from_.q + 1);
    Eigen::Map<Matrix> low(reduced, to_.p + 1, to_.q + 1);
    half_.noalias() = u_reduce_ * high;
    low.noalias() = half_ * v_reduce_.transpose();
    half_.noalias() = u_raise_ * low;
    raised_.noalias() = half_ * v_raise_.transpose();
    // Entries of the raising matrices are quotients of binomials, sums have as many terms as there are low
    // coefficients.
    const int roundings = 2 * (from_.p + from_.q) + to_.p + to_.q + 8;
    const double rounding = gamma_bound(roundings) * low.cwiseAbs().maxCoeff();
    return ((high - raised_).cwiseAbs().maxCoeff() * (1 + 2 * unit_roundoff) + rounding) * bound_slack;
}

}  // namespace umbilic
