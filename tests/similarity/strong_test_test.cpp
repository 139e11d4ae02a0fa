// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <similarity/shapes.h>
#include <support/surfaces.h>
#include <umbilic/similarity/strong_test.h>

namespace umbilic {
namespace {

using namespace test;

constexpr double distance = 1e-3, umbilic_distance = 0.02;

/// A polynomial patch over [-1, 1]^2, without knot lines, with umbilics put where the test wants them.
class StrongTestTest : public testing::Test {
protected:
    Model original_model =
        support::model_of({support::graph_patch(3, 3, [](double x, double y) { return 0.3 * x * x * y - 0.2 * y; })});
    Model suspect_model = original_model;
    SimilarityTransform pose;
    std::vector<Umbilic> on_original, on_suspect;

    Umbilic original_star(double u, double v) const { return star_at(original_model.faces[0], u, v); }
    Umbilic suspect_star(double u, double v) const { return star_at(suspect_model.faces[0], u, v); }

    void place(const SimilarityTransform& suspect_original) {
        suspect_model = support::model_of({support::transformed(original_model.faces[0].surface, suspect_original)});
        pose = suspect_original.inverse();
    }

    StrongTest run(MatchScope scope = MatchScope::global) const {
        PreparedModel a = prepared_on_grid(original_model, 4), b = prepared_on_grid(suspect_model, 4);
        a.features.umbilics[0].umbilics = on_original;
        b.features.umbilics[0].umbilics = on_suspect;
        return strong_test({.prepared = a, .is_original = true}, {.prepared = b, .original_model = pose}, scope,
                           distance, umbilic_distance);
    }
};

TEST_F(StrongTestTest, WithoutUmbilicsItDoesNotApply) {
    const StrongTest t = run();
    EXPECT_FALSE(t.passed.has_value());
    EXPECT_FALSE(t.why.empty());
}

TEST_F(StrongTestTest, MovedScaledMirrored) {
    for (const bool mirrored : {false, true}) {
        place(support::random_similarity(3, 12.0, mirrored));
        on_original = {original_star(0.3, 0.4), original_star(0.7, 0.6)};
        on_suspect = {suspect_star(0.7, 0.6), suspect_star(0.3, 0.4)};
        const StrongTest t = run();
        EXPECT_EQ(t.passed, true) << t.why;
        ASSERT_EQ(t.pairs.size(), 2u);
        EXPECT_EQ(t.pairs[0].original, 0);
        EXPECT_EQ(t.pairs[0].suspect, 1);
        EXPECT_LT(t.pairs[0].distance, 1e-12);
    }
}

TEST_F(StrongTestTest, DistanceIsInTheUnitOfTheOriginal) {
    place({.scale = 100.0});
    on_original = {original_star(0.5, 0.5)};
    on_suspect = {suspect_star(0.505, 0.5)};
    const StrongTest t = run();
    ASSERT_EQ(t.pairs.size(), 1u);
    EXPECT_NEAR(t.pairs[0].distance, 0.01, 1e-3);
}

TEST_F(StrongTestTest, OtherTypeAtTheSamePlaceIsNoPartner) {
    on_original = {original_star(0.5, 0.5)};
    Umbilic lemon = suspect_star(0.5, 0.5);
    lemon.cubic = {1.0, 0.0, 0.8, 0.0};
    lemon.kind = classify(lemon.cubic, 0.0);
    ASSERT_NE(lemon.kind.type, UmbilicType::star);
    on_suspect = {lemon};
    const StrongTest t = run();
    EXPECT_EQ(t.passed, false);
    EXPECT_EQ(t.unmatched_original, std::vector<int>{0});
    EXPECT_EQ(t.unmatched_suspect, std::vector<int>{0});
}

TEST_F(StrongTestTest, TypesBesideTheirDividingCurveAgree) {
    // The forms lie on both sides of |omega| = 1, where stars become monstars.
    Umbilic star = original_star(0.5, 0.5), other = suspect_star(0.5, 0.5);
    star.cubic = {1.0, 0.0, -1e-3, 0.0};
    other.cubic = {1.0, 0.0, 1e-3, 0.0};
    star.kind = classify(star.cubic, 0.0);
    other.kind = classify(other.cubic, 0.0);
    ASSERT_NE(star.kind.type, other.kind.type);
    on_original = {star};
    on_suspect = {other};
    EXPECT_EQ(run().passed, true);
}

TEST_F(StrongTestTest, OneMissingUmbilicFails) {
    on_original = {original_star(0.3, 0.4), original_star(0.7, 0.6)};
    on_suspect = {suspect_star(0.3, 0.4)};
    const StrongTest t = run();
    EXPECT_EQ(t.passed, false);
    EXPECT_EQ(t.unmatched_original, std::vector<int>{1});
    EXPECT_TRUE(t.unmatched_suspect.empty());
}

TEST_F(StrongTestTest, OutsideTheOverlapTheNumberCountsOnlyGlobally) {
    // The suspect is the half u < 1/2 of the same graph.
    suspect_model = support::model_of({support::graph_patch(3, 3, [](double s, double y) {
        const double x = 0.5 * (s - 1.0);
        return 0.3 * x * x * y - 0.2 * y;
    })});
    std::vector<Vector3> poles = suspect_model.faces[0].surface.poles();
    for (Vector3& pole : poles) pole.x() = 0.5 * (pole.x() - 1.0);
    suspect_model = support::model_of({NurbsSurface(KnotVector::bezier(3), KnotVector::bezier(3), poles)});
    on_original = {original_star(0.2, 0.5), original_star(0.8, 0.5)};
    on_suspect = {suspect_star(0.4, 0.5)};
    EXPECT_EQ(run(MatchScope::partial).passed, true);
    EXPECT_EQ(run(MatchScope::global).passed, false);
}

TEST_F(StrongTestTest, BesideBordersAUmbilicNeedsNoPartner) {
    on_original = {original_star(0.5, 0.5), original_star(0.999, 0.5)};
    on_suspect = {suspect_star(0.5, 0.5)};
    EXPECT_EQ(run().passed, true);
    EXPECT_EQ(run().pairs.size(), 1u);
}

TEST_F(StrongTestTest, BesideKnotLinesAUmbilicNeedsNoPartner) {
    original_model = suspect_model = support::model_of({support::smooth_bicubic(5, 3)});  // knot lines at 1/2
    on_original = {original_star(0.25, 0.25), original_star(0.495, 0.25)};
    on_suspect = {suspect_star(0.25, 0.25)};
    EXPECT_EQ(run().passed, true);
    on_original[1] = original_star(0.75, 0.25);
    EXPECT_EQ(run().passed, false);
}

TEST_F(StrongTestTest, TrimmedAwayUncertifiedAndNonGenericOnesDoNotCount) {
    Umbilic outside = original_star(0.6, 0.6), uncertified = original_star(0.7, 0.7), other = original_star(0.4, 0.6);
    outside.containment = Containment::outside;
    uncertified.certified = false;
    other.kind.type = UmbilicType::non_generic;
    on_original = {outside, uncertified, other, original_star(0.3, 0.3)};
    on_suspect = {suspect_star(0.3, 0.3)};
    const StrongTest t = run();
    EXPECT_EQ(t.passed, true);
    ASSERT_EQ(t.pairs.size(), 1u);
    EXPECT_EQ(t.pairs[0].original, 2) << "indices leave out what lies outside the face, and nothing else";
}

TEST_F(StrongTestTest, NearestPairsComeTogether) {
    on_original = {original_star(0.5, 0.5), original_star(0.508, 0.5)};
    on_suspect = {suspect_star(0.507, 0.5), suspect_star(0.5, 0.5)};
    const StrongTest t = run();
    ASSERT_EQ(t.pairs.size(), 2u);
    EXPECT_EQ(t.pairs[0].suspect, 1);
    EXPECT_EQ(t.pairs[1].suspect, 0);
}

}  // namespace
}  // namespace umbilic
