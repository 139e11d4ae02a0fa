// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

/// Face whose one loop is the rectangle given in surface parameters.
Face trimmed_face(const NurbsSurface& surface, const ParameterBox& box) {
    Face face = support::model_of({surface}).faces[0];
    const Vector2 corner[4] = {
        {box.u.low, box.v.low}, {box.u.high, box.v.low}, {box.u.high, box.v.high}, {box.u.low, box.v.high}};
    TrimmingLoop loop;
    for (int k = 0; k < 4; ++k) loop.push_back({NurbsCurve2(KnotVector::bezier(1), {corner[k], corner[(k + 1) % 4]})});
    face.region = TrimmingRegion(surface.domain(), {loop}, {}, {});
    return face;
}

TEST(FaceUmbilics, ContainmentFollowsTheLoops) {
    const NurbsSurface patch = support::table_3_1_patch();
    // The left border runs through the two stars at u = (3 - sqrt 3) / 6.
    const double left = (3 - std::sqrt(3.0)) / 6;
    const FaceUmbilics found = find_umbilics(trimmed_face(patch, {{left, 0.6}, {0.02, 0.999}}));
    ASSERT_EQ(found.umbilics.size(), 5u);
    EXPECT_EQ(found.face, 1);
    int inside = 0, outside = 0, boundary = 0;
    for (const Umbilic& umbilic : found.umbilics) {
        EXPECT_EQ(umbilic.at.face, 1);
        inside += umbilic.containment == Containment::inside;
        outside += umbilic.containment == Containment::outside;
        boundary += umbilic.containment == Containment::boundary;
    }
    EXPECT_EQ(inside, 1);
    EXPECT_EQ(outside, 2);
    EXPECT_EQ(boundary, 2);
}

TEST(FaceUmbilics, ElementaryKindsAreAnsweredWithoutASearch) {
    Face face = support::model_of({support::smooth_bicubic(5, 1, 0.0)}).faces[0];
    face.kind = SurfaceKind::plane;
    const FaceUmbilics plane = find_umbilics(face);
    ASSERT_EQ(plane.regions.size(), 1u);
    EXPECT_EQ(plane.regions[0].kind, UmbilicRegionKind::planar);
    EXPECT_NEAR(plane.regions[0].area, 1.0, 1e-9);
    EXPECT_EQ(plane.statistics.patches, 0);

    Face torus = support::model_of({support::torus_quarter(3, 1)}).faces[0];
    torus.kind = SurfaceKind::torus;
    const FaceUmbilics none = find_umbilics(torus);
    EXPECT_TRUE(none.umbilics.empty());
    EXPECT_EQ(none.statistics.patches, 0);
    ASSERT_TRUE(none.certificate.complete);
    EXPECT_TRUE(*none.certificate.complete);
}

TEST(FaceUmbilics, RecognisedSurfacesAreAnsweredWithoutASearch) {
    const auto answer = [](const NurbsSurface& surface) {
        return find_umbilics(support::model_of({surface}).faces[0]);
    };
    const FaceUmbilics sphere = answer(support::ellipsoid_octant(2, 2, 2));
    EXPECT_EQ(sphere.statistics.patches, 0);
    ASSERT_TRUE(sphere.recognised);
    EXPECT_TRUE(sphere.recognised->exact);
    ASSERT_EQ(sphere.regions.size(), 1u);
    EXPECT_EQ(sphere.regions[0].kind, UmbilicRegionKind::spherical);
    EXPECT_NEAR(sphere.regions[0].surface.radius, 2.0, 1e-12);
    EXPECT_NEAR(sphere.regions[0].area, 2 * std::numbers::pi, 1e-8);
    EXPECT_LE(sphere.regions[0].deviation, 1e-14);

    const FaceUmbilics torus = answer(support::torus_quarter(3, 1));
    EXPECT_EQ(torus.statistics.patches, 0);
    EXPECT_TRUE(torus.regions.empty());
    ASSERT_TRUE(torus.recognised);
    EXPECT_EQ(torus.recognised->kind, SurfaceKind::torus);
    EXPECT_TRUE(torus.certificate.complete.value_or(false));
}

TEST(FaceUmbilics, NearlyASphereIsARegionUnlessItsRipplesAreWanted) {
    // A sphere of radius 2 with ripples without symmetry.
    const NurbsSurface exact = support::elevated(support::ellipsoid_octant(2, 2, 2), 2, 2).surface;
    for (const double ripple : {1e-9, 1e-6}) {
        std::vector<Vector3> poles = exact.poles();
        for (int i = 1; i < exact.u_pole_count() - 1; ++i)
            for (int j = 1; j < exact.v_pole_count() - 1; ++j)
                poles[i * exact.v_pole_count() + j] += ripple * std::sin(3.0 * i + 5.0 * j) * Vector3(1, 0.5, 0.3);
        const NurbsSurface rippled(exact.u_knots(), exact.v_knots(), poles, exact.weights());
        const Face face = support::model_of({rippled}).faces[0];
        const FaceUmbilics found = find_umbilics(face);
        ASSERT_EQ(found.regions.size(), 1u);
        EXPECT_TRUE(found.umbilics.empty());
        ASSERT_TRUE(found.recognised);
        EXPECT_FALSE(found.recognised->exact);
        EXPECT_GT(found.regions[0].deviation, 0.01 * ripple);
        EXPECT_LT(found.regions[0].deviation, 2 * ripple);

        UmbilicOptions ripples;
        ripples.recognition = 0.0;
        const FaceUmbilics searched = find_umbilics(face, ripples);
        EXPECT_FALSE(searched.recognised);
        EXPECT_GT(searched.statistics.patches, 0);
        EXPECT_LE(searched.statistics.boxes, 20000);
        EXPECT_FALSE(searched.statistics.budget_exhausted);
    }
}

TEST(FaceUmbilics, FacesOfAModelKeepTheirOrder) {
    const Model model =
        support::model_of({support::table_3_1_patch(), support::torus_quarter(3, 1), support::rough_bicubic(6, 2)});
    const std::vector<FaceUmbilics> found = find_umbilics(model);
    ASSERT_EQ(found.size(), 3u);
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].face, model.faces[k].number);
    EXPECT_EQ(found[0].umbilics.size(), 5u);
    EXPECT_TRUE(found[1].umbilics.empty());
}

}  // namespace
}  // namespace umbilic
