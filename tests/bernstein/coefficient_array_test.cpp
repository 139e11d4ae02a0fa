// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/coefficient_array.h>

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace umbilic {
namespace {

std::vector<double> random_coefficients(CoefficientShape shape, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<double> result(shape.size());
    for (double& c : result) c = uniform(random);
    return result;
}

/// De Casteljau's algorithm in v, then in u.
double casteljau(CoefficientShape shape, const std::vector<double>& c, double u, double v) {
    const auto along = [](std::vector<double> points, double t) {
        for (std::size_t n = points.size() - 1; n > 0; --n)
            for (std::size_t k = 0; k < n; ++k) points[k] = (1 - t) * points[k] + t * points[k + 1];
        return points.front();
    };
    std::vector<double> column;
    for (int i = 0; i <= shape.p; ++i)
        column.push_back(along({c.begin() + i * shape.row_length(), c.begin() + (i + 1) * shape.row_length()}, v));
    return along(column, u);
}

TEST(CoefficientArray, ValuesAndSlopesAreThoseOfThePolynomial) {
    BernsteinPoint point;
    for (const CoefficientShape shape : {CoefficientShape{3, 3}, {0, 4}, {5, 0}, {14, 12}, {0, 0}}) {
        const std::vector<double> c = random_coefficients(shape, 3 + shape.p);
        const std::array<Interval, 2> hulls = difference_hulls(shape, c.data());
        Vector2 sum = Vector2::Zero();
        constexpr int n = 200;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const double u = (i + 0.5) / n, v = (j + 0.5) / n;
                point.move_to(shape, {u, v});
                Vector2 gradient;
                const double value = point.value(c.data(), &gradient);
                EXPECT_EQ(value, point.value(c.data()));
                sum += gradient / (n * n);
                EXPECT_LE(shape.p * hulls[0].low, gradient.x() + 1e-12);
                EXPECT_GE(shape.p * hulls[0].high, gradient.x() - 1e-12);
                EXPECT_LE(shape.q * hulls[1].low, gradient.y() + 1e-12);
                EXPECT_GE(shape.q * hulls[1].high, gradient.y() - 1e-12);
                if ((i * n + j) % 997 != 0) continue;
                EXPECT_NEAR(value, casteljau(shape, c, u, v), 1e-13);
                constexpr double h = 1e-6;
                EXPECT_NEAR(gradient.x(), (casteljau(shape, c, u + h, v) - casteljau(shape, c, u - h, v)) / (2 * h),
                            1e-7);
                EXPECT_NEAR(gradient.y(), (casteljau(shape, c, u, v + h) - casteljau(shape, c, u, v - h)) / (2 * h),
                            1e-7);
            }
        // The midpoint rule on 200 x 200 cells.
        EXPECT_LT((sum - mean_derivative(shape, c.data())).norm(), 1e-2 * (1 + shape.p + shape.q));
    }
}

TEST(CoefficientArray, HullsAndVariationsOfAKnownArray) {
    // Rows along u: (0, 1, 3), (2, 2, 2).
    const std::vector<double> c = {0, 1, 3, 2, 2, 2};
    const CoefficientShape shape{1, 2};
    const std::array<Interval, 2> hulls = difference_hulls(shape, c.data());
    EXPECT_EQ(hulls[0].low, -1.0);
    EXPECT_EQ(hulls[0].high, 2.0);
    EXPECT_EQ(hulls[1].low, 0.0);
    EXPECT_EQ(hulls[1].high, 2.0);
    EXPECT_EQ(mean_variation(shape, c.data()), Vector2(4.0 / 3.0, 1.5));
    EXPECT_LT((mean_derivative(shape, c.data()) - Vector2(2.0 / 3.0, 1.5)).norm(), 1e-15);
}

}  // namespace
}  // namespace umbilic
