// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/relaxation.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Step of the central differences that stand for the derivatives of g, relative to a component's scale: the cube root
/// of the unit roundoff balances rounding and truncation.
constexpr double difference_step = 6e-6;
/// Shares of a Newton step below this are not tried.
constexpr double smallest_share = 1e-3;

/// Newton's method on one mesh.
struct Mesh {
    const BoundaryValueProblem& problem;
    const RelaxationOptions& options;
    MatrixXd states;
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factors{};

    Eigen::Index n() const { return states.rows(); }
    Eigen::Index m() const { return states.cols(); }
    double step() const { return 1.0 / static_cast<double>(m() - 1); }

    /// F of (3.15)-(3.17), times the mesh width; false where g is not defined.
    bool residual(const MatrixXd& y, VectorXd& F) const {
        F.resize(n() * m());
        MatrixXd g(n(), m());
        VectorXd rate(n());
        for (Eigen::Index k = 0; k < m(); ++k) {
            if (!problem.rate(y.col(k), rate) || !rate.allFinite()) return false;
            g.col(k) = rate;
        }
        Eigen::Index row = 0;
        for (const auto& [component, value] : problem.at_start) F[row++] = y(component, 0) - value;
        for (Eigen::Index k = 1; k < m(); ++k, row += n())
            F.segment(row, n()) = y.col(k) - y.col(k - 1) - 0.5 * step() * (g.col(k) + g.col(k - 1));
        for (const auto& [component, value] : problem.at_end) F[row++] = y(component, m() - 1) - value;
        return true;
    }

    bool jacobian(const VectorXd& y, MatrixXd& result) const {
        VectorXd before(n()), after(n());
        for (Eigen::Index j = 0; j < n(); ++j) {
            const double width = difference_step * problem.scale[j];
            VectorXd at = y;
            at[j] = y[j] + width;
            if (!problem.rate(at, after)) return false;
            at[j] = y[j] - width;
            if (!problem.rate(at, before)) return false;
            result.col(j) = (after - before) / (2 * width);
        }
        return result.allFinite();
    }

    bool factorise() {
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(static_cast<std::size_t>(2 * n() * n() * m()));
        Eigen::Index row = 0;
        for (const auto& [component, value] : problem.at_start) entries.emplace_back(row++, component, 1.0);
        MatrixXd here(n(), n()), before(n(), n());
        if (!jacobian(states.col(0), before)) return false;
        for (Eigen::Index k = 1; k < m(); ++k, row += n()) {
            if (!jacobian(states.col(k), here)) return false;
            for (Eigen::Index i = 0; i < n(); ++i)
                for (Eigen::Index j = 0; j < n(); ++j) {
                    const double one = i == j ? 1.0 : 0.0;
                    entries.emplace_back(row + i, (k - 1) * n() + j, -one - 0.5 * step() * before(i, j));
                    entries.emplace_back(row + i, k * n() + j, one - 0.5 * step() * here(i, j));
                }
            std::swap(here, before);
        }
        for (const auto& [component, value] : problem.at_end)
            entries.emplace_back(row++, (m() - 1) * n() + component, 1.0);
        Eigen::SparseMatrix<double> matrix(n() * m(), n() * m());
        matrix.setFromTriplets(entries.begin(), entries.end());
        factors.compute(matrix);
        return factors.info() == Eigen::Success;
    }

    double norm(const VectorXd& correction) const {
        double sum = 0.0;
        for (Eigen::Index i = 0; i < correction.size(); ++i) sum += std::abs(correction[i]) / problem.scale[i % n()];
        return sum;
    }

    /// Number of iterations, or -1 without convergence.
    int solve(const Progress& progress) {
        VectorXd F;
        if (!residual(states, F)) return -1;
        for (int iteration = 1; iteration <= options.most_iterations; ++iteration) {
            progress.check();
            if (!factorise()) return -1;
            const VectorXd correction = -factors.solve(F);
            const double size = norm(correction);
            if (!std::isfinite(size)) return -1;
            // The share of the step for which the next correction, by the same factors, becomes shorter.
            double share = 1.0;
            MatrixXd next;
            VectorXd next_F;
            while (true) {
                next = states + share * correction.reshaped(n(), m());
                if (residual(next, next_F)) {
                    if (size <= options.epsilon) break;
                    if (norm(factors.solve(next_F)) <= (1 - 0.5 * share) * size) break;
                }
                share *= 0.5;
                if (share < smallest_share) return -1;
            }
            states = next;
            F = next_F;
            if (size <= options.epsilon) return iteration;
        }
        return -1;
    }
};

/// Twice as fine: between two states the cubic through them and their rates.
bool halved(const BoundaryValueProblem& problem, const MatrixXd& y, MatrixXd& result) {
    const Eigen::Index m = y.cols();
    const double h = 1.0 / static_cast<double>(m - 1);
    MatrixXd g(y.rows(), m);
    VectorXd rate(y.rows());
    for (Eigen::Index k = 0; k < m; ++k) {
        if (!problem.rate(y.col(k), rate)) return false;
        g.col(k) = rate;
    }
    result.resize(y.rows(), 2 * m - 1);
    for (Eigen::Index k = 0; k < m; ++k) {
        result.col(2 * k) = y.col(k);
        if (k > 0) result.col(2 * k - 1) = 0.5 * (y.col(k) + y.col(k - 1)) + 0.125 * h * (g.col(k - 1) - g.col(k));
    }
    return true;
}

}  // namespace

Relaxation relax(const BoundaryValueProblem& problem, const MatrixXd& guess, const RelaxationOptions& options,
                 const Progress& progress) {
    const auto given = static_cast<Eigen::Index>(problem.at_start.size() + problem.at_end.size());
    if (guess.cols() < 2 || given != guess.rows() || problem.scale.size() != guess.rows())
        throw InvalidInput("relaxation: boundary values, scales and first mesh do not fit together");
    Relaxation result{.states = guess, .error = std::numeric_limits<double>::infinity()};
    Mesh mesh{problem, options, guess};
    result.iterations = mesh.solve(progress);
    if (result.iterations < 0) {
        result.iterations = options.most_iterations;
        return result;
    }
    result.states = mesh.states;
    if (!(options.tolerance > 0.0)) {
        result.converged = true;
        return result;
    }
    while (2 * result.states.cols() - 1 <= options.most_points) {
        Mesh finer{problem, options, {}};
        if (!halved(problem, result.states, finer.states) || finer.solve(progress) < 0) return result;
        double moved = 0.0;
        for (Eigen::Index k = 0; k < result.states.cols(); ++k)
            moved = std::max(moved, problem.distance(result.states.col(k), finer.states.col(2 * k)));
        result.states = finer.states;
        result.error = moved;
        if (moved <= options.tolerance) {
            result.converged = true;
            return result;
        }
    }
    return result;
}

}  // namespace umbilic
