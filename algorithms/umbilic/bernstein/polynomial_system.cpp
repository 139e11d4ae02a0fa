// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/polynomial_system.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

#include <umbilic/bernstein/axis_hull.h>
#include <umbilic/bernstein/rounding.h>
#include <umbilic/bernstein/subdivision.h>
#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

using Array = Eigen::Map<const Eigen::ArrayXd>;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Pivots below this share of the largest count as zero when the mean derivative is inverted.
constexpr double least_pivot = 1e-9;

}  // namespace

PolynomialSystem::PolynomialSystem(std::span<const MultivariatePolynomial> system) {
    if (system.empty()) throw InvalidInput("polynomial system: there are no polynomials");
    for (const MultivariatePolynomial& f : system) check(f, "polynomial system");
    const int l = system[0].unknowns();
    degrees_.assign(l, 0);
    for (const MultivariatePolynomial& f : system) {
        if (f.unknowns() != l) throw InvalidInput("polynomial system: the numbers of unknowns differ");
        for (int j = 0; j < l; ++j) degrees_[j] = std::max(degrees_[j], f.degrees[j]);
    }
    size_ = coefficient_count(degrees_);
    std::size_t inner = size_;
    for (const int degree : degrees_) {
        inner /= degree + 1;
        inner_.push_back(inner);
        basis_.emplace_back(degree + 1);
        slopes_.emplace_back(degree + 1);
    }
    scratch_.resize(size_);
    for (const MultivariatePolynomial& f : system) {
        // A power of two, so that nothing over- or underflows and the magnitudes compare.
        const double largest = umbilic::magnitude(f);
        const int exponent = largest > 0.0 ? -std::ilogb(largest) : 0;
        MultivariatePolynomial scaled = f;
        for (double& c : scaled.coefficients) c = std::ldexp(c, exponent);
        scaled.error = rounded_up(std::ldexp(f.error, exponent));
        scaled = elevated(scaled, degrees_);
        root_.coefficients.insert(root_.coefficients.end(), scaled.coefficients.begin(), scaled.coefficients.end());
        root_.error.push_back(scaled.error);
        root_.magnitude.push_back(umbilic::magnitude(scaled));
    }
}

void PolynomialSystem::restrict_to(std::span<const Interval> box, CoefficientArrays& result) const {
    result = root_;
    double growth = 1.0, arithmetic = 0.0;
    for (int j = 0; j < unknowns(); ++j) {
        const std::size_t blocks = result.coefficients.size() / (inner_[j] * (degrees_[j] + 1));
        const Restriction step =
            restrict_unknown(blocks, degrees_[j], inner_[j], result.coefficients.data(), box[j].low, box[j].high);
        growth *= step.growth * bound_slack;
        arithmetic += step.arithmetic * bound_slack;
    }
    for (int k = 0; k < result.count(); ++k) {
        result.error[k] = growth * (root_.error[k] + arithmetic * root_.magnitude[k]) * bound_slack;
        result.magnitude[k] = Array(array(result, k), size_).abs().maxCoeff();
    }
}

bool PolynomialSystem::excluded(const CoefficientArrays& arrays) const {
    for (int k = 0; k < arrays.count(); ++k) {
        const Array c(array(arrays, k), size_);
        if (c.minCoeff() > arrays.error[k] || c.maxCoeff() < -arrays.error[k]) return true;
    }
    return false;
}

bool PolynomialSystem::vanishes(const CoefficientArrays& arrays) const {
    for (int k = 0; k < arrays.count(); ++k)
        if (arrays.magnitude[k] > arrays.error[k]) return false;
    return true;
}

bool PolynomialSystem::project(const CoefficientArrays& arrays, std::span<Interval> kept) const {
    std::vector<Interval> columns;
    for (int k = 0; k < arrays.count(); ++k) {
        const double* c = array(arrays, k);
        for (int j = 0; j < unknowns(); ++j) {
            const std::size_t inner = inner_[j], row = inner * (degrees_[j] + 1);
            columns.resize(degrees_[j] + 1);
            for (int i = 0; i <= degrees_[j]; ++i) {
                double low = std::numeric_limits<double>::infinity(), high = -low;
                for (std::size_t start = i * inner; start < size_; start += row)
                    for (std::size_t a = start; a < start + inner; ++a) {
                        low = std::min(low, c[a]);
                        high = std::max(high, c[a]);
                    }
                columns[i] = inflated({low, high}, arrays.error[k]);
            }
            const std::optional<Interval> part = axis_hull(columns);
            if (!part) return false;
            kept[j] = {std::max(kept[j].low, part->low), std::min(kept[j].high, part->high)};
            if (kept[j].low > kept[j].high) return false;
        }
    }
    return true;
}

Vector PolynomialSystem::variation(const CoefficientArrays& arrays) const {
    Vector result = Vector::Zero(unknowns());
    for (int k = 0; k < arrays.count(); ++k) {
        if (arrays.magnitude[k] <= arrays.error[k]) continue;
        const double* c = array(arrays, k);
        for (int j = 0; j < unknowns(); ++j) {
            const std::size_t inner = inner_[j], row = inner * (degrees_[j] + 1);
            double sum = 0.0;
            for (std::size_t start = 0; start < size_; start += row)
                for (std::size_t a = start; a < start + row - inner; ++a)
                    sum += std::max(0.0, std::abs(c[a + inner] - c[a]) - 2 * arrays.error[k]);
            const double mean = sum * (degrees_[j] + 1) / static_cast<double>(size_);
            result[j] = std::max(result[j], mean / arrays.magnitude[k]);
        }
    }
    return result;
}

std::optional<Matrix> PolynomialSystem::inverse_mean_derivative(const CoefficientArrays& arrays) const {
    const int n = polynomials(), l = unknowns();
    Matrix derivative(n, l);
    for (int k = 0; k < n; ++k) {
        const double* c = array(arrays, k);
        for (int j = 0; j < l; ++j) {
            const std::size_t inner = inner_[j], row = inner * (degrees_[j] + 1);
            double sum = 0.0;
            for (std::size_t start = 0; start < size_; start += row)
                for (std::size_t a = 0; a < inner; ++a) sum += c[start + row - inner + a] - c[start + a];
            derivative(k, j) = sum * (degrees_[j] + 1) / static_cast<double>(size_);
        }
    }
    // Rows of a square system and all columns of one size, so that the rank is told by the directions alone.
    Vector row_scale = Vector::Ones(n);
    if (n == l) row_scale = derivative.rowwise().lpNorm<Eigen::Infinity>();
    if (row_scale.minCoeff() == 0.0) return std::nullopt;
    derivative = row_scale.cwiseInverse().asDiagonal() * derivative;
    const Vector column_scale = derivative.colwise().lpNorm<Eigen::Infinity>();
    if (column_scale.minCoeff() == 0.0) return std::nullopt;
    derivative = derivative * column_scale.cwiseInverse().asDiagonal();
    Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition(n, l);
    decomposition.setThreshold(least_pivot);
    decomposition.compute(derivative);
    if (decomposition.rank() < l) return std::nullopt;
    Matrix inverse = column_scale.cwiseInverse().asDiagonal() * decomposition.pseudoInverse() *
                     row_scale.cwiseInverse().asDiagonal();
    if (!inverse.allFinite()) return std::nullopt;
    return inverse;
}

void PolynomialSystem::combine(const CoefficientArrays& arrays, const Matrix& matrix, CoefficientArrays& result) const {
    const int rows = static_cast<int>(matrix.rows());
    result.coefficients.resize(rows * size_);
    result.error.assign(rows, 0.0);
    result.magnitude.resize(rows);
    for (int i = 0; i < rows; ++i) {
        Eigen::Map<Eigen::ArrayXd> g(result.coefficients.data() + i * size_, size_);
        g.setZero();
        for (int k = 0; k < arrays.count(); ++k) {
            g += matrix(i, k) * Array(array(arrays, k), size_);
            result.error[i] +=
                std::abs(matrix(i, k)) * (arrays.error[k] + gamma_bound(arrays.count() + 1) * arrays.magnitude[k]);
        }
        result.error[i] *= bound_slack;
        result.magnitude[i] = g.abs().maxCoeff();
    }
}

Interval PolynomialSystem::differences(const CoefficientArrays& arrays, int k, int unknown) const {
    const double* c = array(arrays, k);
    const std::size_t inner = inner_[unknown], row = inner * (degrees_[unknown] + 1);
    if (row == inner) return Interval(0.0);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t start = 0; start < size_; start += row)
        for (std::size_t a = start; a < start + row - inner; ++a) {
            const double difference = c[a + inner] - c[a];
            low = std::min(low, difference);
            high = std::max(high, difference);
        }
    return inflated({low, high}, (2 * arrays.error[k] + 2 * unit_roundoff * arrays.magnitude[k]) * bound_slack);
}

Vector PolynomialSystem::contraction(const CoefficientArrays& combinations) const {
    Vector result(unknowns());
    for (int i = 0; i < unknowns(); ++i) {
        double sum = 0.0;
        for (int j = 0; j < unknowns(); ++j) {
            const Interval derivative = Interval(degrees_[j]) * differences(combinations, i, j);
            sum += (Interval(i == j ? 1.0 : 0.0) - derivative).magnitude();
        }
        result[i] = sum * bound_slack;
    }
    return result;
}

double PolynomialSystem::slope(const CoefficientArrays& arrays, int k) const {
    double sum = 0.0;
    for (int j = 0; j < unknowns(); ++j) sum += degrees_[j] * differences(arrays, k, j).magnitude();
    return sum * bound_slack;
}

double PolynomialSystem::contract(const double* coefficients, int derivative) {
    const double* source = coefficients;
    std::size_t rows = size_;
    for (int j = unknowns() - 1; j >= 0; --j) {
        const std::vector<double>& b = j == derivative ? slopes_[j] : basis_[j];
        rows /= b.size();
        for (std::size_t a = 0; a < rows; ++a) {
            double sum = 0.0;
            for (std::size_t i = 0; i < b.size(); ++i) sum += b[i] * source[a * b.size() + i];
            scratch_[a] = sum;
        }
        source = scratch_.data();
    }
    return scratch_[0];
}

void PolynomialSystem::evaluate(const CoefficientArrays& arrays, const Vector& at, Vector& values, Matrix* jacobian) {
    const int n = arrays.count(), l = unknowns();
    for (int j = 0; j < l; ++j) bernstein_basis(degrees_[j], at[j], basis_[j].data(), slopes_[j].data());
    values.resize(n);
    if (jacobian) jacobian->resize(n, l);
    for (int k = 0; k < n; ++k) {
        values[k] = contract(array(arrays, k), -1);
        for (int j = 0; j < l && jacobian; ++j) (*jacobian)(k, j) = contract(array(arrays, k), j);
    }
}

double PolynomialSystem::value_error(const CoefficientArrays& arrays, int k) const {
    // For each unknown: basis values 3 d, their products and sums d + 2 roundings.
    int roundings = 0;
    for (const int degree : degrees_) roundings += 4 * degree + 2;
    return (arrays.error[k] + gamma_bound(roundings) * arrays.magnitude[k]) * bound_slack;
}

}  // namespace umbilic
