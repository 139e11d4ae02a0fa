// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/consistent_pairs.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

/// Triples from which the search starts; with 40 % wrong pairs one in five holds right ones only.
constexpr std::size_t most_triples = 2000;
/// Best of them that are concentrated, and steps for it: the sum decreases with each and usually stands after three.
constexpr std::size_t concentrated = 10;
constexpr int concentration_steps = 20;
/// Errors below this part of the pairs' extent are the rounding of printed coordinates: never an outlier.
constexpr double printed_rounding = 1e-9;

using Indices = std::vector<int>;

struct Start {
    SimilarityTransform pose;
    double trimmed = std::numeric_limits<double>::infinity();  ///< sum of the smallest squared residuals
};

Vector3 residual(const SimilarityTransform& pose, const PointPair& pair) {
    return pose.apply(pair.suspect) - pair.original;
}

/// Nothing if the points lie on a line.
std::optional<SimilarityTransform> fitted(std::span<const PointPair> pairs, const Indices& chosen,
                                          const PointFitOptions& options) {
    std::vector<PointPair> subset;
    for (const int i : chosen) subset.push_back(pairs[i]);
    try {
        return fit_points(subset, options).original_suspect;
    } catch (const InvalidInput&) {
        return {};
    }
}

/// All triples, or a fixed random choice of most_triples of them.
std::vector<std::array<int, 3>> triples(int n) {
    std::vector<std::array<int, 3>> result;
    if (static_cast<double>(n) * (n - 1) * (n - 2) / 6.0 <= most_triples) {
        for (int i = 0; i < n; ++i)
            for (int j = i + 1; j < n; ++j)
                for (int k = j + 1; k < n; ++k) result.push_back({i, j, k});
        return result;
    }
    std::mt19937 random;
    while (result.size() < most_triples) {
        const std::array<int, 3> triple = {static_cast<int>(random() % n), static_cast<int>(random() % n),
                                           static_cast<int>(random() % n)};
        if (triple[0] != triple[1] && triple[0] != triple[2] && triple[1] != triple[2]) result.push_back(triple);
    }
    return result;
}

/// The `count` pairs with the smallest residuals, and the sum of their squares.
std::pair<Indices, double> nearest(std::span<const PointPair> pairs, const SimilarityTransform& pose, int count) {
    std::vector<double> squares;
    for (const PointPair& pair : pairs) squares.push_back(pair.weight * residual(pose, pair).squaredNorm());
    Indices order(pairs.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return squares[a] < squares[b]; });
    order.resize(count);
    double sum = 0.0;
    for (const int i : order) sum += squares[i];
    return {order, sum};
}

/// The `count` pairs that agree best with one similarity; all of them if every triple lies on a line.
Indices best_half(std::span<const PointPair> pairs, int count, const PointFitOptions& options) {
    std::vector<Start> starts;
    for (const auto& [i, j, k] : triples(static_cast<int>(pairs.size())))
        if (const auto pose = fitted(pairs, {i, j, k}, options))
            starts.push_back({*pose, nearest(pairs, *pose, count).second});
    std::stable_sort(starts.begin(), starts.end(),
                     [](const Start& a, const Start& b) { return a.trimmed < b.trimmed; });
    if (starts.size() > concentrated) starts.resize(concentrated);
    Indices best(pairs.size());
    std::iota(best.begin(), best.end(), 0);
    double least = std::numeric_limits<double>::infinity();
    for (Start& start : starts) {
        Indices chosen = nearest(pairs, start.pose, count).first;
        for (int step = 0; step < concentration_steps; ++step) {
            const auto pose = fitted(pairs, chosen, options);
            if (!pose) break;
            auto [closer, trimmed] = nearest(pairs, *pose, count);
            if (trimmed < least) {
                least = trimmed;
                best = chosen;
            }
            if (!(trimmed < start.trimmed)) break;
            start.trimmed = trimmed;
            chosen = std::move(closer);
        }
    }
    return best;
}

/// A fit to some of the pairs, as a linear model of its unknowns: how far off are the others to be expected?
class Prediction {
public:
    Prediction(std::span<const PointPair> pairs, const Indices& kept, std::size_t all, const SimilarityTransform& pose,
               bool free_scale)
        : pose_(pose), unknowns_(free_scale ? 7 : 6), freedom_(3.0 * kept.size() - unknowns_) {
        for (const int i : kept) centre_ += pose.apply(pairs[i].suspect) / kept.size();
        double extent = 0.0, square = 0.0;
        for (const int i : kept) {
            extent += (pose.apply(pairs[i].suspect) - centre_).squaredNorm() / kept.size();
            square += residual(pose, pairs[i]).squaredNorm();
        }
        radius_ = std::sqrt(extent);
        Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns_, unknowns_);
        for (const int i : kept) normal += rows(pairs[i]).transpose() * rows(pairs[i]);
        solver_.compute(normal);
        // The kept residuals are the smallest ones: of a normal distribution they would be too small by this factor.
        const double share = static_cast<double>(kept.size()) / static_cast<double>(all);
        double consistency = 1.0;
        if (share < 1.0) {
            const double cut = quantile(boost::math::chi_squared(3.0), share);
            consistency = share / cdf(boost::math::chi_squared(5.0), cut);
        }
        deviation_ = std::sqrt(square / freedom_);
        const double rounding = printed_rounding * radius_;
        variance_ = std::max(consistency * square / freedom_, rounding * rounding);
    }

    /// Squared prediction error of a pair that was not fitted, over its expectation: follows F(3, freedom()).
    double error(const PointPair& pair) const {
        const Vector3 r = residual(pose_, pair);
        const auto j = rows(pair);
        const Matrix3 covariance = Matrix3::Identity() + j * solver_.solve(j.transpose());
        return r.dot(covariance.ldlt().solve(r)) / (3.0 * variance_);
    }
    double freedom() const { return freedom_; }
    /// As if the kept pairs were all right ones there are.
    double deviation() const { return deviation_; }

private:
    /// Motion of the pair's moved point with shift, turn and log(scale) about the centre.
    Eigen::Matrix<double, 3, Eigen::Dynamic> rows(const PointPair& pair) const {
        const Vector3 arm = (pose_.apply(pair.suspect) - centre_) / radius_;
        Eigen::Matrix<double, 3, Eigen::Dynamic> result(3, unknowns_);
        result.leftCols<3>().setIdentity();
        for (int k = 0; k < 3; ++k) result.col(3 + k) = Vector3::Unit(k).cross(arm);
        if (unknowns_ == 7) result.col(6) = arm;
        return result;
    }

    SimilarityTransform pose_;
    int unknowns_;
    double freedom_;
    Vector3 centre_ = Vector3::Zero();
    double radius_ = 0.0;
    double variance_ = 0.0, deviation_ = 0.0;
    Eigen::LDLT<Eigen::MatrixXd> solver_;
};

}  // namespace

ConsistentPointFit fit_consistent_points(std::span<const PointPair> pairs, const PointFitOptions& options) {
    // Also throws for what is not fit to be a set of pairs.
    PointFit fit = fit_points(pairs, options);
    const int n = static_cast<int>(pairs.size());
    Indices kept = best_half(pairs, std::max(3, n / 2 + 1), options);
    std::sort(kept.begin(), kept.end());
    std::vector<bool> is_kept(n, false);
    for (const int i : kept) is_kept[i] = true;

    ConsistentPointFit result;
    while (true) {
        std::vector<PointPair> subset;
        for (const int i : kept) subset.push_back(pairs[i]);
        fit = fit_points(subset, options);
        const Prediction prediction(pairs, kept, n, fit.original_suspect, options.free_scale);
        result.deviation = prediction.deviation();
        if (static_cast<int>(kept.size()) == n) break;
        int next = -1;
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < n; ++i) {
            if (is_kept[i]) continue;
            const double error = prediction.error(pairs[i]);
            if (next < 0 || error < least) {
                least = error;
                next = i;
            }
        }
        const boost::math::fisher_f distribution(3.0, prediction.freedom());
        if (least > quantile(complement(distribution, false_outlier / n))) break;
        kept.insert(std::upper_bound(kept.begin(), kept.end(), next), next);
        is_kept[next] = true;
    }

    result.original_suspect = fit.original_suspect;
    result.rms = fit.rms;
    result.max = fit.max;
    for (int i = 0; i < n; ++i) {
        result.residuals.push_back(residual(fit.original_suspect, pairs[i]).norm());
        if (!is_kept[i]) result.outliers.push_back(i);
    }
    return result;
}

}  // namespace umbilic
