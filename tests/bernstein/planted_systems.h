// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <umbilic/bernstein/multivariate_polynomial.h>

namespace umbilic::support {

/// 100 digits: rounding is nothing beside any bound tested with it.
using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

inline Exact exact_binomial(int n, int k) {
    Exact result = 1;
    for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
    return result;
}

/// Value by the definition, or the derivative by one unknown: powers and binomials, not the code's recursion.
inline Exact exact_value(const MultivariatePolynomial& f, std::span<const Exact> at, int by = -1) {
    const auto basis = [](int n, int i, const Exact& t) -> Exact {
        if (i < 0 || i > n) return 0;
        return exact_binomial(n, i) * pow(t, i) * pow(Exact(1) - t, n - i);
    };
    std::vector<std::vector<Exact>> values(f.degrees.size());
    for (int k = 0; k < f.unknowns(); ++k)
        for (int i = 0; i <= f.degrees[k]; ++i) {
            const int n = f.degrees[k];
            values[k].push_back(k == by ? n * (basis(n - 1, i - 1, at[k]) - basis(n - 1, i, at[k]))
                                        : basis(n, i, at[k]));
        }
    Exact sum = 0;
    for (std::size_t c = 0; c < f.coefficients.size(); ++c) {
        Exact term = f.coefficients[c];
        std::size_t rest = c;
        for (int k = f.unknowns() - 1; k >= 0; --k) {
            term *= values[k][rest % (f.degrees[k] + 1)];
            rest /= f.degrees[k] + 1;
        }
        sum += term;
    }
    return sum;
}

/// Newton's method in 100 digits on a square system; false if it did not converge.
inline bool exact_newton(std::span<const MultivariatePolynomial> system, std::vector<Exact>& at) {
    const int n = static_cast<int>(at.size());
    for (int step = 0; step < 60; ++step) {
        std::vector<std::vector<Exact>> m(n, std::vector<Exact>(n + 1));
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) m[i][j] = exact_value(system[i], at, j);
            m[i][n] = exact_value(system[i], at);
        }
        for (int c = 0; c < n; ++c) {
            int pivot = c;
            for (int i = c + 1; i < n; ++i)
                if (abs(m[i][c]) > abs(m[pivot][c])) pivot = i;
            if (m[pivot][c] == 0) return false;
            std::swap(m[c], m[pivot]);
            for (int i = 0; i < n; ++i) {
                if (i == c) continue;
                const Exact factor = m[i][c] / m[c][c];
                for (int j = c; j <= n; ++j) m[i][j] -= factor * m[c][j];
            }
        }
        Exact change = 0;
        for (int i = 0; i < n; ++i) {
            const Exact step_i = m[i][n] / m[i][i];
            at[i] -= step_i;
            change = std::max<Exact>(change, abs(step_i));
        }
        if (change < Exact("1e-60")) return true;
        if (change > 1e6) return false;
    }
    return false;
}

/// Random coefficients in [-1, 1].
inline MultivariatePolynomial random_polynomial(std::vector<int> degrees, std::mt19937_64& engine) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    MultivariatePolynomial result;
    result.coefficients.resize(coefficient_count(degrees));
    result.degrees = std::move(degrees);
    for (double& c : result.coefficients) c = number(engine);
    return result;
}

/// The polynomial less its value at a point, rounded to doubles: has a zero within rounding of the point.
inline MultivariatePolynomial vanishing_at(MultivariatePolynomial f, std::span<const double> at) {
    const Interval value = evaluate(f, at);
    for (double& c : f.coefficients) c -= value.middle();
    return f;
}

/// x_k - root in l unknowns.
inline MultivariatePolynomial linear_factor(int l, int k, double root) {
    MultivariatePolynomial result;
    result.degrees.assign(l, 0);
    result.degrees[k] = 1;
    result.coefficients = {-root, 1.0 - root};
    return result;
}

inline MultivariatePolynomial constant(int l, double value) {
    MultivariatePolynomial result;
    result.degrees.assign(l, 0);
    result.coefficients = {value};
    return result;
}

}  // namespace umbilic::support
