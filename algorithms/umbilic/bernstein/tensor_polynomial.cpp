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

/// Row-major coefficients with their degrees.
struct Rows {
    int u_degree, row_length;
    const double* data;
};

/// result[n] += sum_j factor[j] values[n - j] for n < length, the inner loop of every product: so many factors at once
/// as values are held that have been loaded anyway.
template <int count>
void add_multiples(const double* factor, const double* values, int length, double* result) {
    for (int n = 0; n < length; ++n) {
        double sum = result[n];
        for (int j = 0; j < count; ++j) sum += factor[j] * values[n - j];
        result[n] = sum;
    }
}

void add_product(Rows a, Rows b, double sign, double* result) {
    constexpr int at_once = 4;
    const int stride = a.row_length + b.row_length - 1;
    const Rows &short_rows = a.row_length < b.row_length ? a : b, &long_rows = a.row_length < b.row_length ? b : a;
    // With the rows of one factor as far apart as those of the result, and zeros between them, all of them are one.
    const int length = long_rows.u_degree * stride + long_rows.row_length;
    std::vector<double> spread(at_once - 1 + length + at_once - 1, 0.0);
    double* const values = spread.data() + at_once - 1;
    for (int k = 0; k <= long_rows.u_degree; ++k)
        std::copy_n(long_rows.data + k * long_rows.row_length, long_rows.row_length, values + k * stride);
    const double* next = short_rows.data;
    for (int i = 0; i <= short_rows.u_degree; ++i, next += short_rows.row_length)
        for (int j = 0; j < short_rows.row_length; j += at_once) {
            double factor[at_once];
            const int count = std::min(at_once, short_rows.row_length - j);
            for (int k = 0; k < count; ++k) factor[k] = sign * next[j + k];
            double* const target = result + i * stride + j;
            if (count == 4) add_multiples<4>(factor, values, length + 3, target);
            if (count == 3) add_multiples<3>(factor, values, length + 2, target);
            if (count == 2) add_multiples<2>(factor, values, length + 1, target);
            if (count == 1) add_multiples<1>(factor, values, length, target);
        }
}

Rows rows(const TensorPolynomial& polynomial, const std::vector<double>& data) {
    return {polynomial.u_degree, polynomial.row_length(), data.data()};
}

/// own |c| + error of c, for every coefficient c.
std::vector<double> error_factor(const TensorPolynomial& polynomial, double own) {
    std::vector<double> result(polynomial.scaled.size());
    for (std::size_t at = 0; at < result.size(); ++at)
        result[at] = own * std::abs(polynomial.scaled[at]) + (polynomial.errors.empty() ? 0.0 : polynomial.errors[at]);
    return result;
}

/// errors of a b: |a| (e_b + gamma |b|) + e_a (|b| + e_b).
void add_product_errors(const TensorPolynomial& a, const TensorPolynomial& b, double gamma, TensorPolynomial& result) {
    std::vector<double> magnitudes(a.scaled.size());
    for (std::size_t at = 0; at < magnitudes.size(); ++at) magnitudes[at] = std::abs(a.scaled[at]);
    add_product(rows(a, magnitudes), rows(b, error_factor(b, gamma)), 1.0, result.errors.data());
    if (!a.errors.empty()) add_product(rows(a, a.errors), rows(b, error_factor(b, 1.0)), 1.0, result.errors.data());
}

/// Multiplies by (u + (1 - u))^u_raise (v + (1 - v))^v_raise, whose scaled coefficients are 1, 1.
void raise(std::vector<double>& c, int u_degree, int old_length, int u_raise, int v_raise) {
    for (int step = 0; step < u_raise; ++step) {
        c.resize(c.size() + old_length, 0.0);
        for (std::size_t at = c.size() - 1; at >= static_cast<std::size_t>(old_length); --at)
            c[at] += c[at - old_length];
    }
    if (v_raise == 0) return;
    const int length = old_length + v_raise;
    c.resize(static_cast<std::size_t>(u_degree + u_raise + 1) * length);
    for (int i = u_degree + u_raise; i >= 0; --i) {
        double* row = c.data() + i * length;
        std::copy_backward(c.data() + i * old_length, c.data() + (i + 1) * old_length, row + old_length);
        std::fill(row + old_length, row + length, 0.0);
        for (int step = 1; step <= v_raise; ++step)
            for (int j = old_length - 1 + step; j > 0; --j) row[j] += row[j - 1];
    }
}

/// Drops the row or column on an edge.
void drop_edge(std::vector<double>& c, int u_degree, int length, PatchEdge edge) {
    if (edge == PatchEdge::u_low) c.erase(c.begin(), c.begin() + length);
    if (edge == PatchEdge::u_high) c.resize(c.size() - length);
    if (edge == PatchEdge::u_low || edge == PatchEdge::u_high) return;
    const int first = edge == PatchEdge::v_low ? 1 : 0;
    for (int i = 0; i <= u_degree; ++i)
        for (int j = 0; j < length - 1; ++j) c[i * (length - 1) + j] = c[i * length + first + j];
    c.resize(static_cast<std::size_t>(u_degree + 1) * (length - 1));
}

bool exactly_zero(const TensorPolynomial& polynomial) {
    return polynomial.magnitude == 0.0 && polynomial.bound.input == 0.0;
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
    errors.clear();
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

void TensorPolynomial::bernstein_errors(std::span<double> result) const {
    assert(result.size() == scaled.size() && errors.size() == scaled.size());
    const double* bu = inverse_binomials(u_degree);
    const double* bv = inverse_binomials(v_degree);
    const double relative = gamma_bound(u_degree + v_degree + 4);
    for (int i = 0; i <= u_degree; ++i)
        for (int j = 0; j <= v_degree; ++j) {
            const int at = i * row_length() + j;
            result[at] =
                (errors[at] + relative * std::abs(scaled[at])) * (bu[i] * bv[j]) * (1 + relative) * bound_slack;
        }
}

void sum_of_products(std::span<const ProductTerm> terms, TensorPolynomial& result) {
    assert(!terms.empty());
    result.set_zero(terms[0].left->u_degree + terms[0].right->u_degree,
                    terms[0].left->v_degree + terms[0].right->v_degree);
    int count = 0;
    bool with_errors = false;
    double sizes = 0.0, rounding = 0.0, input = 0.0;
    for (const auto& [left, right, sign] : terms) {
        assert(left->u_degree + right->u_degree == result.u_degree);
        assert(left->v_degree + right->v_degree == result.v_degree);
        add_product(rows(*left, left->scaled), rows(*right, right->scaled), sign, result.scaled.data());
        with_errors = with_errors || !left->errors.empty() || !right->errors.empty();
        count += term_count(*left, *right);
        const double a = left->magnitude, b = right->magnitude;
        sizes += a * b;
        rounding += left->bound.rounding * (b + right->bound.rounding) + a * right->bound.rounding;
        input += left->bound.input * (b + right->bound.input) + a * right->bound.input;
    }
    const double arithmetic = gamma_bound(count) * sizes;
    result.bound = {(rounding + arithmetic) * bound_slack, (input + arithmetic) * bound_slack};
    result.measure();
    if (!with_errors) return;
    result.errors.assign(result.scaled.size(), 0.0);
    for (const auto& [left, right, sign] : terms) add_product_errors(*left, *right, gamma_bound(count), result);
    for (double& error : result.errors) error *= bound_slack;
}

void sum_of_unequal_products(std::span<const ProductTerm> terms, TensorPolynomial& result) {
    assert(!terms.empty());
    std::vector<ProductTerm> present;
    int m = 0, n = 0;
    bool equal = true;
    for (const ProductTerm& term : terms) {
        if (exactly_zero(*term.left) || exactly_zero(*term.right)) continue;
        const int u_degree = term.left->u_degree + term.right->u_degree;
        const int v_degree = term.left->v_degree + term.right->v_degree;
        equal = equal && (present.empty() || (u_degree == m && v_degree == n));
        m = std::max(m, u_degree);
        n = std::max(n, v_degree);
        present.push_back(term);
    }
    const ProductTerm& first = terms[0];
    if (present.empty())
        return result.set_zero(first.left->u_degree + first.right->u_degree,
                               first.left->v_degree + first.right->v_degree);
    std::vector<TensorPolynomial> raised;
    if (!equal) {
        raised.reserve(present.size());
        for (ProductTerm& term : present) {
            raised.push_back(*term.right);
            elevate(raised.back(), m - term.left->u_degree - term.right->u_degree,
                    n - term.left->v_degree - term.right->v_degree);
            term.right = &raised.back();
        }
    }
    sum_of_products(present, result);
}

void elevate(TensorPolynomial& polynomial, int u_raise, int v_raise) {
    assert(u_raise >= 0 && v_raise >= 0);
    const int u_degree = polynomial.u_degree, length = polynomial.row_length();
    if (!polynomial.errors.empty()) {
        for (std::size_t at = 0; at < polynomial.errors.size(); ++at)
            polynomial.errors[at] += gamma_bound(u_raise + v_raise) * std::abs(polynomial.scaled[at]);
        raise(polynomial.errors, u_degree, length, u_raise, v_raise);
        for (double& error : polynomial.errors) error *= bound_slack;
    }
    raise(polynomial.scaled, u_degree, length, u_raise, v_raise);
    polynomial.u_degree += u_raise;
    polynomial.v_degree += v_raise;
    const double arithmetic = gamma_bound(u_raise + v_raise) * polynomial.magnitude;
    polynomial.bound.rounding = (polynomial.bound.rounding + arithmetic) * bound_slack;
    polynomial.bound.input = (polynomial.bound.input + arithmetic) * bound_slack;
    polynomial.magnitude = (polynomial.magnitude + arithmetic) * bound_slack;
}

void raise_to_common_degree(std::span<TensorPolynomial* const> polynomials) {
    int m = 0, n = 0;
    for (const TensorPolynomial* polynomial : polynomials) {
        m = std::max(m, polynomial->u_degree);
        n = std::max(n, polynomial->v_degree);
    }
    for (TensorPolynomial* polynomial : polynomials)
        elevate(*polynomial, m - polynomial->u_degree, n - polynomial->v_degree);
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
    result.errors.clear();
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
    drop_edge(polynomial.scaled, polynomial.u_degree, length, edge);
    if (!polynomial.errors.empty()) drop_edge(polynomial.errors, polynomial.u_degree, length, edge);
    // b_k binomial(N, k) / binomial(N - 1, k) = b_k N / (N - k), at most N b_k.
    (across_u ? polynomial.u_degree : polynomial.v_degree) -= 1;
    polynomial.bound.rounding *= degree * bound_slack;
    polynomial.bound.input *= degree * bound_slack;
    polynomial.measure();
}

double edge_magnitude(const TensorPolynomial& polynomial, PatchEdge edge) {
    const bool across_u = edge == PatchEdge::u_low || edge == PatchEdge::u_high;
    const int degree = across_u ? polynomial.v_degree : polynomial.u_degree;
    const double* inverse = inverse_binomials(degree);
    double result = 0.0;
    for (int k = 0; k <= degree; ++k) {
        const int i = across_u ? (edge == PatchEdge::u_low ? 0 : polynomial.u_degree) : k;
        const int j = across_u ? k : (edge == PatchEdge::v_low ? 0 : polynomial.v_degree);
        result = std::max(result, std::abs(polynomial.scaled[i * polynomial.row_length() + j]) * inverse[k]);
    }
    return result;
}

}  // namespace umbilic
