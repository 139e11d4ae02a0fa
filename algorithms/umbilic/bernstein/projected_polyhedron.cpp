// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/projected_polyhedron.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

#include <Eigen/QR>

#include <umbilic/bernstein/box_clusters.h>
#include <umbilic/bernstein/polynomial_system.h>
#include <umbilic/bernstein/rounding.h>
#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

using Box = std::vector<Interval>;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// A box is examined again without a split if projection leaves at most this share of a side.
constexpr double good_shrink = 0.8;
/// Where a side is split: off the middle and off every simple fraction, as solutions of symmetric systems lie there.
constexpr double split_at = 0.4871;
/// A direction in which every polynomial varies less than this share of the greatest variation is not split.
constexpr double least_variation = 0.01;
/// Above this contraction a box is split rather than proved, as the radius grows with 1 / (1 - r).
constexpr double largest_contraction = 0.75;
/// How far outside its box, relative to it, a candidate is followed, and by how much the box of a proof exceeds it.
constexpr double reach = 0.4;
constexpr double margin = 1.0 / 64;
/// Clusters up to this multiple of the tolerance are tried as a whole, with up to this multiple of their size around.
constexpr double largest_inflation = 128.0;
constexpr int newton_steps = 20;
constexpr long boxes_per_report = 256;

double width(const Interval& side) {
    return side.high - side.low;
}

double largest_side(const Box& box) {
    double result = 0.0;
    for (const Interval& side : box) result = std::max(result, width(side));
    return result;
}

double volume(const Box& box) {
    double result = 1.0;
    for (const Interval& side : box) result *= width(side);
    return result;
}

/// Determinant by expansion; the order is the number of unknowns.
Interval determinant(const Matrix& m) {
    if (m.rows() == 1) return m(0, 0);
    Interval result;
    for (int k = 0; k < m.rows(); ++k) {
        Matrix minor(m.rows() - 1, m.rows() - 1);
        for (int i = 1; i < m.rows(); ++i)
            for (int j = 0; j < m.rows(); ++j)
                if (j != k) minor(i - 1, j < k ? j : j - 1) = m(i, j);
        const Interval term = Interval(m(0, k)) * determinant(minor);
        result = k % 2 == 0 ? result + term : result - term;
    }
    return result;
}

class Search {
public:
    Search(std::span<const MultivariatePolynomial> system, const ProjectedPolyhedronOptions& options);
    SystemRoots run(const Progress& progress);

private:
    /// `split`: nothing could be told of the box as a whole; `shrunk`: it has become notably smaller.
    enum class Outcome { empty, root, undecided, zero, shrunk, split };

    /// The system on a box, and its combinations whose mean derivative is the identity.
    struct Linearised {
        CoefficientArrays arrays, combinations;
        Matrix inverse;
        Vector contraction;  ///< row sums of |I - g'|
    };

    Outcome examine(Box& box);
    /// Forms the combinations; false if the mean derivative is rank deficient.
    bool linearise(Linearised& part) const;
    bool newton(const Linearised& part, Vector& at);
    /// Follows a contraction to its candidate and proves that the box holds it or nothing; `split` if that fails.
    Outcome prove(const Box& box);
    /// The same on a box that holds `wanted`, for the solutions in `wanted`; `at` is a start in the larger one.
    Outcome prove_on_larger(const Box& box, const Box& wanted, Vector at);
    Outcome prove_candidate(const Box& box, const Box& wanted, const Linearised& part, const Vector& at);
    void add_root(SystemRoot root);
    /// Joins undecided boxes to clusters and tries once more to prove small ones as a whole.
    void cluster_undecided();

    PolynomialSystem system_;
    ProjectedPolyhedronOptions options_;
    int n_ = 0, l_ = 0;
    Linearised here_, larger_;
    Vector variation_;
    SystemRoots result_;
};

Search::Search(std::span<const MultivariatePolynomial> system, const ProjectedPolyhedronOptions& options)
    : system_(system), options_(options), n_(system_.polynomials()), l_(system_.unknowns()) {
    if (!(options.tolerance >= 1e-14 && options.tolerance <= 1.0))
        throw InvalidInput("polynomial system: the tolerance must lie between 1e-14 and 1");
    if (options.boxes < 1) throw InvalidInput("polynomial system: at least one box must be allowed");
}

SystemRoots Search::run(const Progress& progress) {
    // First in, first out: if the budget ends, what is left is of about one size.
    std::deque<Box> open = {Box(l_, Interval(0.0, 1.0))};
    double decided = 0.0;
    ProjectedPolyhedronStatistics& statistics = result_.statistics;
    while (!open.empty()) {
        Box box = std::move(open.front());
        open.pop_front();
        decided += volume(box);
        Outcome outcome = Outcome::shrunk;
        while (outcome == Outcome::shrunk) {
            if (statistics.boxes == options_.boxes) {
                statistics.exhausted = true;
                outcome = Outcome::undecided;
                break;
            }
            if (++statistics.boxes % boxes_per_report == 0)
                progress.report(std::clamp(decided, 0.0, 1.0), "polynomial system");
            outcome = examine(box);
        }
        if (outcome == Outcome::split) {
            int along = -1;
            for (int j = 0; j < l_; ++j)
                if (width(box[j]) > options_.tolerance && (along < 0 || variation_[j] > variation_[along])) along = j;
            if (along >= 0 && variation_[along] > least_variation * variation_.maxCoeff()) {
                ++statistics.splits;
                decided -= volume(box);
                Box second = box;
                box[along].high = second[along].low = box[along].low + split_at * width(box[along]);
                open.push_back(std::move(box));
                open.push_back(std::move(second));
                continue;
            }
            outcome = Outcome::undecided;
        }
        if (outcome == Outcome::undecided || outcome == Outcome::zero)
            result_.undecided.push_back({std::move(box), 0, outcome == Outcome::zero});
    }
    cluster_undecided();
    std::sort(result_.roots.begin(), result_.roots.end(),
              [](const SystemRoot& a, const SystemRoot& b) { return a.at < b.at; });
    return std::move(result_);
}

Search::Outcome Search::examine(Box& box) {
    system_.restrict_to(box, here_.arrays);
    if (system_.excluded(here_.arrays)) return Outcome::empty;
    if (system_.vanishes(here_.arrays)) return Outcome::zero;

    Box kept(l_, Interval(0.0, 1.0));
    if (n_ >= l_ && linearise(here_)) {
        if (options_.precondition && !system_.project(here_.combinations, kept)) return Outcome::empty;
        if (here_.contraction.maxCoeff() < largest_contraction) {
            const Outcome outcome = prove(box);
            if (outcome != Outcome::split) return outcome;
        }
    }
    if (!system_.project(here_.arrays, kept)) return Outcome::empty;

    variation_ = system_.variation(here_.arrays);
    bool shrunk = false;
    for (int j = 0; j < l_; ++j) {
        const Interval old = box[j];
        Interval side = Interval(old.low) + kept[j] * (Interval(old.high) - Interval(old.low));
        // Not thinner than this: a proof needs room around the solution.
        const double missing = 0.25 * options_.tolerance - width(side);
        if (missing > 0.0) side = inflated(side, missing);
        box[j] = {std::max(old.low, side.low), std::min(old.high, side.high)};
        variation_[j] *= width(kept[j]);
        shrunk = shrunk || (width(old) > options_.tolerance && width(box[j]) <= good_shrink * width(old));
    }
    result_.statistics.shrinks += shrunk;
    return shrunk ? Outcome::shrunk : Outcome::split;
}

bool Search::linearise(Linearised& part) const {
    std::optional<Matrix> inverse = system_.inverse_mean_derivative(part.arrays);
    if (!inverse) return false;
    part.inverse = std::move(*inverse);
    system_.combine(part.arrays, part.inverse, part.combinations);
    part.contraction = system_.contraction(part.combinations);
    return true;
}

bool Search::newton(const Linearised& part, Vector& at) {
    Vector values;
    Matrix jacobian;
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < newton_steps; ++step) {
        system_.evaluate(part.arrays, at, values, &jacobian);
        // On the combinations: for more polynomials than unknowns they have a common zero where the rest do not.
        const Vector change = (part.inverse * jacobian).colPivHouseholderQr().solve(part.inverse * values);
        if (!change.allFinite()) return false;
        at -= change;
        if (at.minCoeff() < -reach || at.maxCoeff() > 1.0 + reach) return false;
        const double size = change.lpNorm<Eigen::Infinity>();
        if (size < 4 * unit_roundoff || (step > 2 && size >= last)) return true;
        last = size;
    }
    return true;
}

Search::Outcome Search::prove(const Box& box) {
    Vector at = Vector::Constant(l_, 0.5);
    if (!newton(here_, at)) return Outcome::split;
    ++result_.statistics.proofs;
    if (at.minCoeff() >= margin && at.maxCoeff() <= 1.0 - margin) {
        const Outcome outcome = prove_candidate(box, box, here_, at);
        if (outcome != Outcome::split) return outcome;
    }
    // Near the border or outside: the same on a box that holds the candidate well inside.
    Box larger = box;
    for (int j = 0; j < l_; ++j) {
        const double low = std::min(0.0, at[j]) - margin, high = std::max(1.0, at[j]) + margin;
        larger[j] = {box[j].low + low * width(box[j]), box[j].low + high * width(box[j])};
        at[j] = (at[j] - low) / (high - low);
    }
    return prove_on_larger(larger, box, at);
}

Search::Outcome Search::prove_on_larger(const Box& box, const Box& wanted, Vector at) {
    system_.restrict_to(box, larger_.arrays);
    if (!linearise(larger_) || !(larger_.contraction.maxCoeff() < largest_contraction)) return Outcome::split;
    if (!newton(larger_, at)) return Outcome::split;
    return prove_candidate(box, wanted, larger_, at);
}

Search::Outcome Search::prove_candidate(const Box& box, const Box& wanted, const Linearised& part, const Vector& at) {
    if (at.minCoeff() < 0.0 || at.maxCoeff() > 1.0) return Outcome::split;
    Vector values;
    system_.evaluate(part.arrays, at, values, nullptr);
    Vector residual(l_);  // bounds on |g(at)|
    for (int i = 0; i < l_; ++i) {
        double sum = 0.0, uncertainty = 0.0;
        for (int k = 0; k < n_; ++k) {
            sum += part.inverse(i, k) * values[k];
            uncertainty += std::abs(part.inverse(i, k)) *
                           (system_.value_error(part.arrays, k) + gamma_bound(n_ + 1) * std::abs(values[k]));
        }
        residual[i] = (std::abs(sum) + uncertainty) * bound_slack;
    }
    const double ball = residual.maxCoeff() / (1.0 - part.contraction.maxCoeff()) * bound_slack;
    if (at.minCoeff() - ball < 0.0 || at.maxCoeff() + ball > 1.0) return Outcome::split;

    if (n_ > l_)
        for (int k = 0; k < n_; ++k) {
            const double most = system_.value_error(part.arrays, k) + system_.slope(part.arrays, k) * ball;
            if (std::abs(values[k]) > most * bound_slack) return Outcome::empty;
        }

    SystemRoot root;
    root.box = box;
    root.exists = n_ == l_;
    for (int j = 0; j < l_; ++j) {
        const double scale = width(box[j]);
        root.at.push_back(box[j].low + at[j] * scale);
        const double local = std::min(ball, residual[j] + part.contraction[j] * ball);
        const double placing = 4 * unit_roundoff * (std::abs(box[j].low) + scale);
        root.radius.push_back(rounded_up((local * scale + placing) * bound_slack));
        const Interval place = inflated(Interval(root.at[j]), root.radius[j]);
        if (place.high < wanted[j].low || place.low > wanted[j].high) return Outcome::empty;
    }
    if (root.exists) {
        const Interval sign = determinant(part.inverse);
        root.jacobian_sign = sign.low > 0.0 ? 1 : sign.high < 0.0 ? -1 : 0;
    }
    add_root(std::move(root));
    return Outcome::root;
}

void Search::add_root(SystemRoot root) {
    const auto ball_within = [&](const SystemRoot& inner, const SystemRoot& outer) {
        for (int j = 0; j < l_; ++j) {
            const Interval place = inflated(Interval(inner.at[j]), inner.radius[j]);
            if (place.low < outer.box[j].low || place.high > outer.box[j].high) return false;
        }
        return true;
    };
    for (const SystemRoot& other : result_.roots)
        if (ball_within(root, other) || ball_within(other, root)) return;
    result_.roots.push_back(std::move(root));
}

void Search::cluster_undecided() {
    std::vector<UndecidedBox>& undecided = result_.undecided;
    std::vector<Interval> sides;
    for (const UndecidedBox& part : undecided) sides.insert(sides.end(), part.box.begin(), part.box.end());
    const BoxClusters clusters = cluster_boxes(sides, l_, options_.tolerance);
    std::vector<Box> hulls(clusters.count);
    for (std::size_t k = 0; k < undecided.size(); ++k) {
        undecided[k].cluster = clusters.cluster[k];
        Box& whole = hulls[clusters.cluster[k]];
        if (whole.empty()) whole = undecided[k].box;
        for (int j = 0; j < l_; ++j) whole[j] = hull(whole[j], undecided[k].box[j]);
    }
    // Projection may have cut a box down to where rounding hides the derivative: the proof is tried on larger ones.
    std::vector<int> number(clusters.count, -1);
    for (int c = 0; c < clusters.count; ++c) {
        Outcome outcome = Outcome::split;
        const double side = largest_side(hulls[c]);
        if (n_ >= l_ && side <= largest_inflation * options_.tolerance)
            for (double factor = 2.0; outcome == Outcome::split && factor <= largest_inflation; factor *= 4.0) {
                Box larger = hulls[c];
                for (Interval& part : larger) part = inflated(part, factor * side);
                ++result_.statistics.proofs;
                outcome = prove_on_larger(larger, hulls[c], Vector::Constant(l_, 0.5));
            }
        if (outcome == Outcome::split) number[c] = result_.clusters++;
    }
    std::erase_if(undecided, [&](const UndecidedBox& part) { return number[part.cluster] < 0; });
    for (UndecidedBox& part : undecided) part.cluster = number[part.cluster];
}

}  // namespace

ParameterInterval placed(const Interval& side, const ParameterInterval& range) {
    const auto place = [&](double t) { return t == 1.0 ? range.high : range.low + t * range.length(); };
    return {place(side.low), place(side.high)};
}

PlacedCoordinate placed(const SystemRoot& root, int unknown, const ParameterInterval& range) {
    const double inside = std::clamp(root.at[unknown], 0.0, 1.0);
    const double moved = root.radius[unknown] + std::abs(root.at[unknown] - inside);
    const double placing = 4 * unit_roundoff * (std::abs(range.low) + std::abs(range.high));
    return {placed(Interval(inside), range).low, (moved * range.length() + placing) * bound_slack};
}

SystemRoots solve_projected_polyhedron(std::span<const MultivariatePolynomial> system,
                                       const ProjectedPolyhedronOptions& options, const Progress& progress) {
    return Search(system, options).run(progress);
}

}  // namespace umbilic
