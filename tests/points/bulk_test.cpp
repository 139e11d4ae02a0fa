// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <support/clouds.h>
#include <umbilic/points/bulk.h>

namespace umbilic {
namespace {

TEST(Bulk, IsAllOfAnOrdinaryShape) {
    for (const PointCloud& cloud :
         {support::sphere_cloud(500, 2.0, 0.0, 1), support::torus_cloud(500, 3.0, 0.5, 0.0, 2),
          support::graph_cloud(
              500, [](double, double) { return 0.0; }, 0.0, 3)}) {
        const Bulk bulk = bulk_of(cloud.points);
        for (const Vector3& p : cloud.points) EXPECT_TRUE(bulk.holds(p));
    }
    std::vector<Vector3> rod;
    for (int i = 0; i <= 100; ++i) rod.emplace_back(i, 0, 0);
    EXPECT_TRUE(bulk_of(rod).holds(rod.front()) && bulk_of(rod).holds(rod.back()));
}

TEST(Bulk, HardlyFeelsWhatLiesApart) {
    const PointCloud sphere = support::sphere_cloud(1000, 2.0, 0.0, 4);
    for (const double away : {20.0, 1e3, 1e9}) {
        std::vector<Vector3> points = sphere.points;
        for (int i = 0; i < 300; ++i) points.emplace_back(away, away + 1e-3 * i, 0.0);
        const Bulk bulk = bulk_of(points);
        EXPECT_LT(bulk.centre.norm(), 1.5);
        EXPECT_LT(bulk.reach, 1.5 * bulk_radii * 2.0);
        for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(bulk.holds(points[i]), i < 1000);
    }
    EXPECT_FALSE(bulk_of({}).holds(Vector3(1, 0, 0)));
}

}  // namespace
}  // namespace umbilic
