// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <umbilic/bernstein/multivariate_polynomial.h>

namespace umbilic {

/// Coefficients of several polynomials of the same degrees on one box, one array after the other, each with its own
/// bound.
struct CoefficientArrays {
    std::vector<double> coefficients;
    std::vector<double> error;      ///< at least |coefficient - exact|
    std::vector<double> magnitude;  ///< largest |coefficient|

    int count() const { return static_cast<int>(error.size()); }
};

/// Polynomials of a system, raised to common degrees and scaled to one magnitude by powers of two, with what the
/// solver needs to know of them on a box of [0, 1]^l. Everything is rounded outward (docs/numerics.md, "Systems of
/// polynomials"). Holds scratch memory: one thread at a time.
class PolynomialSystem {
public:
    /// Throws InvalidInput if there are no polynomials, one is not valid (see check), or their numbers of unknowns
    /// differ.
    explicit PolynomialSystem(std::span<const MultivariatePolynomial> system);

    int polynomials() const { return root_.count(); }
    int unknowns() const { return static_cast<int>(degrees_.size()); }

    /// The system with `box` as its new [0, 1]^l; the box may reach out of [0, 1]^l.
    void restrict_to(std::span<const Interval> box, CoefficientArrays& result) const;

    /// A polynomial has no zero on the box.
    bool excluded(const CoefficientArrays& arrays) const;
    /// Every polynomial is zero on the box within its error.
    bool vanishes(const CoefficientArrays& arrays) const;
    /// Cuts `kept`, a part of [0, 1]^l, down to where the convex hulls of the control points, projected on the plane of
    /// each unknown, meet the axis (thesis 3.8.2). False if nothing is left.
    bool project(const CoefficientArrays& arrays, std::span<Interval> kept) const;
    /// How much the polynomials vary in each direction beyond their errors, relative to their magnitudes.
    Eigen::VectorXd variation(const CoefficientArrays& arrays) const;

    /// Pseudo-inverse of the mean derivative over the box, in floating point; nothing if that is rank deficient. Needs
    /// as many polynomials as unknowns, or more.
    std::optional<Eigen::MatrixXd> inverse_mean_derivative(const CoefficientArrays& arrays) const;
    /// The combinations g = `matrix` f, one for each row.
    void combine(const CoefficientArrays& arrays, const Eigen::MatrixXd& matrix, CoefficientArrays& result) const;
    /// Bounds on the row sums of |I - g'| over the box, of as many combinations as unknowns.
    Eigen::VectorXd contraction(const CoefficientArrays& combinations) const;
    /// Bound on |f_k(x) - f_k(y)| for points x, y of the box that differ by at most 1 in every coordinate, per unit.
    double slope(const CoefficientArrays& arrays, int k) const;

    /// Values, and derivatives where `jacobian` is given, in floating point; a point in [0, 1]^l has values within
    /// `value_error` of the exact ones.
    void evaluate(const CoefficientArrays& arrays, const Eigen::VectorXd& at, Eigen::VectorXd& values,
                  Eigen::MatrixXd* jacobian);
    double value_error(const CoefficientArrays& arrays, int k) const;

private:
    const double* array(const CoefficientArrays& arrays, int k) const { return arrays.coefficients.data() + k * size_; }
    /// Range of the differences of neighbouring coefficients in one direction, their error included.
    Interval differences(const CoefficientArrays& arrays, int k, int unknown) const;
    double contract(const double* coefficients, int derivative);

    std::vector<int> degrees_;
    std::vector<std::size_t> inner_;  ///< distance of neighbours in each direction
    std::size_t size_ = 0;            ///< coefficients of one polynomial
    CoefficientArrays root_;
    std::vector<std::vector<double>> basis_, slopes_;
    std::vector<double> scratch_;
};

}  // namespace umbilic
