// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <support/surfaces.h>
#include <umbilic/nurbs/area.h>

namespace umbilic {
namespace {

TEST(SurfaceArea, ClosedForms) {
    const double pi = std::numbers::pi;
    // Octant of a sphere, with its collapsed edge; a quarter of a quarter of a torus, on its outer side: both by
    // Pappus.
    EXPECT_NEAR(surface_area(support::ellipsoid_octant(2, 2, 2)), pi / 2 * 4, 1e-8);
    EXPECT_NEAR(surface_area(support::torus_quarter(3, 1)), pi / 2 * (3 * pi / 2 + 1), 1e-8);
    EXPECT_NEAR(surface_area(support::graph_patch(1, 1, [](double x, double) { return 2 * x; })), 4 * std::sqrt(5.0),
                1e-12);
}

TEST(SurfaceArea, GrowsWithTheSquareOfTheScale) {
    const NurbsSurface surface = support::random_surface(3, 4, 7, 6, 5, 0.4, 5.0);
    const NurbsSurface moved = support::transformed(surface, support::random_similarity(2, 3.0, true));
    EXPECT_NEAR(surface_area(moved), 9 * surface_area(surface), 1e-8 * surface_area(moved));
}

}  // namespace
}  // namespace umbilic
