// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/tensor_polynomial.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <umbilic/bernstein/binomials.h>
#include <umbilic/bernstein/rounding.h>

namespace umbilic {

namespace {

/// result row += factor * row, the inner loop of every product.
inline void add_multiple(double* result, const double* row, double factor, int length) {
    for (int j = 0; j < length; ++j) result[j] += factor * row[j];
}

void add_product(const TensorPolynomial& short_rows, const TensorPolynomial& long_rows, double sign,
                 TensorPolynomial& result) {
    const int stride = result.row_length();
    const int length = long_rows.row_length();
    const double* a = short_rows.scaled.data();
    for (int i = 0; i <= short_rows.u_degree; ++i)
        for (int j = 0; j < short_rows.row_length(); ++j) {
            const double factor = sign * *a++;
            if (factor == 0.0) continue;
            double* target = result.scaled.data() + i * stride + j;
            for (int k = 0; k <= long_rows.u_degree; ++k)
                add_multiple(target + k * stride, long_rows.scaled.data() + k * length, factor, length);
        }
}

/// The univariate restriction to an edge: Bernstein coefficients of the other variable, increasing.
std::vector<double> edge_coefficients(const TensorPolynomial& polynomial, PatchEdge edge) {
    const bool across_u = edge == PatchEdge::u_low || edge == PatchEdge::u_high;
    const int degree = across_u ? polynomial.v_degree : polynomial.u_degree;
    const double* inverse = inverse_binomials(degree);
    std::vector<double> result(degree + 1);
    for (int k = 0; k <= degree; ++k) {
        const int i = across_u ? (edge == PatchEdge::u_low ? 0 : polynomial.u_degree) : k;
        const int j = across_u ? k : (edge == PatchEdge::v_low ? 0 : polynomial.v_degree);
        result[k] = polynomial.scaled[i * polynomial.row_length() + j] * inverse[k];
    }
    return result;
}

int term_count(const TensorPolynomial& a, const TensorPolynomial& b) {
    return (std::min(a.u_degree, b.u_degree) + 1) * (std::min(a.v_degree, b.v_degree) + 1);
}

}  // namespace

void TensorPolynomial::set_zero(int m, int n) {
    assert(m >= 0 && n >= 0);
    u_degree = m;
    v_degree = n;
    scaled.assign(static_cast<std::size_t>(m + 1) * (n + 1), 0.0);
    magnitude = 0.0;
    bound = {};
}

void TensorPolynomial::measure() {
    const double* bu = inverse_binomials(u_degree);
    const double* bv = inverse_binomials(v_degree);
    magnitude = 0.0;
    for (int i = 0; i <= u_degree; ++i) {
        double largest = 0.0;
        const double* row = scaled.data() + i * row_length();
        for (int j = 0; j <= v_degree; ++j) largest = std::max(largest, std::abs(row[j]) * bv[j]);
        magnitude = std::max(magnitude, largest * bu[i]);
    }
    magnitude *= bound_slack;
}

Interval TensorPolynomial::coefficient_hull() const {
    const double* bu = inverse_binomials(u_degree);
    const double* bv = inverse_binomials(v_degree);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int i = 0; i <= u_degree; ++i) {
        const double* row = scaled.data() + i * row_length();
        for (int j = 0; j <= v_degree; ++j) {
            const double value = row[j] * (bu[i] * bv[j]);
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    const double conversion = gamma_bound(u_degree + v_degree + 4) * magnitude;
    return inflated({low, high}, (bound.input + conversion) * bound_slack);
}

CoefficientBound TensorPolynomial::bernstein_coefficients(std::span<double> result) const {
    assert(result.size() == scaled.size());
    const double* bu = inverse_binomials(u_degree);
    const double* bv = inverse_binomials(v_degree);
    for (int i = 0; i <= u_degree; ++i)
        for (int j = 0; j <= v_degree; ++j) {
            const int at = i * row_length() + j;
            result[at] = scaled[at] * (bu[i] * bv[j]);
        }
    const double conversion = gamma_bound(u_degree + v_degree + 4) * magnitude;
    return {(bound.rounding + conversion) * bound_slack, (bound.input + conversion) * bound_slack};
}

void sum_of_products(std::span<const ProductTerm> terms, TensorPolynomial& result) {
    assert(!terms.empty());
    result.set_zero(terms[0].left->u_degree + terms[0].right->u_degree,
                    terms[0].left->v_degree + terms[0].right->v_degree);
    int count = 0;
    double sizes = 0.0, rounding = 0.0, input = 0.0;
    for (const auto& [left, right, sign] : terms) {
        assert(left->u_degree + right->u_degree == result.u_degree);
        assert(left->v_degree + right->v_degree == result.v_degree);
        if (left->row_length() < right->row_length())
            add_product(*left, *right, sign, result);
        else
            add_product(*right, *left, sign, result);
        count += term_count(*left, *right);
        const double a = left->magnitude, b = right->magnitude;
        sizes += a * b;
        rounding += left->bound.rounding * (b + right->bound.rounding) + a * right->bound.rounding;
        input += left->bound.input * (b + right->bound.input) + a * right->bound.input;
    }
    const double arithmetic = gamma_bound(count) * sizes;
    result.bound = {(rounding + arithmetic) * bound_slack, (input + arithmetic) * bound_slack};
    result.measure();
}

void elevate(TensorPolynomial& polynomial, int u_raise, int v_raise) {
    assert(u_raise >= 0 && v_raise >= 0);
    // Multiplication by u + (1 - u), whose scaled coefficients are 1, 1.
    for (int step = 0; step < u_raise; ++step) {
        const int length = polynomial.row_length();
        polynomial.scaled.resize(polynomial.scaled.size() + length, 0.0);
        for (std::size_t at = polynomial.scaled.size() - 1; at >= static_cast<std::size_t>(length); --at)
            polynomial.scaled[at] += polynomial.scaled[at - length];
        ++polynomial.u_degree;
    }
    if (v_raise > 0) {
        const int old_length = polynomial.row_length(), length = old_length + v_raise;
        polynomial.scaled.resize(static_cast<std::size_t>(polynomial.u_degree + 1) * length);
        for (int i = polynomial.u_degree; i >= 0; --i) {
            double* row = polynomial.scaled.data() + i * length;
            std::copy_backward(polynomial.scaled.data() + i * old_length,
                               polynomial.scaled.data() + (i + 1) * old_length, row + old_length);
            std::fill(row + old_length, row + length, 0.0);
            for (int step = 1; step <= v_raise; ++step)
                for (int j = old_length - 1 + step; j > 0; --j) row[j] += row[j - 1];
        }
        polynomial.v_degree += v_raise;
    }
    const double arithmetic = gamma_bound(u_raise + v_raise) * polynomial.magnitude;
    polynomial.bound.rounding = (polynomial.bound.rounding + arithmetic) * bound_slack;
    polynomial.bound.input = (polynomial.bound.input + arithmetic) * bound_slack;
    polynomial.magnitude = (polynomial.magnitude + arithmetic) * bound_slack;
}

void add(const TensorPolynomial& left, const TensorPolynomial& right, TensorPolynomial& result) {
    assert(left.u_degree == right.u_degree && left.v_degree == right.v_degree);
    const double arithmetic = unit_roundoff * (left.magnitude + right.magnitude);
    const CoefficientBound bound = {
        (left.bound.rounding + right.bound.rounding + arithmetic) * bound_slack,
        (left.bound.input + right.bound.input + arithmetic) * bound_slack,
    };
    result.u_degree = left.u_degree;
    result.v_degree = left.v_degree;
    result.scaled.resize(left.scaled.size());
    for (std::size_t at = 0; at < result.scaled.size(); ++at) result.scaled[at] = left.scaled[at] + right.scaled[at];
    result.bound = bound;
    result.measure();
}

void derivative_u(const TensorPolynomial& polynomial, TensorPolynomial& result) {
    const int m = polynomial.u_degree, length = polynomial.row_length();
    result.set_zero(std::max(m - 1, 0), polynomial.v_degree);
    if (m == 0) return;
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < length; ++j)
            result.scaled[i * length + j] =
                (i + 1) * polynomial.scaled[(i + 1) * length + j] - (m - i) * polynomial.scaled[i * length + j];
    const double arithmetic = gamma_bound(2) * 2 * m * polynomial.magnitude;
    result.bound = {(2 * m * polynomial.bound.rounding + arithmetic) * bound_slack,
                    (2 * m * polynomial.bound.input + arithmetic) * bound_slack};
    result.measure();
}

void derivative_v(const TensorPolynomial& polynomial, TensorPolynomial& result) {
    const int n = polynomial.v_degree, length = polynomial.row_length();
    result.set_zero(polynomial.u_degree, std::max(n - 1, 0));
    if (n == 0) return;
    for (int i = 0; i <= polynomial.u_degree; ++i)
        for (int j = 0; j < n; ++j)
            result.scaled[i * n + j] =
                (j + 1) * polynomial.scaled[i * length + j + 1] - (n - j) * polynomial.scaled[i * length + j];
    const double arithmetic = gamma_bound(2) * 2 * n * polynomial.magnitude;
    result.bound = {(2 * n * polynomial.bound.rounding + arithmetic) * bound_slack,
                    (2 * n * polynomial.bound.input + arithmetic) * bound_slack};
    result.measure();
}

void divide_by_edge(TensorPolynomial& polynomial, PatchEdge edge) {
    const bool across_u = edge == PatchEdge::u_low || edge == PatchEdge::u_high;
    const int degree = across_u ? polynomial.u_degree : polynomial.v_degree;
    assert(degree > 0);
    const int length = polynomial.row_length();
    std::vector<double>& c = polynomial.scaled;
    if (edge == PatchEdge::u_low) c.erase(c.begin(), c.begin() + length);
    if (edge == PatchEdge::u_high) c.resize(c.size() - length);
    if (!across_u) {
        const int first = edge == PatchEdge::v_low ? 1 : 0;
        for (int i = 0; i <= polynomial.u_degree; ++i)
            for (int j = 0; j < length - 1; ++j) c[i * (length - 1) + j] = c[i * length + first + j];
        c.resize(static_cast<std::size_t>(polynomial.u_degree + 1) * (length - 1));
    }
    // b_k binomial(N, k) / binomial(N - 1, k) = b_k N / (N - k), at most N b_k.
    (across_u ? polynomial.u_degree : polynomial.v_degree) -= 1;
    polynomial.bound.rounding *= degree * bound_slack;
    polynomial.bound.input *= degree * bound_slack;
    polynomial.measure();
}

double edge_magnitude(const TensorPolynomial& polynomial, PatchEdge edge) {
    double result = 0.0;
    for (const double value : edge_coefficients(polynomial, edge)) result = std::max(result, std::abs(value));
    return result;
}

}  // namespace umbilic
