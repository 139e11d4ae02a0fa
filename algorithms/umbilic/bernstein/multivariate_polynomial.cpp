// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/multivariate_polynomial.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <umbilic/bernstein/binomials.h>
#include <umbilic/bernstein/rounding.h>
#include <umbilic/bernstein/subdivision.h>
#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

/// Coefficients after unknown `k` in the order of storage.
std::size_t inner_count(std::span<const int> degrees, int k) {
    return coefficient_count(degrees.subspan(k + 1));
}

int degree_sum(std::span<const int> degrees) {
    return std::accumulate(degrees.begin(), degrees.end(), 0);
}

void expect_same_unknowns(const MultivariatePolynomial& a, const MultivariatePolynomial& b) {
    if (a.unknowns() != b.unknowns())
        throw InvalidInput("polynomials in " + std::to_string(a.unknowns()) + " and " + std::to_string(b.unknowns()) +
                           " unknowns do not combine");
}

/// Multiplies every coefficient by the product of `factors(degree)[index]` over the unknowns.
template <typename Factors>
void multiply_by_index(std::span<const int> degrees, std::vector<double>& coefficients, const Factors& factors) {
    for (std::size_t k = 0; k < degrees.size(); ++k) {
        const double* factor = factors(degrees[k]);
        const std::size_t inner = inner_count(degrees, static_cast<int>(k));
        for (std::size_t at = 0; at < coefficients.size(); ++at)
            coefficients[at] *= factor[at / inner % (degrees[k] + 1)];
    }
}

std::vector<double> scaled_coefficients(const MultivariatePolynomial& p) {
    std::vector<double> result = p.coefficients;
    multiply_by_index(p.degrees, result, [](int n) { return binomials(n); });
    return result;
}

/// result += a b in the scaled basis, unknown by unknown: a plain convolution.
void convolve(std::span<const int> a_degrees, const double* a, std::span<const int> b_degrees, const double* b,
              double* result) {
    if (a_degrees.empty()) {
        *result += *a * *b;
        return;
    }
    const std::size_t a_inner = inner_count(a_degrees, 0), b_inner = inner_count(b_degrees, 0);
    std::size_t inner = 1;
    for (std::size_t k = 1; k < a_degrees.size(); ++k) inner *= a_degrees[k] + b_degrees[k] + 1;
    for (int i = 0; i <= a_degrees[0]; ++i)
        for (int j = 0; j <= b_degrees[0]; ++j)
            convolve(a_degrees.subspan(1), a + i * a_inner, b_degrees.subspan(1), b + j * b_inner,
                     result + (i + j) * inner);
}

MultivariatePolynomial combination(const MultivariatePolynomial& a, const MultivariatePolynomial& b, double sign) {
    expect_same_unknowns(a, b);
    MultivariatePolynomial result = elevated(a, b.degrees);
    const MultivariatePolynomial other = elevated(b, a.degrees);
    const double arithmetic = unit_roundoff * (magnitude(result) + magnitude(other));
    for (std::size_t at = 0; at < result.coefficients.size(); ++at)
        result.coefficients[at] += sign * other.coefficients[at];
    result.error = (result.error + other.error + arithmetic) * bound_slack;
    return result;
}

}  // namespace

std::size_t coefficient_count(std::span<const int> degrees) {
    std::size_t result = 1;
    for (const int degree : degrees) result *= static_cast<std::size_t>(degree) + 1;
    return result;
}

void check(const MultivariatePolynomial& polynomial, const char* name) {
    const std::string start = std::string(name) + ": ";
    if (polynomial.degrees.empty()) throw InvalidInput(start + "the polynomial has no unknowns");
    for (const int degree : polynomial.degrees)
        if (degree < 0 || degree > maximum_product_degree)
            throw InvalidInput(start + "degree " + std::to_string(degree) + " is not within 0 and " +
                               std::to_string(maximum_product_degree));
    const std::size_t count = coefficient_count(polynomial.degrees);
    if (polynomial.coefficients.size() != count)
        throw InvalidInput(start + std::to_string(polynomial.coefficients.size()) +
                           " coefficients where the degrees ask for " + std::to_string(count));
    for (const double c : polynomial.coefficients)
        if (!std::isfinite(c)) throw InvalidInput(start + "a coefficient is not finite");
    if (!(std::isfinite(polynomial.error) && polynomial.error >= 0.0))
        throw InvalidInput(start + "the error must be finite and not negative");
}

double magnitude(const MultivariatePolynomial& polynomial) {
    double result = 0.0;
    for (const double c : polynomial.coefficients) result = std::max(result, std::abs(c));
    return result;
}

Interval coefficient_range(const MultivariatePolynomial& polynomial) {
    const auto [low, high] = std::minmax_element(polynomial.coefficients.begin(), polynomial.coefficients.end());
    return inflated({*low, *high}, polynomial.error);
}

Interval evaluate(const MultivariatePolynomial& polynomial, std::span<const double> at) {
    if (at.size() != polynomial.degrees.size())
        throw InvalidInput("a polynomial in " + std::to_string(polynomial.unknowns()) + " unknowns is evaluated at " +
                           std::to_string(at.size()) + " coordinates");
    std::vector<Interval> values;
    values.reserve(polynomial.coefficients.size());
    for (const double c : polynomial.coefficients) values.push_back(inflated(Interval(c), polynomial.error));
    for (int k = polynomial.unknowns() - 1; k >= 0; --k) {
        std::vector<Interval> basis(polynomial.degrees[k] + 1);
        bernstein_basis(polynomial.degrees[k], at[k], basis.data());
        const std::size_t count = values.size() / basis.size();
        for (std::size_t a = 0; a < count; ++a) {
            Interval sum;
            for (std::size_t i = 0; i < basis.size(); ++i) sum = sum + basis[i] * values[a * basis.size() + i];
            values[a] = sum;
        }
        values.resize(count);
    }
    return values[0];
}

MultivariatePolynomial derivative(const MultivariatePolynomial& polynomial, int unknown) {
    const int degree = polynomial.degrees.at(unknown);
    const std::size_t inner = inner_count(polynomial.degrees, unknown);
    MultivariatePolynomial result;
    result.degrees = polynomial.degrees;
    result.degrees[unknown] = std::max(degree - 1, 0);
    result.coefficients.resize(coefficient_count(result.degrees));
    if (degree == 0) return result;
    const std::size_t block = inner * degree;
    for (std::size_t at = 0; at < result.coefficients.size(); ++at) {
        const double* c = polynomial.coefficients.data() + at / block * (block + inner) + at % block;
        result.coefficients[at] = degree * (c[inner] - c[0]);
    }
    result.error = 2.0 * degree * (polynomial.error + gamma_bound(2) * magnitude(polynomial)) * bound_slack;
    return result;
}

MultivariatePolynomial elevated(const MultivariatePolynomial& polynomial, std::span<const int> degrees) {
    MultivariatePolynomial result = polynomial;
    int roundings = 0;
    for (int k = 0; k < polynomial.unknowns(); ++k) {
        const std::size_t inner = inner_count(result.degrees, k);
        for (int n = result.degrees[k]; n < degrees[k]; ++n) {
            // b_i of degree n + 1 is the mean of b_{i-1} and b_i with weights i / (n + 1) and 1 - i / (n + 1).
            const std::size_t blocks = result.coefficients.size() / (inner * (n + 1));
            std::vector<double> raised(blocks * inner * (n + 2));
            for (std::size_t block = 0; block < blocks; ++block)
                for (int i = 0; i <= n + 1; ++i) {
                    const double* c = result.coefficients.data() + (block * (n + 1) + i) * inner;
                    double* target = raised.data() + (block * (n + 2) + i) * inner;
                    for (std::size_t a = 0; a < inner; ++a)
                        target[a] = i == 0       ? c[a]
                                    : i == n + 1 ? (c - inner)[a]
                                                 : (i * (c - inner)[a] + (n + 1 - i) * c[a]) / (n + 1);
                }
            result.coefficients = std::move(raised);
            result.degrees[k] = n + 1;
            roundings += 3;
        }
    }
    if (roundings > 0) result.error = (result.error + gamma_bound(roundings) * magnitude(polynomial)) * bound_slack;
    return result;
}

Restriction restrict_unknown(std::size_t blocks, int degree, std::size_t inner, double* coefficients, double low,
                             double high) {
    if (degree == 0 || (low == 0.0 && high == 1.0)) return {};
    const CoefficientShape shape{degree, static_cast<int>(inner) - 1};
    // The end nearer to the border first: the other one, relative to the part kept, then lies within [0, 1] even where
    // a small box reaches out.
    const bool low_first = low < 1.0 - high;
    const double relative = low_first ? (high - low) / (1.0 - low) : low / high;
    Restriction result;
    for (std::size_t block = 0; block < blocks; ++block) {
        double* c = coefficients + block * shape.size();
        if (low_first)
            result.growth = keep_above_u(shape, c, low) * keep_below_u(shape, c, relative);
        else
            result.growth = keep_below_u(shape, c, high) * keep_above_u(shape, c, relative);
    }
    // Two passes of 3 roundings a step. The quotient is off by 3 units at most, which moves each of the `degree`
    // arguments of the polar form by that share of its range and the form by 2 M times that.
    result.arithmetic = gamma_bound(12 * degree + 2);
    return result;
}

MultivariatePolynomial restricted(const MultivariatePolynomial& polynomial, std::span<const Interval> box) {
    if (box.size() != polynomial.degrees.size())
        throw InvalidInput("a polynomial in " + std::to_string(polynomial.unknowns()) + " unknowns is restricted to " +
                           std::to_string(box.size()) + " intervals");
    MultivariatePolynomial result = polynomial;
    for (int k = 0; k < result.unknowns(); ++k) {
        if (!(box[k].low < box[k].high && box[k].high > 0.0 && box[k].low < 1.0 && std::isfinite(box[k].low) &&
              std::isfinite(box[k].high)))
            throw InvalidInput("a polynomial is restricted to an interval that is empty, infinite or outside [0, 1]");
        const double before = magnitude(result);
        const std::size_t inner = inner_count(result.degrees, k);
        const std::size_t blocks = result.coefficients.size() / (inner * (result.degrees[k] + 1));
        const auto [growth, arithmetic] =
            restrict_unknown(blocks, result.degrees[k], inner, result.coefficients.data(), box[k].low, box[k].high);
        result.error = growth * (result.error + arithmetic * before) * bound_slack;
    }
    return result;
}

MultivariatePolynomial operator+(const MultivariatePolynomial& a, const MultivariatePolynomial& b) {
    return combination(a, b, 1.0);
}

MultivariatePolynomial operator-(const MultivariatePolynomial& a, const MultivariatePolynomial& b) {
    return combination(a, b, -1.0);
}

MultivariatePolynomial operator*(const MultivariatePolynomial& a, const MultivariatePolynomial& b) {
    expect_same_unknowns(a, b);
    MultivariatePolynomial result;
    int terms = 1;
    for (int k = 0; k < a.unknowns(); ++k) {
        result.degrees.push_back(a.degrees[k] + b.degrees[k]);
        if (result.degrees.back() > maximum_product_degree)
            throw InvalidInput("a product of degree " + std::to_string(result.degrees.back()) + " is above " +
                               std::to_string(maximum_product_degree));
        terms *= std::min(a.degrees[k], b.degrees[k]) + 1;
    }
    result.coefficients.resize(coefficient_count(result.degrees));
    convolve(a.degrees, scaled_coefficients(a).data(), b.degrees, scaled_coefficients(b).data(),
             result.coefficients.data());
    multiply_by_index(result.degrees, result.coefficients, [](int n) { return inverse_binomials(n); });
    // A binomial of degree n has n roundings, its reciprocal one more; each is multiplied in with one.
    const int roundings = terms + 1 + 2 * degree_sum(result.degrees) + 4 * a.unknowns();
    const double a_size = magnitude(a), b_size = magnitude(b);
    result.error =
        (a.error * (b_size + b.error) + a_size * b.error + gamma_bound(roundings) * a_size * b_size) * bound_slack;
    return result;
}

MultivariatePolynomial operator*(double factor, const MultivariatePolynomial& polynomial) {
    MultivariatePolynomial result = polynomial;
    for (double& c : result.coefficients) c *= factor;
    result.error = std::abs(factor) * (polynomial.error + unit_roundoff * magnitude(polynomial)) * bound_slack;
    return result;
}

}  // namespace umbilic
