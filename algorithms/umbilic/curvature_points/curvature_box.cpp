// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/curvature_box.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include <umbilic/bernstein/rounding.h>

namespace umbilic {

namespace {

using Values = Eigen::Map<const Eigen::ArrayXd>;

/// A preconditioner is used down to this relative determinant.
constexpr double least_relative_determinant = 1e-9;
/// Both equations below this multiple of their bounds are identically zero.
constexpr double vanishing = 4.0;
constexpr int newton_steps = 12;
/// A box that meets the region within the tolerances counts as part of it if K and H vary by less than this over it, in
/// units of the tolerances: so it reaches out of the region by as much at most.
constexpr double widest_range = 3.0;
/// On a convex part of a box that is taken for a part of that region K and H are within so many tolerances.
constexpr double widest_part = 2.0;
/// Part of the tolerances that a change of the arrays may use up.
constexpr double small_blur = 0.05;
/// Roundings in the constants and weights of a linearisation, in units of roundoff of its largest term.
constexpr double linearisation_units = 32 * unit_roundoff;

}  // namespace

void CurvatureBox::take(CoefficientShape shape, bool rational, const double* coefficients,
                        const std::array<double, most_arrays>& errors, CoefficientShape error_shape) {
    shape_ = shape;
    error_shape_ = error_shape;
    rational_ = rational;
    arrays_ = rational ? 4 : 3;
    coefficients_ = coefficients;
    errors_ = errors;
    combined_for_.reset();
    for (int k = 0; k < arrays_; ++k) {
        const Interval values = coefficient_range(array(k), shape_.size());
        magnitude_[k] = values.magnitude();
        range_[k] = inflated(values, errors_[k]);
        slope_[k].reset();
    }
    // t is a square.
    range_[t].low = std::max(range_[t].low, 0.0);
    g_ = square(range_[t]);
    h_ = range_[t] * sqrt(range_[t]);
    if (rational_) {
        g_ = g_ / square(square(range_[w]));
        h_ = h_ / range_[w];
    }
}

Vector2 CurvatureBox::largest_slope(int k) const {
    const std::array<Interval, 2> d = difference_hulls(shape_, array(k));
    const double rounding = 4 * unit_roundoff * magnitude_[k];
    return Vector2(shape_.p * (d[0].magnitude() + rounding), shape_.q * (d[1].magnitude() + rounding)) +
           slope_error(errors_[k]);
}

void CurvatureBox::linearise_integral(const CurvatureLevel& level) {
    const double low = range_[t].low, high = range_[t].high;
    const double centre = 0.5 * (low + high), half = std::max(high - centre, centre - low);
    const double gaussian = level.gaussian, mean = level.mean, root = std::sqrt(centre);
    // t^2 = 2 c t - c^2 + [0, r^2].
    weight_[0] = {1.0, 0.0, -2 * gaussian * centre, 0.0};
    constant_[0] = gaussian * (centre * centre - 0.5 * half * half);
    own_remainder_[0] = 0.5 * std::abs(gaussian) * half * half;
    slack_[0] = {0.0, 0.0, 2 * std::abs(gaussian) * half, 0.0};
    // t^(3/2) is convex: above its tangent, farthest at an end.
    const auto above = [&](double x) { return x * std::sqrt(x) - root * (1.5 * x - 0.5 * centre); };
    const double gap = std::max({above(low), above(high), 0.0});
    weight_[1] = {0.0, 1.0, 3 * mean * root, 0.0};
    constant_[1] = mean * (gap - root * centre);
    own_remainder_[1] = std::abs(mean) * gap;
    slack_[1] = {0.0, 0.0, 3 * std::abs(mean) * std::max(std::sqrt(high) - root, root - std::sqrt(low)), 0.0};
}

void CurvatureBox::linearise_rational(const CurvatureLevel& level) {
    const Interval tr = range_[t], wr = range_[w];
    const double tc = 0.5 * (tr.low + tr.high), wc = 0.5 * (wr.low + wr.high);
    const double dt = std::max(tr.high - tc, tc - tr.low), dw = std::max(wr.high - wc, wc - wr.low);
    const double gaussian = level.gaussian, mean = 2 * level.mean;
    if (!(wr.low > 0.0)) {
        // Outside of the patch, where it has no meaning: neither exclusion nor proof.
        weight_ = {{{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}}};
        constant_ = {};
        own_remainder_.fill(std::numeric_limits<double>::infinity());
        slack_[0] = slack_[1] = {0.0, 0.0, own_remainder_[0], own_remainder_[0]};
        return;
    }
    // Greatest second derivatives of g and h.
    const double w1 = wr.low, w2 = w1 * w1, w4 = w2 * w2;
    const double g_tt = 2 / w4, g_tw = 8 * tr.high / (w4 * w1), g_ww = 20 * tr.high * tr.high / (w4 * w2);
    const double root = std::sqrt(tr.high);
    const double h_tt = 0.75 / (std::sqrt(tr.low) * w1), h_tw = 1.5 * root / w2, h_ww = 2 * root * tr.high / (w2 * w1);
    const double wc2 = wc * wc, wc4 = wc2 * wc2, g0 = tc * tc / wc4;
    weight_[0] = {1.0, 0.0, -gaussian * 2 * tc / wc4, gaussian * 4 * g0 / wc};
    // g0 + g_t (t - tc) + g_w (w - wc) = g_t t + g_w w + 3 g0.
    constant_[0] = -gaussian * 3 * g0;
    own_remainder_[0] = std::abs(gaussian) * 0.5 * (g_tt * dt * dt + 2 * g_tw * dt * dw + g_ww * dw * dw);
    slack_[0] = {0.0, 0.0, std::abs(gaussian) * (g_tt * dt + g_tw * dw), std::abs(gaussian) * (g_tw * dt + g_ww * dw)};
    const double h0 = tc * std::sqrt(tc) / wc;
    weight_[1] = {0.0, 1.0, mean * 1.5 * std::sqrt(tc) / wc, -mean * h0 / wc};
    // h0 + h_t (t - tc) + h_w (w - wc) = h_t t + h_w w + h0 / 2.
    constant_[1] = mean * 0.5 * h0;
    // Where the range of t begins at 0, h_tt is infinite.
    if (mean == 0.0) {
        own_remainder_[1] = 0.0;
        slack_[1] = {};
        return;
    }
    own_remainder_[1] = std::abs(mean) * 0.5 * (h_tt * dt * dt + 2 * h_tw * dt * dw + h_ww * dw * dw);
    slack_[1] = {0.0, 0.0, std::abs(mean) * (h_tt * dt + h_tw * dw), std::abs(mean) * (h_tw * dt + h_ww * dw)};
}

bool CurvatureBox::linearise(const CurvatureLevel& level) {
    // By the ranges alone first: most boxes of most levels end here.
    const Interval gaussian{level.gaussian - level.gaussian_tolerance, level.gaussian + level.gaussian_tolerance};
    const Interval mean{level.mean - level.mean_tolerance, level.mean + level.mean_tolerance};
    if (!(range_[q] - gaussian * g_).contains(0.0) || !(range_[s] + 2.0 * mean * h_).contains(0.0)) return false;

    if (!combined_for_ || *combined_for_ != std::pair(level.gaussian, level.mean)) combine(level);
    remainder_[0] = (own_remainder_[0] + level.gaussian_tolerance * g_.high) * bound_slack;
    remainder_[1] = (own_remainder_[1] + 2 * level.mean_tolerance * h_.high) * bound_slack;
    return hull_[0].mignitude() <= remainder_[0] + error_[0] && hull_[1].mignitude() <= remainder_[1] + error_[1];
}

void CurvatureBox::combine(const CurvatureLevel& level) {
    combined_for_ = std::pair(level.gaussian, level.mean);
    if (rational_)
        linearise_rational(level);
    else
        linearise_integral(level);
    const int count = shape_.size();
    combined_.resize(2 * count);
    for (int k = 0; k < 2; ++k) {
        Eigen::Map<Eigen::ArrayXd> f(combined_.data() + k * count, count);
        const auto& weight = weight_[k];
        const Values own(array(k), count), of_t(array(t), count);
        if (rational_)
            f = own + weight[t] * of_t + weight[w] * Values(array(w), count);
        else
            f = own + weight[t] * of_t;
        double terms = std::abs(constant_[k]) + own_remainder_[k];
        error_[k] = 0.0;
        for (int a = 0; a < arrays_; ++a) {
            error_[k] += std::abs(weight[a]) * errors_[a];
            terms += std::abs(weight[a]) * magnitude_[a];
        }
        error_[k] = (error_[k] + linearisation_units * terms) * bound_slack;
        const Interval values = coefficient_range(f.data(), count);
        size_[k] = values.magnitude();
        hull_[k] = {values.low + constant_[k], values.high + constant_[k]};
    }
}

bool CurvatureBox::vanishes() const {
    const auto zero = [&](int k) { return hull_[k].magnitude() + remainder_[k] <= vanishing * error_[k]; };
    return zero(0) && zero(1);
}

bool CurvatureBox::within(const CurvatureLevel& level) const {
    if (!(g_.low > 0.0 && h_.low > 0.0)) return false;
    const double k_room = level.gaussian_tolerance * g_.low, h_room = 2 * level.mean_tolerance * h_.low;
    const double k_rest = own_remainder_[0] * bound_slack + error_[0];
    const double h_rest = own_remainder_[1] * bound_slack + error_[1];
    if (hull_[0].magnitude() + k_rest <= k_room && hull_[1].magnitude() + h_rest <= h_room) return true;
    return hull_[0].high - hull_[0].low + 2 * k_rest <= widest_range * k_room &&
           hull_[1].high - hull_[1].low + 2 * h_rest <= widest_range * h_room;
}

std::optional<std::array<LinearBand, 2>> CurvatureBox::bands(const CurvatureLevel& level) const {
    const double least[2] = {level.gaussian_tolerance * g_.low, 2 * level.mean_tolerance * h_.low};
    const double most[2] = {level.gaussian_tolerance * g_.high, 2 * level.mean_tolerance * h_.high};
    std::array<LinearBand, 2> result;
    for (int k = 0; k < 2; ++k) {
        // Bound on f_k less its linear part, before the coefficients' own distance from that.
        double rest = own_remainder_[k] + error_[k];
        if (!(most[k] + 2 * rest <= widest_part * least[k])) return std::nullopt;
        const double* f = combined_.data() + k * shape_.size();
        const Vector2 slope = mean_derivative(shape_, f);
        const Interval beside = range_beside(shape_, f, slope);
        const double size = size_[k] + std::abs(constant_[k]) + slope.lpNorm<1>();
        rest = (rest + 0.5 * (beside.high - beside.low) + linearisation_units * size) * bound_slack;
        const bool everywhere = hull_[k].magnitude() + own_remainder_[k] * bound_slack + error_[k] <= least[k];
        if (!everywhere && !(most[k] + 2 * rest <= widest_part * least[k])) return std::nullopt;
        result[k] = {slope, constant_[k] + beside.middle(),
                     everywhere ? std::numeric_limits<double>::infinity() : most[k] + rest};
    }
    return result;
}

bool CurvatureBox::tolerates(const CurvatureLevel& level, const std::array<double, most_arrays>& errors) const {
    const double room[2] = {level.gaussian_tolerance * g_.low, 2 * level.mean_tolerance * h_.low};
    for (int k = 0; k < 2; ++k) {
        double blur = 0.0;
        for (int a = 0; a < arrays_; ++a) blur += std::abs(weight_[k][a]) * errors[a];
        if (!(blur <= small_blur * room[k])) return false;
    }
    return true;
}

double CurvatureBox::misfit(const CurvatureLevel& level) const {
    if (level.exact() || !(g_.low > 0.0 && h_.low > 0.0)) return std::numeric_limits<double>::infinity();
    return std::max(std::abs(hull_[0].middle()) / (level.gaussian_tolerance * g_.middle()),
                    std::abs(hull_[1].middle()) / (2 * level.mean_tolerance * h_.middle()));
}

Vector2 CurvatureBox::allowance(const CurvatureLevel& level, const Matrix2& y) const {
    const Vector2 f(level.gaussian_tolerance * g_.high, 2 * level.mean_tolerance * h_.high);
    return y.cwiseAbs() * f * bound_slack;
}

std::optional<Matrix2> CurvatureBox::preconditioner() const {
    Matrix2 mean;
    for (int k = 0; k < 2; ++k) mean.row(k) = mean_derivative(shape_, combined_.data() + k * shape_.size()).transpose();
    const double rows = mean.row(0).lpNorm<1>() * mean.row(1).lpNorm<1>();
    if (!(std::abs(mean.determinant()) > least_relative_determinant * rows)) return std::nullopt;
    return mean.inverse();
}

std::optional<double> CurvatureBox::contraction(const Matrix2& y) {
    const int count = shape_.size();
    preconditioned_.resize(2 * count);
    const Values f1(combined_.data(), count), f2(combined_.data() + count, count);
    double errors[2], sizes[2];
    for (int k = 0; k < 2; ++k) {
        Eigen::Map<Eigen::ArrayXd> g(preconditioned_.data() + k * count, count);
        const double y0 = std::abs(y(k, 0)), y1 = std::abs(y(k, 1));
        g = y(k, 0) * f1 + y(k, 1) * f2;
        errors[k] =
            (y0 * (error_[0] + 3 * unit_roundoff * size_[0]) + y1 * (error_[1] + 3 * unit_roundoff * size_[1])) *
            bound_slack;
        const double constant = y(k, 0) * constant_[0] + y(k, 1) * constant_[1];
        const Interval range = coefficient_range(g.data(), count);
        sizes[k] = range.magnitude();
        const Interval values{range.low + constant, range.high + constant};
        const double rest = errors[k] + (y0 * (remainder_[0] + 4 * unit_roundoff * std::abs(constant_[0])) +
                                         y1 * (remainder_[1] + 4 * unit_roundoff * std::abs(constant_[1]))) *
                                            bound_slack;
        if (values.mignitude() > rest) return std::nullopt;
    }
    const auto row_sum = [](int k, const Interval& u, const Interval& v) {
        return k == 0 ? (Interval(1.0) - u).magnitude() + v.magnitude()
                      : u.magnitude() + (Interval(1.0) - v).magnitude();
    };
    std::array<std::array<Interval, 2>, 2> slopes;
    for (int k = 0; k < 2; ++k) {
        const std::array<Interval, 2> d = difference_hulls(shape_, preconditioned_.data() + k * count);
        slopes[k] = {Interval(shape_.p) * d[0], Interval(shape_.q) * d[1]};
        // Nothing contracts already without the remainders: most boxes end here.
        if (!(row_sum(k, slopes[k][0], slopes[k][1]) < 1.0)) return std::numeric_limits<double>::infinity();
    }
    for (int a = t; a < arrays_; ++a)
        if (!slope_[a]) slope_[a] = largest_slope(a);
    double norm = 0.0;
    for (int k = 0; k < 2; ++k) {
        Vector2 slack =
            (slope_error(errors[k]) + 4 * unit_roundoff * sizes[k] * Vector2(shape_.p, shape_.q)) * bound_slack;
        for (int f = 0; f < 2; ++f)
            for (int a = t; a < arrays_; ++a) slack += std::abs(y(k, f)) * slack_[f][a] * *slope_[a];
        slack *= bound_slack;
        const double sum = row_sum(k, inflated(slopes[k][0], slack.x()), inflated(slopes[k][1], slack.y()));
        if (!std::isfinite(sum)) return std::numeric_limits<double>::infinity();
        norm = std::max(norm, sum * bound_slack);
    }
    return norm;
}

void CurvatureBox::evaluate(const Vector2& at, std::array<double, most_arrays>& value,
                            std::array<Vector2, most_arrays>* gradient) {
    point_.move_to(shape_, at);
    for (int k = 0; k < arrays_; ++k) value[k] = point_.value(array(k), gradient ? &(*gradient)[k] : nullptr);
}

std::array<Interval, 2> CurvatureBox::residual(const CurvatureLevel& level, const Matrix2& y, const Vector2& at) {
    std::array<double, most_arrays> value;
    evaluate(at, value, nullptr);
    const double relative = gamma_bound(4 * (shape_.p + shape_.q) + 8);
    std::array<Interval, most_arrays> x;
    for (int k = 0; k < arrays_; ++k) x[k] = inflated(value[k], errors_[k] + relative * magnitude_[k]);
    x[t].low = std::max(x[t].low, 0.0);
    Interval g = square(x[t]), h = x[t] * sqrt(x[t]);
    if (rational_) {
        g = g / square(square(x[w]));
        h = h / x[w];
    }
    const Interval f1 = x[q] - Interval(level.gaussian) * g, f2 = x[s] + Interval(2 * level.mean) * h;
    return {Interval(y(0, 0)) * f1 + Interval(y(0, 1)) * f2, Interval(y(1, 0)) * f1 + Interval(y(1, 1)) * f2};
}

bool CurvatureBox::newton(const CurvatureLevel& level, double reach, Vector2& at) {
    double last = std::numeric_limits<double>::infinity();
    std::array<double, most_arrays> x;
    std::array<Vector2, most_arrays> d;
    for (int step = 0; step < newton_steps; ++step) {
        evaluate(at, x, &d);
        if (!(x[t] > 0.0)) return false;
        const double weight = rational_ ? x[w] : 1.0, root = std::sqrt(x[t]);
        const double g = x[t] * x[t] / std::pow(weight, 4), h = x[t] * root / weight;
        Vector2 g_slope = 2 * g / x[t] * d[t], h_slope = 1.5 * h / x[t] * d[t];
        if (rational_) {
            g_slope -= 4 * g / weight * d[w];
            h_slope -= h / weight * d[w];
        }
        const Vector2 value(x[q] - level.gaussian * g, x[s] + 2 * level.mean * h);
        Matrix2 jacobian;
        jacobian << (d[q] - level.gaussian * g_slope).transpose(), (d[s] + 2 * level.mean * h_slope).transpose();
        if (jacobian.determinant() == 0.0) return false;
        const Vector2 change = jacobian.inverse() * value;
        at -= change;
        if (!((at.array() >= -reach).all() && (at.array() <= 1.0 + reach).all())) return false;
        const double size = change.cwiseAbs().maxCoeff();
        if (size < 4 * unit_roundoff || (step > 2 && size >= last)) return true;
        last = size;
    }
    return true;
}

Vector2 CurvatureBox::variation(const CurvatureLevel& level) const {
    Vector2 result = Vector2::Zero();
    const double room[2] = {level.gaussian_tolerance * g_.high, 2 * level.mean_tolerance * h_.high};
    for (int k = 0; k < 2; ++k) {
        const double unit = level.exact() ? hull_[k].magnitude() : room[k];
        if (!(unit > 0.0)) continue;
        result = result.cwiseMax(mean_variation(shape_, combined_.data() + k * shape_.size()) / unit);
    }
    return result;
}

}  // namespace umbilic
