// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/subdivision.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include <umbilic/bernstein/rounding.h>

namespace umbilic {
namespace {

double value(CoefficientShape shape, const std::vector<double>& c, double u, double v) {
    std::vector<double> bu(shape.p + 1), du(shape.p + 1), bv(shape.q + 1), dv(shape.q + 1);
    bernstein_basis(shape.p, u, bu.data(), du.data());
    bernstein_basis(shape.q, v, bv.data(), dv.data());
    double sum = 0.0;
    for (int i = 0; i <= shape.p; ++i)
        for (int j = 0; j <= shape.q; ++j) sum += bu[i] * bv[j] * c[i * shape.row_length() + j];
    return sum;
}

std::vector<double> random_coefficients(CoefficientShape shape, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    std::vector<double> result(shape.size());
    for (double& c : result) c = number(engine);
    return result;
}

const CoefficientShape shapes[] = {{0, 0}, {1, 0}, {0, 3}, {4, 7}, {12, 13}, {19, 21}};

TEST(Subdivision, HalvesAreThePolynomialOnHalves) {
    for (const CoefficientShape shape : shapes) {
        const std::vector<double> whole = random_coefficients(shape, 3);
        std::vector<double> high_u = whole, low_u(shape.size()), high_v = whole, low_v(shape.size());
        halve_u(shape, high_u.data(), low_u.data());
        halve_v(shape, high_v.data(), low_v.data());
        for (const double s : {0.0, 0.3, 1.0})
            for (const double t : {0.0, 0.6, 1.0}) {
                // Evaluation: 4 (p + q) + 8 roundings on each side, halving p or q, of numbers below 1.
                const double error = 2 * gamma_bound(5 * (shape.p + shape.q) + 8);
                EXPECT_NEAR(value(shape, low_u, s, t), value(shape, whole, s / 2, t), error);
                EXPECT_NEAR(value(shape, high_u, s, t), value(shape, whole, 0.5 + s / 2, t), error);
                EXPECT_NEAR(value(shape, low_v, s, t), value(shape, whole, s, t / 2), error);
                EXPECT_NEAR(value(shape, high_v, s, t), value(shape, whole, s, 0.5 + t / 2), error);
            }
    }
}

TEST(Subdivision, RestrictionKeepsThePolynomialInsideAndOutside) {
    for (const CoefficientShape shape : shapes) {
        const std::vector<double> whole = random_coefficients(shape, 5);
        for (const auto& [low, high] : {std::pair{0.25, 0.75}, std::pair{-0.125, 0.5}, std::pair{0.5, 1.125}}) {
            std::vector<double> u_part = whole, v_part = whole;
            const double u_growth = restrict_u(shape, u_part.data(), low, high);
            const double v_growth = restrict_v(shape, v_part.data(), low, high);
            EXPECT_GE(u_growth, 1.0);
            for (const double s : {0.0, 0.5, 1.0}) {
                const double at = low + s * (high - low);
                const double units = gamma_bound(12 * (shape.p + shape.q) + 8);
                EXPECT_NEAR(value(shape, u_part, s, 0.4), value(shape, whole, at, 0.4), 2 * u_growth * units);
                EXPECT_NEAR(value(shape, v_part, 0.4, s), value(shape, whole, 0.4, at), 2 * v_growth * units);
            }
        }
    }
}

TEST(Subdivision, RestrictionWithinTheUnitSquareDoesNotGrow) {
    const CoefficientShape shape{5, 5};
    std::vector<double> c = random_coefficients(shape, 9);
    EXPECT_EQ(restrict_u(shape, c.data(), 0.25, 0.5), 1.0);
}

TEST(Subdivision, BasisSumsToOneAndItsDerivativesToZero) {
    for (const int n : {0, 1, 2, 7, 21}) {
        std::vector<double> b(n + 1), d(n + 1);
        for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0}) {
            bernstein_basis(n, t, b.data(), d.data());
            double sum = 0.0, slope = 0.0, mean = 0.0, mean_slope = 0.0;
            for (int k = 0; k <= n; ++k) {
                sum += b[k];
                slope += d[k];
                mean += b[k] * k;
                mean_slope += d[k] * k;
            }
            EXPECT_NEAR(sum, 1.0, gamma_bound(4 * n + 4));
            EXPECT_NEAR(slope, 0.0, 2 * n * gamma_bound(4 * n + 4));
            EXPECT_NEAR(mean, n * t, n * gamma_bound(4 * n + 4));
            EXPECT_NEAR(mean_slope, n, 2 * n * n * gamma_bound(4 * n + 4));
        }
    }
}

}  // namespace
}  // namespace umbilic
