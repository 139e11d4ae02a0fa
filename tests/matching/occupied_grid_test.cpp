// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/occupied_grid.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace umbilic {
namespace {

double nearest(const std::vector<Vector3>& points, const Vector3& from) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3& point : points) least = std::min(least, (point - from).norm());
    return least;
}

class Cloud : public testing::TestWithParam<Vector3> {};

TEST_P(Cloud, IsBoundedFromBelowAndNotByMuch) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto within = [&](double factor) {
        return Vector3(factor * uniform(random), factor * uniform(random), factor * uniform(random));
    };
    std::vector<Vector3> points;
    for (int i = 0; i < 300; ++i) points.push_back(within(1.0).cwiseProduct(GetParam()));
    const OccupiedGrid grid(points);
    for (int i = 0; i < 5000; ++i) {
        const Vector3 place = within(2.0);
        const double truth = nearest(points, place), bound = grid.distance_bound(place);
        EXPECT_LE(bound, truth * (1 + 1e-12));
        // A king's step is up to sqrt(3) cells long.
        EXPECT_GE(bound, (truth - 4.0 * grid.cell()) / std::sqrt(3.0));
    }
}

INSTANTIATE_TEST_SUITE_P(OfAnyShape, Cloud,
                         testing::Values(Vector3(1, 1, 1), Vector3(1, 1, 0), Vector3(0, 1, 0), Vector3(0, 0, 0),
                                         Vector3(1, 0.01, 0.3)));

TEST(OccupiedGrid, OfNoPointsIsFarFromEverything) {
    EXPECT_EQ(OccupiedGrid({}).distance_bound(Vector3::Zero()), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace umbilic
