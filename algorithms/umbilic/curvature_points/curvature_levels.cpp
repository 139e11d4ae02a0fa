// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/curvature_levels.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <umbilic/bernstein/rounding.h>

namespace umbilic {

namespace {

/// Above this contraction a box is split rather than proved, as the radius grows with 1 / (1 - r).
constexpr double largest_contraction = 0.75;
/// A region within tolerances is enclosed in one step at this contraction and half this size, relative to the box: it
/// is then one connected piece of the box, and its enclosure at most a little too large.
constexpr double largest_region_contraction = 0.5;
constexpr double largest_region = 0.5;
/// A part of a box narrower than this is not looked at by itself.
constexpr double least_part = 1e-3;
/// How far outside its box a candidate is still followed, and how much more is added to the enlarged box, relative to
/// the box.
constexpr double reach = 0.4;
constexpr double margin = 1e-3;
/// Boxes between two looks at the progress handle.
constexpr long boxes_per_check = 1024;
/// A direction is not split beyond the limit for the other if its relative variation is below this share of it.
constexpr double least_variation = 0.01;

/// Boxes of this depth and more are searched for regions within tolerances with polynomials of this degree if those are
/// near enough.
constexpr int reduced_degree = 6, first_reduction = 2;

bool inside_unit(const Vector2& at, double radius) {
    return at.minCoeff() - radius >= 0.0 && at.maxCoeff() + radius <= 1.0;
}

double farthest(const std::array<Interval, 2>& residual) {
    return std::max(residual[0].magnitude(), residual[1].magnitude());
}

/// The same point found from two boxes: each box holds exactly one, and both balls.
void add_point(const LevelPoint& point, std::vector<LevelPoint>& points) {
    const auto holds = [](const ParameterBox& box, const LevelPoint& p) {
        const Vector2 low = p.at - p.radius, high = p.at + p.radius;
        return box.contains(low.x(), low.y()) && box.contains(high.x(), high.y());
    };
    for (LevelPoint& other : points)
        if (other.level == point.level && holds(other.box, point) && holds(point.box, other)) {
            if (point.radius.maxCoeff() < other.radius.maxCoeff()) other = point;
            return;
        }
    points.push_back(point);
}

}  // namespace

void CurvatureLevelSearch::set_equations(const CurvatureEquations& equations) {
    const TensorPolynomial* source[] = {&equations.q, &equations.s, &equations.t, &equations.w};
    rational_ = equations.rational;
    arrays_ = rational_ ? 4 : 3;
    shape_ = error_shape_ = {equations.q.u_degree, equations.q.v_degree};
    const std::size_t size = shape_.size();
    root_.resize(arrays_ * size);
    for (int k = 0; k < arrays_; ++k) {
        assert(source[k]->u_degree == shape_.p && source[k]->v_degree == shape_.q);
        root_errors_[k] = source[k]->bernstein_coefficients({root_.data() + k * size, size}).input;
    }
}

void CurvatureLevelSearch::search(std::span<const CurvatureLevel> levels, const LevelLimits& limits,
                                  const Progress& progress, LevelSets& result) {
    const int size = shape_.size();
    const std::size_t stride = static_cast<std::size_t>(arrays_) * size;
    if (slots_.size() < stride) slots_.resize(stride);
    std::copy(root_.begin(), root_.end(), slots_.begin());
    nodes_.assign(1, {0, {{0.0, 1.0}, {0.0, 1.0}}, root_errors_, 0, levels.size()});
    live_.resize(levels.size());
    for (std::size_t k = 0; k < levels.size(); ++k) live_[k] = static_cast<int>(k);
    fine_.assign(levels.size(), 0);
    result.visited += run(levels, limits, limits.boxes, progress, result);
}

long CurvatureLevelSearch::run(std::span<const CurvatureLevel> levels, const LevelLimits& limits, long budget,
                               const Progress& progress, LevelSets& result) {
    const int size = shape_.size();
    const std::size_t stride = static_cast<std::size_t>(arrays_) * size;
    std::vector<int> delegated;
    long visited = 0;
    while (!nodes_.empty()) {
        const std::size_t top = nodes_.size() - 1;
        if (visited >= budget) {
            result.exhausted = true;
            for (const Node& node : nodes_)
                for (std::size_t k = 0; k < node.live; ++k) leave(node, live_[node.first_live + k], result);
            break;
        }
        if (++visited % boxes_per_check == 0) progress.check();
        Node& node = nodes_[top];
        double* slot = slots_.data() + top * stride;
        box_.take(shape_, rational_, slot, node.errors, error_shape_);
        const double u_share = node.box.u.length() / limits.u_size, v_share = node.box.v.length() / limits.v_size;
        const bool fine = u_share <= 1.0 && v_share <= 1.0;
        const auto own = std::span(live_).subspan(node.first_live, node.live);
        const bool reduced =
            std::any_of(own.begin(), own.end(), [&](int k) { return !levels[k].exact(); }) && reduce(node, slot);
        delegated.clear();
        std::size_t live = 0;
        Vector2 variation = Vector2::Zero();
        for (std::size_t k = 0; k < node.live; ++k) {
            const int number = live_[node.first_live + k];
            const CurvatureLevel& level = levels[number];
            Outcome outcome = examine(node, level, number, result);
            if (outcome == Outcome::split && fine && ++fine_[number] > limits.fine_boxes) outcome = Outcome::member;
            if (outcome == Outcome::member) leave(node, number, result);
            if (outcome != Outcome::split) continue;
            if (reduced && !level.exact() && box_.tolerates(level, reduction_errors_)) {
                delegated.push_back(number);
                continue;
            }
            live_[node.first_live + live++] = number;
            // One level decides how to split: near the end there is one.
            if (live == 1) variation = box_.variation(level);
        }
        if (!delegated.empty()) {
            Node start = node;
            start.first_live = 0;
            start.live = delegated.size();
            for (int k = 0; k < arrays_; ++k) start.errors[k] = (start.errors[k] + reduction_errors_[k]) * bound_slack;
            lower_->nodes_.assign(1, start);
            lower_->live_ = delegated;
            lower_->fine_.assign(levels.size(), 0);
            visited += lower_->run(levels, limits, budget - visited, progress, result);
        }
        node.live = live;
        const std::size_t first_live = node.first_live;
        if (live == 0) {
            nodes_.pop_back();
            live_.resize(first_live);
            continue;
        }
        bool along_u = variation.x() >= variation.y();
        const bool u_long = u_share > limits.finest, v_long = v_share > limits.finest;
        bool possible = along_u ? u_long : v_long;
        if (!possible && variation.minCoeff() >= least_variation * variation.maxCoeff()) {
            along_u = !along_u;
            possible = along_u ? u_long : v_long;
        }
        if (!possible) {
            for (std::size_t k = 0; k < live; ++k) leave(node, live_[first_live + k], result);
            nodes_.pop_back();
            live_.resize(first_live);
            continue;
        }
        const int degree = along_u ? shape_.p : shape_.q;
        for (int k = 0; k < arrays_; ++k)
            node.errors[k] = (node.errors[k] + gamma_bound(degree) * box_.magnitudes()[k]) * bound_slack;
        ++node.depth;
        Node first = node;
        if (along_u)
            first.box.u.high = node.box.u.low = node.box.u.middle();
        else
            first.box.v.high = node.box.v.low = node.box.v.middle();
        live_.resize(first_live + live);
        first.first_live = live_.size();
        for (std::size_t k = 0; k < live; ++k) live_.push_back(live_[first_live + k]);
        if (slots_.size() < (top + 2) * stride) slots_.resize((top + 2) * stride);
        for (int k = 0; k < arrays_; ++k) {
            double* c = slots_.data() + top * stride + k * size;
            (along_u ? halve_u : halve_v)(shape_, c, c + stride);
        }
        nodes_.push_back(first);
    }
    return visited;
}

bool CurvatureLevelSearch::reduce(const Node& node, const double* coefficients) {
    const CoefficientShape low{std::min(shape_.p, reduced_degree), std::min(shape_.q, reduced_degree)};
    if (low.size() == shape_.size() || node.depth < first_reduction || node.depth % 2 != 0) return false;
    const bool fits = reduction_ && reduction_->from().p == shape_.p && reduction_->from().q == shape_.q;
    if (!fits) reduction_.emplace(shape_, low);
    if (!lower_) lower_ = std::make_unique<CurvatureLevelSearch>();
    lower_->shape_ = low;
    lower_->error_shape_ = error_shape_;
    lower_->arrays_ = arrays_;
    lower_->rational_ = rational_;
    const std::size_t size = low.size(), needed = arrays_ * size;
    if (lower_->slots_.size() < needed) lower_->slots_.resize(needed);
    for (int k = 0; k < arrays_; ++k)
        reduction_errors_[k] = reduction_->reduce(coefficients + k * shape_.size(), lower_->slots_.data() + k * size);
    return true;
}

void CurvatureLevelSearch::leave(const Node& node, int number, LevelSets& result) const {
    result.boxes.push_back({number, {node.box, {}}, std::numeric_limits<double>::infinity()});
}

CurvatureLevelSearch::Outcome CurvatureLevelSearch::examine(const Node& node, const CurvatureLevel& level, int number,
                                                            LevelSets& result) {
    if (!box_.linearise(level)) return Outcome::empty;
    if (!level.exact()) return examine_region(node, level, number, result);
    if (box_.vanishes()) return Outcome::member;
    const std::optional<Matrix2> preconditioner = box_.preconditioner();
    if (!preconditioner) return Outcome::split;
    const std::optional<double> contraction = box_.contraction(*preconditioner);
    if (!contraction) return Outcome::empty;
    if (!(*contraction < largest_contraction)) return Outcome::split;
    return isolate(node, level, number, *preconditioner, *contraction, result);
}

CurvatureLevelSearch::Outcome CurvatureLevelSearch::examine_region(const Node& node, const CurvatureLevel& level,
                                                                   int number, LevelSets& result) {
    if (box_.within(level)) {
        result.boxes.push_back({number, {node.box, {}}, box_.misfit(level)});
        return Outcome::empty;
    }
    if (const auto bands = box_.bands(level)) {
        std::optional<BoxPart> part = part_within(node.box, *bands);
        if (part) result.boxes.push_back({number, std::move(*part), box_.misfit(level)});
        return Outcome::empty;
    }
    const std::optional<Matrix2> preconditioner = box_.preconditioner();
    if (!preconditioner) return Outcome::split;
    const Vector2 allowed = box_.allowance(level, *preconditioner);
    if (!(allowed.maxCoeff() < largest_region)) return Outcome::split;
    const std::optional<double> r = box_.contraction(*preconditioner);
    if (!r) return Outcome::empty;
    if (!(*r < largest_region_contraction)) return Outcome::split;
    // With g = Y f and ||I - g'|| <= r, all x of the region in the box lie about c - g(c), c any point of the box:
    // x - (c - g(c)) = g(x) - (g(x) - g(c) - (x - c)), and |x - c| <= (|g(x)| + |g(c)|) / (1 - r).
    Vector2 c(0.5, 0.5);
    const bool converged = box_.newton(level, reach, c);
    const bool holds_solution = converged && c.minCoeff() >= 0.0 && c.maxCoeff() <= 1.0;
    c = converged ? Vector2(c.cwiseMax(0.0).cwiseMin(1.0)) : Vector2(0.5, 0.5);
    const std::array<Interval, 2> value = box_.residual(level, *preconditioner, c);
    const double rest = *r * (allowed.maxCoeff() + farthest(value)) / (1.0 - *r);
    const Vector2 middle = c - Vector2(value[0].middle(), value[1].middle());
    Vector2 half;
    for (int k = 0; k < 2; ++k) half[k] = allowed[k] + rest + 0.5 * (value[k].high - value[k].low);
    if (half.maxCoeff() > largest_region) return Outcome::split;
    const Vector2 low = (middle - half).cwiseMax(0.0), high = (middle + half).cwiseMin(1.0);
    if ((low.array() > high.array()).any()) return Outcome::empty;
    if (!holds_solution) {
        // The middle of the region is not here: its enclosure may stretch into this box and the region not.
        const std::optional<bool> rest_within = restricted_within(level, node, low, high);
        if (!rest_within) return Outcome::empty;
        if (!*rest_within) return Outcome::split;
    }
    const Vector2 side(node.box.u.length(), node.box.v.length()), corner(node.box.u.low, node.box.v.low);
    const Vector2 from = corner + side.cwiseProduct(low), to = corner + side.cwiseProduct(high);
    const BoxPart part{{{from.x(), to.x()}, {from.y(), to.y()}}, {}};
    result.boxes.push_back({number, part, holds_solution ? 0.0 : 1.0});
    return Outcome::empty;
}

void CurvatureLevelSearch::take_other(const Node& node, const Vector2& low, const Vector2& high) {
    const int size = shape_.size();
    const double* own = slots_.data() + (nodes_.size() - 1) * static_cast<std::size_t>(arrays_) * size;
    other_.assign(own, own + arrays_ * size);
    std::array<double, CurvatureBox::most_arrays> errors = node.errors;
    for (int k = 0; k < arrays_; ++k) {
        double* c = other_.data() + k * size;
        const double factor = restrict_u(shape_, c, low.x(), high.x()) * restrict_v(shape_, c, low.y(), high.y());
        errors[k] = factor * (errors[k] + gamma_bound(8 * (shape_.p + shape_.q)) * box_.magnitudes()[k]) * bound_slack;
    }
    other_box_.take(shape_, rational_, other_.data(), errors, error_shape_);
}

std::optional<bool> CurvatureLevelSearch::restricted_within(const CurvatureLevel& level, const Node& node,
                                                            const Vector2& low, const Vector2& high) {
    // restrict_u() needs an interval with a length that is not far from one end relative to it.
    if (!((high - low).minCoeff() > least_part)) return false;
    take_other(node, low, high);
    if (!other_box_.linearise(level)) return std::nullopt;
    return other_box_.within(level);
}

CurvatureLevelSearch::Outcome CurvatureLevelSearch::isolate(const Node& node, const CurvatureLevel& level, int number,
                                                            const Matrix2& preconditioner, double r,
                                                            LevelSets& result) {
    const Vector2 middle(0.5, 0.5);
    const std::array<Interval, 2> centre = box_.residual(level, preconditioner, middle);
    for (const Interval& component : centre)
        if (component.mignitude() > 0.5 * (1.0 + r) * bound_slack) return Outcome::empty;
    Vector2 at = middle - Vector2(centre[0].middle(), centre[1].middle());
    at = at.cwiseMax(-reach).cwiseMin(1.0 + reach);
    if (!box_.newton(level, reach, at)) return Outcome::split;

    const Vector2 side(node.box.u.length(), node.box.v.length()), corner(node.box.u.low, node.box.v.low);
    const auto accept = [&](const Vector2& low, const Vector2& high, double radius) {
        const Vector2 scale = side.cwiseProduct(high - low);
        LevelPoint point{number};
        point.at = corner + side.cwiseProduct(low) + scale.cwiseProduct(at);
        // Rounding of the box's ends and of the change of parameters.
        point.radius = radius * scale + Vector2::Constant(16 * unit_roundoff);
        const Vector2 from = corner + side.cwiseProduct(low), to = corner + side.cwiseProduct(high);
        point.box = {{from.x(), to.x()}, {from.y(), to.y()}};
        add_point(point, result.points);
        return Outcome::point;
    };
    if (at.minCoeff() > 0.0 && at.maxCoeff() < 1.0) {
        const double radius = farthest(box_.residual(level, preconditioner, at)) / (1.0 - r) * bound_slack;
        if (inside_unit(at, radius)) return accept(Vector2::Zero(), Vector2::Ones(), radius);
        if (radius > reach) return Outcome::split;
    }

    // On the edge or outside: prove on a box that holds both this one and the candidate.
    Vector2 low = Vector2::Zero(), high = Vector2::Ones();
    for (int k = 0; k < 2; ++k) {
        if (at[k] < margin) low[k] = std::min(at[k], 0.0) - margin;
        if (at[k] > 1.0 - margin) high[k] = std::max(at[k], 1.0) + margin;
    }
    take_other(node, low, high);
    if (!other_box_.linearise(level)) return Outcome::empty;
    const Vector2 scale = high - low;
    const Matrix2 scaled = scale.cwiseInverse().asDiagonal() * preconditioner;
    const std::optional<double> norm = other_box_.contraction(scaled);
    if (!norm) return Outcome::empty;
    if (!(*norm < largest_contraction)) return Outcome::split;
    at = (at - low).cwiseQuotient(scale);
    const double radius = farthest(other_box_.residual(level, scaled, at)) / (1.0 - *norm) * bound_slack;
    if (!inside_unit(at, radius)) return Outcome::split;
    const Vector2 own_low = -low.cwiseQuotient(scale), own_high = (Vector2::Ones() - low).cwiseQuotient(scale);
    const double reaching = radius + 16 * unit_roundoff;
    if ((at.array() + reaching < own_low.array()).any() || (at.array() - reaching > own_high.array()).any())
        return Outcome::empty;
    return accept(low, high, radius);
}

}  // namespace umbilic
