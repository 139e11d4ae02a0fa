// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/tensor_polynomial.h>

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

namespace umbilic {
namespace {

using Exact = boost::multiprecision::cpp_rational;

Exact binomial(int n, int k) {
    Exact result = 1;
    for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
    return result;
}

/// Exact twin: coefficients in the scaled basis.
struct ExactPolynomial {
    int m = 0, n = 0;
    std::vector<Exact> scaled;

    static ExactPolynomial of(const TensorPolynomial& p) {
        ExactPolynomial result{p.u_degree, p.v_degree, {}};
        for (const double c : p.scaled) result.scaled.emplace_back(c);
        return result;
    }
    const Exact& at(int i, int j) const { return scaled[i * (n + 1) + j]; }
};

ExactPolynomial zero(int m, int n) {
    return {m, n, std::vector<Exact>((m + 1) * (n + 1))};
}

void add_product(const ExactPolynomial& a, const ExactPolynomial& b, int sign, ExactPolynomial& result) {
    for (int i = 0; i <= a.m; ++i)
        for (int j = 0; j <= a.n; ++j)
            for (int k = 0; k <= b.m; ++k)
                for (int l = 0; l <= b.n; ++l)
                    result.scaled[(i + k) * (result.n + 1) + j + l] += sign * a.at(i, j) * b.at(k, l);
}

void expect_within_bound(const TensorPolynomial& computed, const ExactPolynomial& exact) {
    ASSERT_EQ(computed.u_degree, exact.m);
    ASSERT_EQ(computed.v_degree, exact.n);
    std::vector<double> coefficients(computed.scaled.size());
    const CoefficientBound bound = computed.bernstein_coefficients(coefficients);
    const Interval hull = computed.coefficient_hull();
    for (int i = 0; i <= exact.m; ++i)
        for (int j = 0; j <= exact.n; ++j) {
            const int at = i * (exact.n + 1) + j;
            const Exact b = exact.at(i, j) / (binomial(exact.m, i) * binomial(exact.n, j));
            const Exact stored = Exact(computed.scaled[at]) / (binomial(exact.m, i) * binomial(exact.n, j));
            ASSERT_LE(abs(stored - b), Exact(computed.bound.rounding)) << i << ' ' << j;
            ASSERT_LE(abs(stored), Exact(computed.magnitude));
            ASSERT_LE(abs(Exact(coefficients[at]) - b), Exact(bound.rounding));
            ASSERT_GE(b, Exact(hull.low));
            ASSERT_LE(b, Exact(hull.high));
        }
    EXPECT_GE(computed.bound.input, computed.bound.rounding);
}

TensorPolynomial random_polynomial(int m, int n, std::mt19937& engine) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    TensorPolynomial result;
    result.set_zero(m, n);
    for (double& c : result.scaled) c = number(engine);
    result.measure();
    return result;
}

TEST(TensorPolynomial, ProductsStayWithinTheirBound) {
    std::mt19937 engine(1);
    for (int k = 0; k < 20; ++k) {
        const TensorPolynomial a = random_polynomial(4, 6, engine), b = random_polynomial(7, 6, engine);
        const TensorPolynomial c = random_polynomial(5, 5, engine), d = random_polynomial(6, 7, engine);
        const std::array<ProductTerm, 2> terms = {{{&a, &b, 1.0}, {&c, &d, -1.0}}};
        TensorPolynomial result;
        sum_of_products(terms, result);
        ExactPolynomial exact = zero(11, 12);
        add_product(ExactPolynomial::of(a), ExactPolynomial::of(b), 1, exact);
        add_product(ExactPolynomial::of(c), ExactPolynomial::of(d), -1, exact);
        expect_within_bound(result, exact);
    }
}

TEST(TensorPolynomial, UnequalProductsAreRaisedAndZerosHaveNoDegree) {
    std::mt19937 engine(7);
    TensorPolynomial nothing;
    nothing.set_zero(30, 30);
    for (int k = 0; k < 20; ++k) {
        const TensorPolynomial a = random_polynomial(4, 6, engine), b = random_polynomial(3, 2, engine);
        const TensorPolynomial c = random_polynomial(2, 2, engine), d = random_polynomial(3, 3, engine);
        const std::array<ProductTerm, 3> terms = {{{&a, &b, 1.0}, {&c, &d, -1.0}, {&c, &nothing, 1.0}}};
        TensorPolynomial result;
        sum_of_unequal_products(terms, result);
        // (u + (1 - u))^2 (v + (1 - v))^3 has binomials as its scaled coefficients.
        ExactPolynomial one = zero(2, 3), low = zero(5, 5), exact = zero(7, 8);
        for (int i = 0; i <= 2; ++i)
            for (int j = 0; j <= 3; ++j) one.scaled[i * 4 + j] = binomial(2, i) * binomial(3, j);
        add_product(ExactPolynomial::of(a), ExactPolynomial::of(b), 1, exact);
        add_product(ExactPolynomial::of(c), ExactPolynomial::of(d), -1, low);
        add_product(low, one, 1, exact);
        expect_within_bound(result, exact);
    }
    const ProductTerm zero_terms[] = {{&nothing, &nothing}};
    TensorPolynomial result;
    sum_of_unequal_products(zero_terms, result);
    EXPECT_EQ(result.magnitude, 0.0);
}

TEST(TensorPolynomial, BoundsOfFactorsEnterTheProduct) {
    std::mt19937 engine(2);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int k = 0; k < 20; ++k) {
        const TensorPolynomial exact_a = random_polynomial(2, 3, engine), exact_b = random_polynomial(3, 1, engine);
        TensorPolynomial a = exact_a, b = exact_b;
        // Coefficients moved by up to their stated bound; binomials are at least 1.
        a.bound = {1e-3, 2e-3};
        b.bound = {1e-4, 1e-4};
        for (double& c : a.scaled) c += a.bound.rounding * number(engine) * 0.999;
        for (double& c : b.scaled) c += b.bound.rounding * number(engine) * 0.999;
        a.measure();
        b.measure();
        const std::array<ProductTerm, 1> terms = {{{&a, &b, 1.0}}};
        TensorPolynomial result;
        sum_of_products(terms, result);
        ExactPolynomial exact = zero(5, 4);
        add_product(ExactPolynomial::of(exact_a), ExactPolynomial::of(exact_b), 1, exact);
        expect_within_bound(result, exact);
    }
}

TEST(TensorPolynomial, ElevationStaysWithinItsBound) {
    std::mt19937 engine(3);
    const TensorPolynomial a = random_polynomial(3, 5, engine);
    TensorPolynomial raised = a;
    elevate(raised, 2, 3);
    TensorPolynomial one;
    one.set_zero(2, 3);
    ExactPolynomial ones = zero(2, 3);
    for (int i = 0; i <= 2; ++i)
        for (int j = 0; j <= 3; ++j) ones.scaled[i * 4 + j] = binomial(2, i) * binomial(3, j);
    ExactPolynomial exact = zero(5, 8);
    add_product(ExactPolynomial::of(a), ones, 1, exact);
    expect_within_bound(raised, exact);
}

TEST(TensorPolynomial, DerivativesStayWithinTheirBound) {
    std::mt19937 engine(4);
    const TensorPolynomial a = random_polynomial(4, 3, engine);
    const ExactPolynomial e = ExactPolynomial::of(a);
    TensorPolynomial u, v;
    derivative_u(a, u);
    derivative_v(a, v);
    ExactPolynomial exact_u = zero(3, 3), exact_v = zero(4, 2);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j <= 3; ++j) exact_u.scaled[i * 4 + j] = (i + 1) * e.at(i + 1, j) - (4 - i) * e.at(i, j);
    for (int i = 0; i <= 4; ++i)
        for (int j = 0; j < 3; ++j) exact_v.scaled[i * 3 + j] = (j + 1) * e.at(i, j + 1) - (3 - j) * e.at(i, j);
    expect_within_bound(u, exact_u);
    expect_within_bound(v, exact_v);

    const TensorPolynomial constant = random_polynomial(0, 2, engine);
    derivative_u(constant, u);
    EXPECT_EQ(u.u_degree, 0);
    EXPECT_EQ(u.magnitude, 0.0);
}

TEST(TensorPolynomial, SumStaysWithinItsBound) {
    std::mt19937 engine(5);
    const TensorPolynomial a = random_polynomial(4, 3, engine), b = random_polynomial(4, 3, engine);
    TensorPolynomial result;
    add(a, b, result);
    ExactPolynomial exact = ExactPolynomial::of(a);
    for (std::size_t k = 0; k < exact.scaled.size(); ++k) exact.scaled[k] += Exact(b.scaled[k]);
    expect_within_bound(result, exact);
}

TEST(TensorPolynomial, DivisionUndoesAFactorThatVanishesOnAnEdge) {
    std::mt19937 engine(6);
    const TensorPolynomial a = random_polynomial(3, 4, engine);
    for (const PatchEdge edge : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high}) {
        TensorPolynomial factor, product;
        const bool across_u = edge == PatchEdge::u_low || edge == PatchEdge::u_high;
        factor.set_zero(across_u ? 1 : 0, across_u ? 0 : 1);
        factor.scaled[edge == PatchEdge::u_low || edge == PatchEdge::v_low ? 1 : 0] = 1.0;
        factor.measure();
        const std::array<ProductTerm, 1> terms = {{{&a, &factor, 1.0}}};
        sum_of_products(terms, product);
        EXPECT_EQ(edge_magnitude(product, edge), 0.0);
        divide_by_edge(product, edge);
        expect_within_bound(product, ExactPolynomial::of(a));
        EXPECT_GT(edge_magnitude(product, edge), 0.0);
    }
}

}  // namespace
}  // namespace umbilic
