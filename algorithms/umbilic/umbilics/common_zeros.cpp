// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/common_zeros.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include <umbilic/bernstein/coefficient_errors.h>
#include <umbilic/bernstein/rounding.h>

namespace umbilic {

namespace {

using Array = Eigen::Map<const Eigen::ArrayXd>;

/// A preconditioner is used down to this relative determinant: near |omega| = 1 it still helps greatly.
constexpr double least_relative_determinant = 1e-9;
/// Above this contraction a box is split rather than proved, as the radius grows with 1 / (1 - r).
constexpr double largest_contraction = 0.75;
/// How far outside its box a candidate is still followed, and how much more is added to the enlarged box, relative to
/// the box.
constexpr double reach = 0.4;
constexpr double margin = 1e-3;
constexpr int newton_steps = 12;
/// Directions beside the mean one in which exclusion is tried before a box is split.
constexpr int hull_steps = 2;
/// Newton steps in precise arithmetic: from a radius of 10^-6 of the domain two reach rounding.
constexpr int precise_steps = 4;
/// A direction is not split beyond the limit for the other if its relative variation is below this share of it.
constexpr double least_variation = 0.01;
/// Boxes between two looks at the progress handle.
constexpr long boxes_per_check = 4096;

bool inside_unit(const Vector2& at, double radius) {
    return at.minCoeff() - radius >= 0.0 && at.maxCoeff() + radius <= 1.0;
}

ParameterBox placed(const ParameterBox& box, const Vector2& low, const Vector2& high) {
    return {{box.u.low + low.x() * box.u.length(), box.u.low + high.x() * box.u.length()},
            {box.v.low + low.y() * box.v.length(), box.v.low + high.y() * box.v.length()}};
}

void grow(CoefficientBound& bound, double factor, double arithmetic) {
    bound.rounding = (bound.rounding * factor + arithmetic) * bound_slack;
    bound.input = (bound.input * factor + arithmetic) * bound_slack;
}

}  // namespace

void CommonZeros::clear() {
    isolated.clear();
    open.clear();
    boxes = 0;
    exhausted = false;
}

void CommonZeroSearch::set_polynomials(const TensorPolynomial& a, const TensorPolynomial& b, Enclosure enclosure,
                                       Enclosure precise) {
    assert(a.u_degree == b.u_degree && a.v_degree == b.v_degree);
    shape_ = {a.u_degree, a.v_degree};
    enclosure_ = std::move(enclosure);
    precise_ = std::move(precise);
    arrays_ = a.errors.empty() || b.errors.empty() ? 2 : 4;
    const int size = shape_.size();
    root_.resize(arrays_ * size);
    const TensorPolynomial* source[2] = {&a, &b};
    CoefficientBound* bound[2] = {&root_bounds_.a, &root_bounds_.b};
    for (int k = 0; k < 2; ++k) {
        double* c = root_.data() + k * size;
        *bound[k] = source[k]->bernstein_coefficients({c, static_cast<std::size_t>(size)});
        const double largest = Array(c, size).abs().maxCoeff();
        const double scale = largest > 0.0 ? std::ldexp(1.0, -std::ilogb(largest)) : 1.0;
        scale_[k] = scale;
        for (int at = 0; at < size; ++at) c[at] *= scale;
        bound[k]->rounding *= scale;
        bound[k]->input *= scale;
        if (arrays_ == 2) continue;
        double* errors = root_.data() + (k + 2) * size;
        source[k]->bernstein_errors({errors, static_cast<std::size_t>(size)});
        for (int at = 0; at < size; ++at) errors[at] *= scale;
    }
    root_bounds_ = with_local_errors(root_.data(), root_bounds_);
    combined_.resize(2 * size);
    enlarged_.resize(2 * size);
}

CommonZeroSearch::Bounds CommonZeroSearch::with_local_errors(const double* coefficients, Bounds bounds) const {
    if (arrays_ == 2) return bounds;
    const int size = shape_.size();
    const double a = Array(coefficients + 2 * size, size).maxCoeff();
    const double b = Array(coefficients + 3 * size, size).maxCoeff();
    return {{a, a}, {b, b}};
}

CommonZeroSearch::Bounds CommonZeroSearch::load(const ParameterBox& part) {
    const int size = shape_.size();
    if (slots_.size() < root_.size()) slots_.resize(root_.size());
    std::copy(root_.begin(), root_.end(), slots_.begin());
    Bounds bounds = root_bounds_;
    if (part.u.low > 0.0 || part.u.high < 1.0 || part.v.low > 0.0 || part.v.high < 1.0) {
        for (int k = 0; k < 2; ++k) {
            double* c = slots_.data() + k * size;
            const double arithmetic = gamma_bound(8 * (shape_.p + shape_.q)) * Array(c, size).abs().maxCoeff();
            restrict_u(shape_, c, part.u.low, part.u.high);
            restrict_v(shape_, c, part.v.low, part.v.high);
            grow(k == 0 ? bounds.a : bounds.b, 1.0, arithmetic);
        }
        for (int k = 0; arrays_ == 4 && k < 2; ++k)
            restrict_errors(shape_, root_.data() + k * size, slots_.data() + k * size, part,
                            slots_.data() + (k + 2) * size);
    }
    return with_local_errors(slots_.data(), bounds);
}

double CommonZeroSearch::largest_error(const ParameterBox& part) {
    const Bounds bounds = load(part);
    return std::max(bounds.a.input, bounds.b.input);
}

void CommonZeroSearch::search(const ParameterBox& part, const SearchLimits& limits, const Progress& progress,
                              CommonZeros& result) {
    const int size = shape_.size();
    const std::size_t stride = static_cast<std::size_t>(arrays_) * size;
    const auto slot = [&](std::size_t k) { return slots_.data() + k * stride; };
    wanted_radius_ = Vector2(limits.u_radius, limits.v_radius);
    nodes_.assign(1, {part, load(part)});

    long visited = 0;
    while (!nodes_.empty()) {
        if (visited == limits.boxes) {
            result.exhausted = true;
            for (const Node& node : nodes_) result.open.push_back({node.box, false, 0.0, node.box});
            break;
        }
        if (++visited % boxes_per_check == 0) progress.check();
        const std::size_t top = nodes_.size() - 1;
        const Outcome outcome = examine(nodes_[top], slot(top), result);
        if (outcome == Outcome::zero) result.open.push_back({nodes_[top].box, true, 1.0, nodes_[top].box});
        if (outcome != Outcome::split) {
            nodes_.pop_back();
            continue;
        }
        const ParameterBox box = nodes_[top].box;
        bool along_u = u_variation_ >= v_variation_;
        const bool u_long = box.u.length() > limits.u_size, v_long = box.v.length() > limits.v_size;
        const double lesser = std::min(u_variation_, v_variation_), greater = std::max(u_variation_, v_variation_);
        bool possible = along_u ? u_long : v_long;
        if (!possible && lesser >= least_variation * greater) {
            along_u = !along_u;
            possible = along_u ? u_long : v_long;
        }
        if (!possible) {
            const Bounds& bounds = nodes_[top].bounds;
            const double doubt = std::max(bounds.a.input / magnitude_[0], bounds.b.input / magnitude_[1]);
            result.open.push_back({box, false, doubt, box});
            nodes_.pop_back();
            continue;
        }
        if (slots_.size() < (top + 2) * stride) slots_.resize((top + 2) * stride);
        Node& second = nodes_[top];
        const int degree = along_u ? shape_.p : shape_.q;
        grow(second.bounds.a, 1.0, gamma_bound(degree) * magnitude_[0]);
        grow(second.bounds.b, 1.0, gamma_bound(degree) * magnitude_[1]);
        Node first = second;
        if (along_u)
            first.box.u.high = second.box.u.low = box.u.middle();
        else
            first.box.v.high = second.box.v.low = box.v.middle();
        for (int k = 0; arrays_ == 4 && k < 2; ++k)
            halve_errors(shape_, along_u, slot(top) + k * size, slot(top) + (k + 2) * size,
                         slot(top + 1) + (k + 2) * size);
        for (int k = 0; k < 2; ++k)
            (along_u ? halve_u : halve_v)(shape_, slot(top) + k * size, slot(top + 1) + k * size);
        second.bounds = with_local_errors(slot(top), second.bounds);
        first.bounds = with_local_errors(slot(top + 1), first.bounds);
        nodes_.push_back(first);
    }
    result.boxes += visited;
}

std::optional<int> CommonZeroSearch::count(const ParameterBox& part, CommonZeros& result) {
    const Node node{part, load(part)};
    ++result.boxes;
    switch (examine(node, slots_.data(), result)) {
        case Outcome::empty:
            return 0;
        case Outcome::isolated:
            return 1;
        default:
            return std::nullopt;
    }
}

CommonZeroSearch::Outcome CommonZeroSearch::examine(const Node& node, const double* coefficients, CommonZeros& result) {
    const int size = shape_.size();
    const double* polynomial[2] = {coefficients, coefficients + size};
    const CoefficientBound bound[2] = {node.bounds.a, node.bounds.b};
    bool vanishes[2], excluded = false;
    for (int k = 0; k < 2; ++k) {
        const Interval values = coefficient_range(polynomial[k], size);
        magnitude_[k] = values.magnitude();
        vanishes[k] = magnitude_[k] <= zero_factor * bound[k].input;
        excluded = excluded || (!vanishes[k] && values.mignitude() > bound[k].input);
    }
    if (vanishes[0] && vanishes[1]) return Outcome::zero;
    if (excluded) return Outcome::empty;

    // Towards the mean of all coefficient pairs.
    const Vector2 mean(Array(polynomial[0], size).mean(), Array(polynomial[1], size).mean());
    if (combination_excludes(node, coefficients, mean)) return Outcome::empty;

    Matrix2 derivative;
    for (int k = 0; k < 2; ++k) derivative.row(k) = mean_derivative(shape_, polynomial[k]).transpose();
    const double determinant = derivative.determinant();
    const double row_product = derivative.row(0).lpNorm<1>() * derivative.row(1).lpNorm<1>();
    if (std::abs(determinant) > least_relative_determinant * row_product && !vanishes[0] && !vanishes[1]) {
        const Matrix2 preconditioner = derivative.inverse();
        const std::optional<double> r = contraction(coefficients, node.bounds, preconditioner);
        if (!r) return Outcome::empty;
        if (*r < largest_contraction) {
            const Outcome outcome = isolate(node, coefficients, preconditioner, *r, result);
            if (outcome != Outcome::split) return outcome;
        }
    }

    if (!vanishes[0] && !vanishes[1] && excluded_beside(node, coefficients, mean)) return Outcome::empty;

    u_variation_ = v_variation_ = 0.0;
    for (int k = 0; k < 2; ++k) {
        if (vanishes[k]) continue;
        const Vector2 variation = mean_variation(shape_, polynomial[k]) / magnitude_[k];
        u_variation_ = std::max(u_variation_, variation.x());
        v_variation_ = std::max(v_variation_, variation.y());
    }
    return Outcome::split;
}

bool CommonZeroSearch::combination_excludes(const Node& node, const double* coefficients,
                                            const Vector2& weights) const {
    const int size = shape_.size();
    const double error = (std::abs(weights.x()) * (node.bounds.a.input + 3 * unit_roundoff * magnitude_[0]) +
                          std::abs(weights.y()) * (node.bounds.b.input + 3 * unit_roundoff * magnitude_[1])) *
                         bound_slack;
    return (weights.x() * Array(coefficients, size) + weights.y() * Array(coefficients + size, size)).minCoeff() >
           error;
}

bool CommonZeroSearch::excluded_beside(const Node& node, const double* coefficients, const Vector2& mean) {
    const int size = shape_.size();
    const Array a(coefficients, size), b(coefficients + size, size);
    // Pairs brought to one size.
    const Vector2 scale(1.0 / magnitude_[0], 1.0 / magnitude_[1]);
    Vector2 nearest = mean.cwiseProduct(scale);
    Eigen::Map<Eigen::ArrayXd> heights(combined_.data(), size);
    for (int step = 0; step < hull_steps; ++step) {
        const Vector2 weights = nearest.cwiseProduct(scale);
        heights = weights.x() * a + weights.y() * b;
        const double least = heights.minCoeff();
        if (step == 0 && least < -nearest.squaredNorm()) return false;
        const auto lowest = std::find(heights.data(), heights.data() + size - 1, least) - heights.data();
        const Vector2 towards = Vector2(a[lowest], b[lowest]).cwiseProduct(scale) - nearest;
        nearest += std::clamp(-nearest.dot(towards) / towards.squaredNorm(), 0.0, 1.0) * towards;
        if (combination_excludes(node, coefficients, nearest.cwiseProduct(scale))) return true;
    }
    return false;
}

std::optional<double> CommonZeroSearch::contraction(const double* coefficients, const Bounds& bounds,
                                                    const Matrix2& y) {
    const int size = shape_.size();
    const Array a(coefficients, size), b(coefficients + size, size);
    const double a_size = coefficient_range(coefficients, size).magnitude();
    const double b_size = coefficient_range(coefficients + size, size).magnitude();
    double errors[2], sizes[2];
    for (int k = 0; k < 2; ++k) {
        Eigen::Map<Eigen::ArrayXd> g(combined_.data() + k * size, size);
        g = y(k, 0) * a + y(k, 1) * b;
        errors[k] = (std::abs(y(k, 0)) * (bounds.a.input + 3 * unit_roundoff * a_size) +
                     std::abs(y(k, 1)) * (bounds.b.input + 3 * unit_roundoff * b_size)) *
                    bound_slack;
        const Interval values = coefficient_range(g.data(), size);
        sizes[k] = values.magnitude();
        if (values.mignitude() > errors[k]) return std::nullopt;
    }
    double norm = 0.0;
    for (int k = 0; k < 2; ++k) {
        const double* g = combined_.data() + k * size;
        const double difference_error = (2 * errors[k] + 4 * unit_roundoff * sizes[k]) * bound_slack;
        const std::array<Interval, 2> d = difference_hulls(shape_, g);
        const Interval u = Interval(shape_.p) * inflated(d[0], difference_error);
        const Interval v = Interval(shape_.q) * inflated(d[1], difference_error);
        const double sum =
            k == 0 ? (Interval(1.0) - u).magnitude() + v.magnitude() : u.magnitude() + (Interval(1.0) - v).magnitude();
        norm = std::max(norm, sum * bound_slack);
    }
    return norm;
}

void CommonZeroSearch::evaluate(const double* coefficients, const Vector2& at, Vector2& value, Matrix2* jacobian) {
    point_.move_to(shape_, at);
    for (int k = 0; k < 2; ++k) {
        Vector2 gradient;
        value[k] = point_.value(coefficients + k * shape_.size(), jacobian ? &gradient : nullptr);
        if (jacobian) jacobian->row(k) = gradient.transpose();
    }
}

bool CommonZeroSearch::newton(const double* coefficients, Vector2& at) {
    Vector2 value;
    Matrix2 jacobian;
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < newton_steps; ++step) {
        evaluate(coefficients, at, value, &jacobian);
        const double determinant = jacobian.determinant();
        if (determinant == 0.0) return false;
        const Vector2 change = jacobian.inverse() * value;
        at -= change;
        if ((at.array() < -reach).any() || (at.array() > 1.0 + reach).any()) return false;
        const double size = change.cwiseAbs().maxCoeff();
        if (size < 4 * unit_roundoff || (step > 2 && size >= last)) return true;
        last = size;
    }
    return true;
}

CommonZeroSearch::Residual CommonZeroSearch::residual(const double* coefficients, const Bounds& bounds,
                                                      const Matrix2& y, const Vector2& at) {
    Residual result;
    Vector2 value;
    evaluate(coefficients, at, value, nullptr);
    result.value = y * value;
    const double relative = gamma_bound(4 * (shape_.p + shape_.q) + 8);
    const double a = relative * Array(coefficients, shape_.size()).abs().maxCoeff();
    const double b = relative * Array(coefficients + shape_.size(), shape_.size()).abs().maxCoeff();
    for (int k = 0; k < 2; ++k) {
        const double ya = std::abs(y(k, 0)) * bound_slack, yb = std::abs(y(k, 1)) * bound_slack;
        result.rounding[k] = (ya * (bounds.a.rounding + a) + yb * (bounds.b.rounding + b)) * bound_slack;
        result.input[k] = (ya * (bounds.a.input + a) + yb * (bounds.b.input + b)) * bound_slack;
    }
    return result;
}

CommonZeroSearch::Outcome CommonZeroSearch::isolate(const Node& node, const double* coefficients,
                                                    const Matrix2& preconditioner, double r, CommonZeros& result) {
    const int size = shape_.size();
    const Residual centre = residual(coefficients, node.bounds, preconditioner, Vector2(0.5, 0.5));
    for (int k = 0; k < 2; ++k)
        if (std::abs(centre.value[k]) - centre.input[k] > 0.5 * (1.0 + r) * bound_slack) return Outcome::empty;

    Vector2 at = Vector2(0.5, 0.5) - centre.value;
    at = at.cwiseMax(-reach).cwiseMin(1.0 + reach);
    if (!newton(coefficients, at)) return Outcome::split;

    // Distance of the zero from x if ||I - g'|| <= r on a convex set that holds the ball of that radius around x.
    const auto radius = [](const Residual& at_candidate, const double* error, double norm) {
        const double largest =
            std::max(std::abs(at_candidate.value[0]) + error[0], std::abs(at_candidate.value[1]) + error[1]);
        return largest / (1.0 - norm) * bound_slack;
    };
    IsolatedZero zero;
    zero.sign = preconditioner.determinant() > 0.0 ? 1 : -1;
    const Vector2 side(node.box.u.length(), node.box.v.length());
    const Vector2 corner(node.box.u.low, node.box.v.low);
    // Rounding of the box's ends and of the change of parameters.
    const Vector2 placing = Vector2::Constant(16 * unit_roundoff);
    const auto accept = [&](const Vector2& low, const Vector2& high, const Matrix2& y, double norm, double exact,
                            double rounded) {
        const Vector2 scale = side.cwiseProduct(high - low);
        zero.at = corner + side.cwiseProduct(low) + scale.cwiseProduct(at);
        zero.radius = exact * scale + placing;
        if (enclosure_) {
            const std::array<Interval, 2> value = enclosure_(zero.at);
            const Interval a = value[0] * scale_[0], b = value[1] * scale_[1];
            const double largest = std::max((Interval(y(0, 0)) * a + Interval(y(0, 1)) * b).magnitude(),
                                            (Interval(y(1, 0)) * a + Interval(y(1, 1)) * b).magnitude());
            zero.radius = zero.radius.cwiseMin(largest / (1.0 - norm) * bound_slack * scale);
        }
        zero.input_radius = rounded * scale + placing;
        zero.box = placed(node.box, low, high);
        if (precise_ && (zero.radius.array() > wanted_radius_.array()).any()) sharpen(y, norm, scale, zero.box, zero);
        add_zero(zero, result);
        return Outcome::isolated;
    };

    if (at.minCoeff() > 0.0 && at.maxCoeff() < 1.0) {
        const Residual there = residual(coefficients, node.bounds, preconditioner, at);
        const double rounded = radius(there, there.input, r);
        if (inside_unit(at, rounded))
            return accept(Vector2::Zero(), Vector2::Ones(), preconditioner, r, radius(there, there.rounding, r),
                          rounded);
        if (rounded > reach) return Outcome::split;
    }

    // On the edge or outside: prove on a box that holds both this one and the candidate.
    Vector2 low = Vector2::Zero(), high = Vector2::Ones();
    for (int k = 0; k < 2; ++k) {
        if (at[k] < margin) low[k] = std::min(at[k], 0.0) - margin;
        if (at[k] > 1.0 - margin) high[k] = std::max(at[k], 1.0) + margin;
    }
    std::copy(coefficients, coefficients + 2 * size, enlarged_.data());
    Bounds bounds = node.bounds;
    for (int k = 0; k < 2; ++k) {
        double* c = enlarged_.data() + k * size;
        const double largest = Array(c, size).abs().maxCoeff();
        const double factor = restrict_u(shape_, c, low.x(), high.x()) * restrict_v(shape_, c, low.y(), high.y());
        grow(k == 0 ? bounds.a : bounds.b, factor, gamma_bound(8 * (shape_.p + shape_.q)) * factor * largest);
    }
    const Vector2 scale = high - low;
    const Matrix2 scaled = scale.cwiseInverse().asDiagonal() * preconditioner;
    const std::optional<double> norm = contraction(enlarged_.data(), bounds, scaled);
    if (!norm) return Outcome::empty;
    if (*norm >= largest_contraction) return Outcome::split;
    at = (at - low).cwiseQuotient(scale);
    const Residual there = residual(enlarged_.data(), bounds, scaled, at);
    const double rounded = radius(there, there.input, *norm);
    if (!inside_unit(at, rounded)) return Outcome::split;
    const Vector2 outside_low = -low.cwiseQuotient(scale), outside_high = (Vector2::Ones() - low).cwiseQuotient(scale);
    const double reaching = rounded + 16 * unit_roundoff;
    if ((at.array() + reaching < outside_low.array()).any() || (at.array() - reaching > outside_high.array()).any())
        return Outcome::empty;
    return accept(low, high, scaled, *norm, radius(there, there.rounding, *norm), rounded);
}

void CommonZeroSearch::sharpen(const Matrix2& preconditioner, double norm, const Vector2& scale,
                               const ParameterBox& box, IsolatedZero& zero) const {
    // Rounding of the place within the precise enclosure.
    const Vector2 placing = Vector2::Constant(2 * unit_roundoff);
    Vector2 at = zero.at;
    for (int step = 0; step < precise_steps; ++step) {
        const std::array<Interval, 2> value = precise_(at);
        const Interval a = value[0] * scale_[0], b = value[1] * scale_[1];
        const Interval x = Interval(preconditioner(0, 0)) * a + Interval(preconditioner(0, 1)) * b;
        const Interval y = Interval(preconditioner(1, 0)) * a + Interval(preconditioner(1, 1)) * b;
        const Vector2 radius = std::max(x.magnitude(), y.magnitude()) / (1.0 - norm) * bound_slack * scale + placing;
        const Vector2 low = at - radius, high = at + radius;
        if (!box.contains(low.x(), low.y()) || !box.contains(high.x(), high.y())) return;
        if ((radius.array() < zero.radius.array()).all()) {
            zero.at = at;
            zero.radius = radius;
        } else if (step > 0) {
            return;
        }
        at -= scale.cwiseProduct(Vector2(x.middle(), y.middle()));
    }
}

void CommonZeroSearch::add_zero(const IsolatedZero& zero, CommonZeros& result) {
    const auto holds = [](const ParameterBox& box, const IsolatedZero& z) {
        const Vector2 low = z.at - z.radius, high = z.at + z.radius;
        return box.contains(low.x(), low.y()) && box.contains(high.x(), high.y());
    };
    for (IsolatedZero& other : result.isolated)
        if (holds(other.box, zero) && holds(zero.box, other)) {
            // Each box holds exactly one zero, and both balls: the same one.
            if (zero.radius.maxCoeff() < other.radius.maxCoeff()) other = zero;
            return;
        }
    result.isolated.push_back(zero);
}

}  // namespace umbilic
