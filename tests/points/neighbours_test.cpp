// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include <support/clouds.h>
#include <umbilic/points/neighbours.h>

namespace umbilic {
namespace {

TEST(Neighbours, AgreeWithLookingAtEveryPoint) {
    const PointCloud cloud = support::sphere_cloud(500, 3.0, 0.3, 1);
    const Neighbours neighbours(cloud.points);
    for (int q = 0; q < 20; ++q) {
        const Vector3 query = 1.1 * cloud.points[17 * q];
        std::vector<double> all;
        for (const Vector3& p : cloud.points) all.push_back((p - query).squaredNorm());
        std::sort(all.begin(), all.end());
        const auto nearest = neighbours.nearest(query, 12);
        ASSERT_EQ(nearest.size(), 12u);
        for (int k = 0; k < 12; ++k) EXPECT_NEAR(nearest[k].squared_distance, all[k], 1e-12);
        const auto within = neighbours.within(query, 1.0);
        EXPECT_EQ(static_cast<long>(within.size()),
                  std::count_if(all.begin(), all.end(), [](double d) { return d <= 1; }));
        EXPECT_TRUE(std::is_sorted(within.begin(), within.end(), [](const Neighbour& a, const Neighbour& b) {
            return a.squared_distance < b.squared_distance;
        }));
    }
    EXPECT_EQ(neighbours.nearest(Vector3::Zero(), 1000).size(), 500u);
    EXPECT_TRUE(neighbours.within(Vector3(100, 0, 0), 1.0).empty());
}

}  // namespace
}  // namespace umbilic
