// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/degree_reduction.h>

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace umbilic {
namespace {

double value(CoefficientShape shape, const std::vector<double>& c, double u, double v) {
    std::vector<double> bu(shape.p + 1), bv(shape.q + 1), unused(std::max(shape.p, shape.q) + 1);
    bernstein_basis(shape.p, u, bu.data(), unused.data());
    bernstein_basis(shape.q, v, bv.data(), unused.data());
    double result = 0.0;
    for (int i = 0; i <= shape.p; ++i)
        for (int j = 0; j <= shape.q; ++j) result += bu[i] * bv[j] * c[i * shape.row_length() + j];
    return result;
}

TEST(DegreeReduction, DifferenceStaysWithinItsBound) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const CoefficientShape high{14, 11}, low{6, 4};
    DegreeReduction reduction(high, low);
    for (int k = 0; k < 30; ++k) {
        std::vector<double> c(high.size()), reduced(low.size());
        for (double& b : c) b = unit(random) - 0.5;
        // On a smaller part the reduction is better.
        const double side = std::pow(0.5, k % 5);
        restrict_u(high, c.data(), 0.0, side);
        restrict_v(high, c.data(), 0.0, side);
        const double bound = reduction.reduce(c.data(), reduced.data());
        double largest = 0.0;
        for (int i = 0; i < 400; ++i) {
            const double u = unit(random), v = unit(random);
            largest = std::max(largest, std::abs(value(high, c, u, v) - value(low, reduced, u, v)));
        }
        EXPECT_LE(largest, bound);
        EXPECT_LE(bound, 30 * largest + 1e-13);
    }
}

TEST(DegreeReduction, KeepsPolynomialsOfTheLowerDegree) {
    const CoefficientShape high{9, 7}, low{5, 7};
    DegreeReduction reduction(high, low);
    // u^5 (1 - v)^7 at degree (9, 7): the coefficients of u^5 are C(i, 5) / C(9, 5).
    std::vector<double> c(high.size(), 0.0), reduced(low.size());
    const double share[10] = {0, 0, 0, 0, 0, 1 / 126.0, 6 / 126.0, 21 / 126.0, 56 / 126.0, 1};
    for (int i = 0; i <= 9; ++i) c[i * 8] = share[i];
    EXPECT_LE(reduction.reduce(c.data(), reduced.data()), 1e-13);
    for (int at = 0; at < low.size(); ++at) EXPECT_NEAR(reduced[at], at == 5 * 8 ? 1.0 : 0.0, 1e-13);
}

}  // namespace
}  // namespace umbilic
