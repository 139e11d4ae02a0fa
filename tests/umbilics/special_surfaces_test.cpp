// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <support/surfaces.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

NurbsSurface quarter_cylinder() {
    const double w = std::numbers::sqrt2 / 2;
    return NurbsSurface(KnotVector::bezier(2), KnotVector::bezier(1),
                        {{1, 0, 0}, {1, 0, 2}, {1, 1, 0}, {1, 1, 2}, {0, 1, 0}, {0, 1, 2}}, {1, 1, w, w, 1, 1});
}

NurbsSurface moved(const NurbsSurface& surface, double scale = 1.0) {
    return support::transformed(surface, support::random_similarity(3, scale, false, 100.0 * scale));
}

void expect_nothing(const FaceUmbilics& found) {
    EXPECT_TRUE(found.umbilics.empty());
    EXPECT_TRUE(found.undecided.empty());
    EXPECT_TRUE(found.lines.empty());
    EXPECT_TRUE(found.regions.empty());
    ASSERT_TRUE(found.certificate.complete) << found.certificate.why;
    EXPECT_TRUE(*found.certificate.complete);
    EXPECT_EQ(found.certificate.boundary_winding, 0.0);
}

void expect_one_region(const FaceUmbilics& found, UmbilicRegionKind kind, double area, double relative) {
    EXPECT_TRUE(found.umbilics.empty());
    EXPECT_TRUE(found.undecided.empty());
    EXPECT_TRUE(found.lines.empty());
    ASSERT_EQ(found.regions.size(), 1u);
    EXPECT_EQ(found.regions[0].kind, kind);
    EXPECT_NEAR(found.regions[0].area, area, relative * area);
    EXPECT_TRUE(found.certificate.complete.value_or(false)) << found.certificate.why;
}

TEST(SpecialSurfaces, PinchPointIsNoUmbilic) {
    // Whitney's umbrella (u, u v, v^2): at the origin A = -2 v, B = 2 u vanish as at an umbilic, but so does r_v.
    const double v[3] = {-1, 0, 1}, squared[3] = {1, -1, 1};
    std::vector<Vector3> poles;
    for (const double u : {-1.0, 1.0})
        for (int j = 0; j < 3; ++j) poles.emplace_back(u, u * v[j], squared[j]);
    const FaceUmbilics found = find_umbilics(NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(2), poles));
    EXPECT_TRUE(found.umbilics.empty());
    ASSERT_EQ(found.undecided.size(), 1u);
    EXPECT_EQ(found.undecided[0].index, 0.5);
    EXPECT_TRUE(found.undecided[0].boxes.front().contains(0.5, 0.5));
}

TEST(SpecialSurfaces, CylinderAndTorusHaveNoUmbilics) {
    for (const double scale : {1e-3, 1.0, 1e4}) {
        expect_nothing(find_umbilics(moved(quarter_cylinder(), scale)));
        expect_nothing(find_umbilics(moved(support::torus_quarter(3, 1), scale)));
    }
    expect_nothing(find_umbilics(quarter_cylinder()));
    expect_nothing(find_umbilics(support::torus_quarter(3, 1)));
}

TEST(SpecialSurfaces, PlanesAreOneRegionHoweverTheyLie) {
    expect_one_region(find_umbilics(support::smooth_bicubic(20, 1, 0.0)), UmbilicRegionKind::planar, 1.0, 1e-12);
    const FaceUmbilics tilted = find_umbilics(moved(support::smooth_bicubic(20, 1, 0.0)));
    expect_one_region(tilted, UmbilicRegionKind::planar, 1.0, 1e-9);
    EXPECT_EQ(tilted.statistics.boxes, 17 * 17);
    expect_one_region(find_umbilics(moved(support::random_surface(2, 3, 6, 5, 1, 0.0, 5.0))), UmbilicRegionKind::planar,
                      1.0, 1e-6);
}

TEST(SpecialSurfaces, SphereOctantIsASphericalRegion) {
    const double area = std::numbers::pi / 2 * 4;
    expect_one_region(find_umbilics(support::ellipsoid_octant(2, 2, 2)), UmbilicRegionKind::spherical, area, 1e-6);
    expect_one_region(find_umbilics(moved(support::ellipsoid_octant(2, 2, 2), 25.4)), UmbilicRegionKind::spherical,
                      area * 25.4 * 25.4, 1e-6);
}

TEST(SpecialSurfaces, PlateWithAPlanarPartDoesNotExplode) {
    // Coplanar control points over a block of 8 x 8 make 5 x 5 planar spans.
    const NurbsSurface rough = support::rough_bicubic(20, 4);
    std::vector<Vector3> poles = rough.poles();
    for (int i = 6; i < 14; ++i)
        for (int j = 6; j < 14; ++j) poles[i * 20 + j].z() = 0.0;
    const FaceUmbilics found = find_umbilics(NurbsSurface(rough.u_knots(), rough.v_knots(), poles));
    ASSERT_EQ(found.regions.size(), 1u);
    EXPECT_EQ(found.regions[0].kind, UmbilicRegionKind::planar);
    EXPECT_NEAR(found.regions[0].area, 25.0 / (17 * 17), 1e-3);
    EXPECT_LE(found.statistics.boxes, 100000);
    EXPECT_FALSE(found.statistics.budget_exhausted);
    EXPECT_GT(found.umbilics.size(), 50u);
}

TEST(SpecialSurfaces, SurfaceOfRevolutionHasLinesAlongParallels) {
    // A barrel whose generatrix has its curvature equal to that of the parallel on some parallels: B vanishes there,
    // A everywhere.
    const double w = std::numbers::sqrt2 / 2;
    const double radius[4] = {1.0, 1.5, 1.5, 0.2}, z[4] = {0.0, 0.5, 1.0, 1.2};
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) {
            poles.emplace_back(i == 2 ? 0.0 : radius[j], i == 0 ? 0.0 : radius[j], z[j]);
            weights.push_back(i == 1 ? w : 1.0);
        }
    const NurbsSurface barrel(KnotVector::bezier(2), KnotVector::bezier(3), poles, weights);
    const FaceUmbilics found = find_umbilics(moved(barrel));
    EXPECT_TRUE(found.umbilics.empty());
    EXPECT_TRUE(found.regions.empty());
    EXPECT_FALSE(found.lines.empty());
    EXPECT_LE(found.statistics.boxes, 20000);
}

TEST(SpecialSurfaces, NearlyNonGenericPairIsResolvedOrCounted) {
    // The cubic of |omega| = 1 plus a quartic term: a star and a lemon or monstar at distance `gap` on the x axis.
    for (const double gap : {1e-1, 1e-2, 1e-3}) {
        const NurbsSurface surface =
            support::graph_patch(4, 4, [=](double x, double y) { return (x * x + y * y) / 2 + x * y * y * (x - gap); });
        const FaceUmbilics found = find_umbilics(surface);
        double index = 0.0;
        for (const Umbilic& umbilic : found.umbilics) index += umbilic.index;
        for (const UndecidedCluster& cluster : found.undecided) {
            ASSERT_TRUE(cluster.index);
            index += *cluster.index;
        }
        EXPECT_TRUE(found.lines.empty());
        if (found.certificate.complete) {
            EXPECT_TRUE(*found.certificate.complete);
            EXPECT_EQ(index, found.certificate.boundary_winding);
        }
        EXPECT_LE(found.statistics.boxes, 20000);
    }
}

TEST(SpecialSurfaces, UmbilicOnAKnotOrASeamIsListedOnce) {
    // The patch of Table 3.1 cut at u = 1/2, on which its monstar lies: two spans of one polynomial.
    const NurbsSurface patch = support::table_3_1_patch();
    std::vector<Vector3> poles;
    std::vector<Vector3> rows[7];
    for (int j = 0; j <= 3; ++j) {
        Vector3 b[4] = {patch.pole(0, j), patch.pole(1, j), patch.pole(2, j), patch.pole(3, j)};
        const Vector3 ab = (b[0] + b[1]) / 2, bc = (b[1] + b[2]) / 2, cd = (b[2] + b[3]) / 2;
        const Vector3 abc = (ab + bc) / 2, bcd = (bc + cd) / 2;
        const Vector3 all[7] = {b[0], ab, abc, (abc + bcd) / 2, bcd, cd, b[3]};
        for (int i = 0; i < 7; ++i) rows[i].push_back(all[i]);
    }
    for (const auto& row : rows) poles.insert(poles.end(), row.begin(), row.end());
    const NurbsSurface cut(KnotVector(3, {0, 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1}), patch.v_knots(), poles);
    const FaceUmbilics found = find_umbilics(cut);
    EXPECT_EQ(found.umbilics.size(), 5u);
    EXPECT_TRUE(found.undecided.empty());

    // Halves exchanged: the old ends u = 0 and u = 1 become different places, the cut a seam in parameters only if the
    // surface closes; here a closed strip made of a patch and its reverse has each umbilic on the seam once.
    const NurbsSurface twice(KnotVector(3, {0, 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1}), patch.v_knots(), [&] {
        std::vector<Vector3> closed;
        for (int i = 3; i < 7; ++i) closed.insert(closed.end(), rows[i].begin(), rows[i].end());
        for (int i = 5; i >= 3; --i) closed.insert(closed.end(), rows[i].begin(), rows[i].end());
        return closed;
    }());
    const FaceUmbilics folded = find_umbilics(twice);
    int on_seam = 0;
    for (const Umbilic& umbilic : folded.umbilics) on_seam += umbilic.at.u < 1e-9 || umbilic.at.u > 1 - 1e-9;
    EXPECT_EQ(on_seam, 1);
}

}  // namespace
}  // namespace umbilic
