// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <umbilic/bernstein/coefficient_array.h>
#include <umbilic/bernstein/interval.h>
#include <umbilic/bernstein/subdivision.h>
#include <umbilic/core/types.h>
#include <umbilic/curvature_points/box_part.h>

namespace umbilic {

/// Values of Gaussian and mean curvature, and how far they may differ: both tolerances 0, or both positive.
struct CurvatureLevel {
    double gaussian = 0.0;
    double mean = 0.0;
    double gaussian_tolerance = 0.0;
    double mean_tolerance = 0.0;

    bool exact() const { return gaussian_tolerance == 0.0; }
};

/// The equations
///   f_1 = q - K g(t, w) = 0,  f_2 = s + 2 H h(t, w) = 0,  g = t^2 / w^4,  h = t^(3/2) / w
/// of one level on one box (see CurvatureEquations; w = 1 if not rational), as linear combinations of the coefficient
/// arrays of q, s, t, w with bounds on what that leaves out. All bounds include rounding.
class CurvatureBox {
public:
    static constexpr int most_arrays = 4;

    /// Takes a box: `coefficients` holds the arrays of q, s, t (and w), one after the other. The polynomials meant are
    /// those plus ones whose coefficients of degree `error_shape`, at least `shape`, are below `errors`. Keeps a
    /// pointer to the coefficients.
    void take(CoefficientShape shape, bool rational, const double* coefficients,
              const std::array<double, most_arrays>& errors, CoefficientShape error_shape);

    /// Forms the two combinations. False if a level's value cannot lie on the box: 0 is not in the hull of one of them,
    /// tolerances included.
    bool linearise(const CurvatureLevel& level);
    /// After linearise(): both combinations are zero within the input's rounding.
    bool vanishes() const;
    /// After linearise(): the box lies wholly within the tolerances, or the ranges of K and H are below twice them.
    bool within(const CurvatureLevel& level) const;
    /// After linearise(): if K and H are nearly linear on the box, bands in which its points within the tolerances lie,
    /// and in both of which K and H are within twice the tolerances. Coordinates run from 0 to 1 over the box.
    std::optional<std::array<LinearBand, 2>> bands(const CurvatureLevel& level) const;
    /// After linearise(): further errors of the arrays would blur K and H by a small part of the tolerances only.
    bool tolerates(const CurvatureLevel& level, const std::array<double, most_arrays>& errors) const;
    /// After linearise(): see LevelBox::misfit.
    double misfit(const CurvatureLevel& level) const;

    /// After linearise(): the inverse of the mean derivative; none if it is nearly singular.
    std::optional<Matrix2> preconditioner() const;
    /// After linearise(): row-sum norm of I - (Y f)' over the box, infinity if that is above 1 anyway; none if a
    /// component of Y f has no zero.
    std::optional<double> contraction(const Matrix2& preconditioner);

    /// Y f at a point of [0, 1]^2, without linearisation.
    std::array<Interval, 2> residual(const CurvatureLevel& level, const Matrix2& preconditioner, const Vector2& at);
    /// Bounds on |components of Y f| at points of the box that are within the tolerances.
    Vector2 allowance(const CurvatureLevel& level, const Matrix2& preconditioner) const;
    /// Newton's method on f; false if it leaves [-reach, 1 + reach]^2.
    bool newton(const CurvatureLevel& level, double reach, Vector2& at);

    /// After linearise(): variation of the two combinations along u and v, relative to the tolerances, or to the
    /// combinations themselves where there are none.
    Vector2 variation(const CurvatureLevel& level) const;
    const std::array<double, most_arrays>& magnitudes() const { return magnitude_; }

private:
    enum Array { q, s, t, w };

    const double* array(int k) const { return coefficients_ + k * shape_.size(); }
    void combine(const CurvatureLevel& level);
    void linearise_integral(const CurvatureLevel& level);
    void linearise_rational(const CurvatureLevel& level);
    Vector2 largest_slope(int k) const;
    void evaluate(const Vector2& at, std::array<double, most_arrays>& value,
                  std::array<Vector2, most_arrays>* gradient);

    /// Bounds on the derivatives of a polynomial whose coefficients of degree error_shape_ are below `error`.
    Vector2 slope_error(double error) const { return 2.0 * error * Vector2(error_shape_.p, error_shape_.q); }

    CoefficientShape shape_, error_shape_;
    bool rational_ = false;
    int arrays_ = 0;
    const double* coefficients_ = nullptr;
    std::array<double, most_arrays> errors_{}, magnitude_{};
    std::array<Interval, most_arrays> range_{};
    /// Bounds on |derivatives| of t and w, told when first needed.
    std::array<std::optional<Vector2>, most_arrays> slope_;
    Interval g_, h_;

    /// f_k = sum weight_[k][a] array a + constant_[k], within own_remainder_[k] and error_[k]; its derivative is that
    /// of the sum within sum slack_[k][a] |derivative of array a|. remainder_ adds the tolerances.
    std::array<std::array<double, most_arrays>, 2> weight_{}, slack_{};
    std::array<double, 2> constant_{}, own_remainder_{}, remainder_{}, error_{};
    std::array<Interval, 2> hull_{};  ///< of the two sums with their constants, without remainder and error
    std::array<double, 2> size_{};
    std::optional<std::pair<double, double>> combined_for_;  ///< K and H of the level that combined_ is for
    std::vector<double> combined_, preconditioned_;
    BernsteinPoint point_;
};

}  // namespace umbilic
