// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/multivariate_polynomial.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include <bernstein/planted_systems.h>
#include <umbilic/core/errors.h>

namespace umbilic {
namespace {

using support::Exact;
using support::exact_value;

std::vector<int> random_degrees(int unknowns, int most, std::mt19937_64& engine) {
    std::vector<int> result;
    for (int k = 0; k < unknowns; ++k) result.push_back(std::uniform_int_distribution<int>(0, most)(engine));
    return result;
}

std::vector<double> random_point(int unknowns, std::mt19937_64& engine, double low = 0.0, double high = 1.0) {
    std::vector<double> result;
    for (int k = 0; k < unknowns; ++k) result.push_back(std::uniform_real_distribution<double>(low, high)(engine));
    return result;
}

std::vector<Exact> exact(const std::vector<double>& at) {
    return {at.begin(), at.end()};
}

/// The exact value of what a polynomial stands for at a point lies within the polynomial's own value and error.
void expect_encloses(const MultivariatePolynomial& computed, const std::vector<double>& at, const Exact& value) {
    ASSERT_NO_THROW(check(computed, "computed"));
    const Exact stored = exact_value(computed, exact(at));
    // A value on [0, 1]^l is a convex combination of coefficients.
    ASSERT_LE(abs(stored - value), Exact(computed.error));
    const Interval enclosure = evaluate(computed, at);
    ASSERT_GE(value, Exact(enclosure.low));
    ASSERT_LE(value, Exact(enclosure.high));
    const Interval range = coefficient_range(computed);
    ASSERT_GE(value, Exact(range.low));
    ASSERT_LE(value, Exact(range.high));
}

TEST(MultivariatePolynomial, ArithmeticStaysWithinItsError) {
    std::mt19937_64 engine(3);
    for (int k = 0; k < 300; ++k) {
        const int unknowns = 1 + k % 4, most = unknowns < 3 ? 7 : 3;
        const MultivariatePolynomial a = support::random_polynomial(random_degrees(unknowns, most, engine), engine);
        const MultivariatePolynomial b = support::random_polynomial(random_degrees(unknowns, most, engine), engine);
        const std::vector<double> at = random_point(unknowns, engine);
        const Exact va = exact_value(a, exact(at)), vb = exact_value(b, exact(at));
        expect_encloses(a + b, at, va + vb);
        expect_encloses(a - b, at, va - vb);
        expect_encloses(a * b, at, va * vb);
        expect_encloses(a * b - 0.1 * a, at, va * vb - Exact(0.1) * va);
        expect_encloses((a + b) * (a - b), at, va * va - vb * vb);
        for (int j = 0; j < unknowns; ++j) expect_encloses(derivative(a, j), at, exact_value(a, exact(at), j));
        std::vector<int> higher = a.degrees;
        for (int& degree : higher) degree += 3;
        const MultivariatePolynomial raised = elevated(a, higher);
        EXPECT_EQ(raised.degrees, higher);
        expect_encloses(raised, at, va);
    }
}

TEST(MultivariatePolynomial, ErrorsOfOperandsEnterResults) {
    std::mt19937_64 engine(4);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int k = 0; k < 100; ++k) {
        const MultivariatePolynomial exact_a = support::random_polynomial({2, 3}, engine);
        const MultivariatePolynomial exact_b = support::random_polynomial({3, 1}, engine);
        MultivariatePolynomial a = exact_a, b = exact_b;
        a.error = 1e-3;
        b.error = 1e-5;
        for (double& c : a.coefficients) c += a.error * number(engine) * 0.999;
        for (double& c : b.coefficients) c += b.error * number(engine) * 0.999;
        const std::vector<double> at = random_point(2, engine);
        const Exact va = exact_value(exact_a, exact(at)), vb = exact_value(exact_b, exact(at));
        expect_encloses(a, at, va);
        expect_encloses(a * b, at, va * vb);
        expect_encloses(a + b, at, va + vb);
        expect_encloses(derivative(a, 1), at, exact_value(exact_a, exact(at), 1));
        expect_encloses(elevated(a, std::vector<int>{4, 4}), at, va);
        const std::vector<Interval> box = {{0.25, 0.75}, {0.5, 0.625}};
        const std::vector<double> inside = {0.25 + 0.5 * at[0], 0.5 + 0.125 * at[1]};
        expect_encloses(restricted(a, box), at, exact_value(exact_a, exact(inside)));
    }
}

TEST(MultivariatePolynomial, RestrictionIsThePolynomialOnTheBox) {
    std::mt19937_64 engine(5);
    for (int k = 0; k < 200; ++k) {
        const int unknowns = 1 + k % 3;
        const MultivariatePolynomial a = support::random_polynomial(random_degrees(unknowns, 8, engine), engine);
        std::vector<Interval> box;
        const std::vector<double> at = random_point(unknowns, engine), ends = random_point(2 * unknowns, engine);
        std::vector<Exact> inside;
        for (int j = 0; j < unknowns; ++j) {
            // Wide and narrow ones, and some that reach out of [0, 1].
            const double length = std::ldexp(ends[j], -(k % 30));
            const double low = k % 7 == 0 ? -0.05 * length : ends[unknowns + j] * (1.0 - length);
            box.emplace_back(low, low + length);
            inside.push_back(Exact(low) + Exact(at[j]) * (Exact(box[j].high) - Exact(low)));
        }
        expect_encloses(restricted(a, box), at, exact_value(a, inside));
    }
}

TEST(MultivariatePolynomial, ValuesOutsideTheUnitBoxAreEnclosed) {
    std::mt19937_64 engine(6);
    for (int k = 0; k < 100; ++k) {
        const MultivariatePolynomial a = support::random_polynomial({5, 4}, engine);
        const std::vector<double> at = random_point(2, engine, -1.0, 2.0);
        const Interval enclosure = evaluate(a, at);
        const Exact value = exact_value(a, exact(at));
        EXPECT_GE(value, Exact(enclosure.low));
        EXPECT_LE(value, Exact(enclosure.high));
        EXPECT_LT(enclosure.high - enclosure.low, 1e-9);
    }
}

TEST(MultivariatePolynomial, DerivativeOfAConstantIsZero) {
    MultivariatePolynomial c = support::constant(2, 3.0);
    const MultivariatePolynomial d = derivative(c, 1);
    EXPECT_EQ(d.degrees, (std::vector<int>{0, 0}));
    EXPECT_EQ(d.coefficients, std::vector<double>{0.0});
    EXPECT_EQ(d.error, 0.0);
}

TEST(MultivariatePolynomial, WhatIsNoPolynomialIsRefused) {
    EXPECT_THROW(check({}, "it"), InvalidInput);
    EXPECT_THROW(check({{1}, {1.0}, 0.0}, "it"), InvalidInput);
    EXPECT_THROW(check({{-1}, {}, 0.0}, "it"), InvalidInput);
    EXPECT_THROW(check({{1}, {1.0, std::numeric_limits<double>::quiet_NaN()}, 0.0}, "it"), InvalidInput);
    EXPECT_THROW(check({{1}, {1.0, std::numeric_limits<double>::infinity()}, 0.0}, "it"), InvalidInput);
    EXPECT_THROW(check({{1}, {1.0, 2.0}, -1.0}, "it"), InvalidInput);
    EXPECT_THROW(check({{1}, {1.0, 2.0}, std::numeric_limits<double>::quiet_NaN()}, "it"), InvalidInput);
    EXPECT_NO_THROW(check({{1}, {1.0, 2.0}, 0.0}, "it"));
    const MultivariatePolynomial one = support::constant(1, 1.0), two = support::constant(2, 1.0);
    EXPECT_THROW(one + two, InvalidInput);
    EXPECT_THROW(one * two, InvalidInput);
    EXPECT_THROW(evaluate(one, std::vector<double>{0.0, 1.0}), InvalidInput);
    EXPECT_THROW(restricted(one, std::vector<Interval>{{0.5, 0.5}}), InvalidInput);
    EXPECT_THROW(restricted(one, std::vector<Interval>{{-2.0, -1.0}}), InvalidInput);
    MultivariatePolynomial steep;
    steep.degrees = {150};
    steep.coefficients.assign(151, 1.0);
    EXPECT_THROW(steep * steep, InvalidInput);
}

}  // namespace
}  // namespace umbilic
