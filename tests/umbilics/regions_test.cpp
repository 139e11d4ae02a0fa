// SPDX-License-Identifier: LGPL-2.1-or-later
// Umbilic regions of known area on surfaces that also have other parts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include <support/surfaces.h>
#include <support/swept_surfaces.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

constexpr double pi = std::numbers::pi;

/// Rough plate of 20 x 20 control points; those in the block [first, last)^2
/// lie in one plane: 3 fewer spans than points are planar, in each direction.
NurbsSurface plate(int first, int last) {
    const NurbsSurface rough = support::rough_bicubic(20, 4);
    std::vector<Vector3> poles = rough.poles();
    for (int i = first; i < last; ++i)
        for (int j = first; j < last; ++j) poles[i * 20 + j].z() = 0.0;
    return NurbsSurface(rough.u_knots(), rough.v_knots(), poles);
}

/// The other way round: a bump on a flat plate.
NurbsSurface bump(int first, int last) {
    const NurbsSurface rough = support::rough_bicubic(20, 4);
    std::vector<Vector3> poles = rough.poles();
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            if (i < first || i >= last || j < first || j >= last) poles[i * 20 + j].z() = 0.0;
    return NurbsSurface(rough.u_knots(), rough.v_knots(), poles);
}

double polygon_area(const std::vector<Vector2>& border) {
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < border.size(); ++k)
        sum += 0.5 * (border[k].x() * border[k + 1].y() - border[k + 1].x() * border[k].y());
    return sum;
}

Face trimmed(const NurbsSurface& surface, const std::vector<Vector2>& corners) {
    Face face = support::model_of({surface}).faces[0];
    TrimmingLoop loop;
    for (std::size_t k = 0; k < corners.size(); ++k)
        loop.push_back({NurbsCurve2(KnotVector::bezier(1), {corners[k], corners[(k + 1) % corners.size()]})});
    face.region = TrimmingRegion(surface.domain(), {loop}, {}, {});
    return face;
}

// Control points of the plates lie at Greville's abscissae, so that a planar
// span away from the border maps to the plane with its parameters, and areas
// are those of the parameters.

TEST(UmbilicRegions, PlanarPartOfAPlate) {
    const SimilarityTransform placed = support::random_similarity(5, 3.0, false);
    for (const bool moved : {false, true}) {
        const NurbsSurface surface = moved ? support::transformed(plate(6, 14), placed) : plate(6, 14);
        const double scale = moved ? 9.0 : 1.0;
        const FaceUmbilics found = find_umbilics(surface);
        ASSERT_EQ(found.regions.size(), 1u);
        const UmbilicRegion& region = found.regions[0];
        EXPECT_EQ(region.kind, UmbilicRegionKind::planar);
        EXPECT_EQ(region.boxes.size(), 25u);
        EXPECT_NEAR(region.area, scale * 25.0 / (17 * 17), 1e-12 * scale);
        EXPECT_LE(region.deviation, 1e-14 * (moved ? 30 : 1));
        ASSERT_EQ(region.boundary.size(), 1u);
        EXPECT_NEAR(std::abs(polygon_area(region.boundary[0].parameters)), 25.0 / (17 * 17), 1e-12);
        const Vector3 normal = moved ? placed.apply_direction(Vector3::UnitZ()) : Vector3::UnitZ();
        EXPECT_NEAR(region.surface.axis.cross(normal).norm(), 0.0, 1e-12);
        EXPECT_TRUE(found.lines.empty());
        EXPECT_LE(found.statistics.boxes, 40000);
        EXPECT_FALSE(found.statistics.budget_exhausted);
    }
}

TEST(UmbilicRegions, PlateAroundABumpHasAHole) {
    const FaceUmbilics found = find_umbilics(bump(8, 12));
    ASSERT_EQ(found.regions.size(), 1u);
    const UmbilicRegion& region = found.regions[0];
    // Seven spans are touched by the four control points, in each direction.
    EXPECT_EQ(region.kind, UmbilicRegionKind::planar);
    EXPECT_NEAR(region.area, 1.0 - 49.0 / (17 * 17), 1e-12);
    ASSERT_EQ(region.boundary.size(), 2u);
    double sum = 0.0;
    for (const RegionBoundary& border : region.boundary) sum += polygon_area(border.parameters);
    EXPECT_NEAR(std::abs(sum), 1.0 - 49.0 / (17 * 17), 1e-12);
}

TEST(UmbilicRegions, LoopsCutThem) {
    // Half of the planar block, cut by the diagonal, and a corner of the plate
    // that holds nothing of it.
    const NurbsSurface surface = plate(6, 14);
    const FaceUmbilics half = find_umbilics(trimmed(surface, {{0.05, 0.05}, {0.95, 0.05}, {0.95, 0.95}}));
    ASSERT_EQ(half.regions.size(), 1u);
    EXPECT_NEAR(half.regions[0].area, 12.5 / (17 * 17), 1e-6);
    ASSERT_EQ(half.regions[0].boundary.size(), 1u);
    EXPECT_NEAR(std::abs(polygon_area(half.regions[0].boundary[0].parameters)), 12.5 / (17 * 17), 1e-6);
    EXPECT_TRUE(find_umbilics(trimmed(surface, {{0.05, 0.05}, {0.2, 0.05}, {0.2, 0.2}})).regions.empty());
}

TEST(UmbilicRegions, DomeOnAPlate) {
    // Profile of a full turn: an arc of a sphere of radius 2 from the pole to 40
    // degrees, a parabola that touches it and the plate, the plate from radius 3
    // to 5.
    const double opening = 40.0 * pi / 180.0, radius = 2.0;
    const Vector2 end(radius * std::sin(opening), radius * std::cos(opening));
    // The tangent at the arc's end meets the plate's plane z = 0.
    const double run = end.y() / std::tan(opening);
    const support::Profile cap = support::arc({0, 0}, radius, pi / 2 - opening, pi / 2);
    std::vector<Vector2> poles(cap.poles.rbegin(), cap.poles.rend());
    std::vector<double> weights(cap.weights.rbegin(), cap.weights.rend());
    poles.front().x() = 0.0;
    const double outer = end.x() + 2 * run;
    for (const Vector2& pole :
         {Vector2(end.x() + run, 0.0), Vector2(outer, 0.0), Vector2(outer + 1.0, 0.0), Vector2(outer + 2.0, 0.0)}) {
        poles.push_back(pole);
        weights.push_back(1.0);
    }
    const support::Profile profile{KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 3}), poles, weights};
    for (const double turn : {2 * pi, pi / 2}) {
        const NurbsSurface surface =
            support::transformed(support::revolved(profile, turn), support::random_similarity(8, 1.0, false));
        const FaceUmbilics found = find_umbilics(surface);
        ASSERT_EQ(found.regions.size(), 2u) << turn;
        for (const UmbilicRegion& region : found.regions) {
            EXPECT_LE(region.deviation, 1e-12);
            if (region.kind == UmbilicRegionKind::spherical) {
                EXPECT_NEAR(region.surface.radius, radius, 1e-10);
                EXPECT_NEAR(region.area, turn * radius * radius * (1 - std::cos(opening)), 1e-9);
            } else {
                EXPECT_EQ(region.kind, UmbilicRegionKind::planar);
                const double inner = outer;
                EXPECT_NEAR(region.area, 0.5 * turn * ((inner + 2) * (inner + 2) - inner * inner), 1e-9);
            }
        }
        EXPECT_NE(found.regions[0].kind, found.regions[1].kind);
        EXPECT_FALSE(found.statistics.budget_exhausted);
        EXPECT_LE(found.statistics.boxes, 50000);
    }
}

TEST(UmbilicRegions, HighOrderFlatPointIsNoRegion) {
    // z = x^8 + y^8: curvature is below rounding far around the origin, but no
    // open set is flat.
    const NurbsSurface surface =
        support::graph_patch(8, 8, [](double x, double y) { return std::pow(x, 8) + std::pow(y, 8); });
    const FaceUmbilics found = find_umbilics(surface);
    EXPECT_TRUE(found.regions.empty());
    EXPECT_FALSE(found.statistics.budget_exhausted);
}

}  // namespace
}  // namespace umbilic
