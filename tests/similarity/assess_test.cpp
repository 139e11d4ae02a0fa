// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <numbers>

#include <similarity/shapes.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/similarity/assess.h>
#include <umbilic/similarity/thresholds.h>
#include <umbilic/similarity/verdict.h>

namespace umbilic {
namespace {

using namespace test;

constexpr double rounding = 1e-9;

Alignment at(const SimilarityTransform& original_suspect, MatchScope scope = MatchScope::global) {
    Alignment alignment;
    alignment.status = AlignmentStatus::found;
    alignment.method = MatchMethod::given;
    alignment.scope = scope;
    alignment.original_suspect = original_suspect;
    return alignment;
}

struct Outcome {
    Assessment assessment;
    Verdict verdict;
    Answer answer;
};

Outcome outcome(const PreparedModel& original, const PreparedModel& suspect, const Alignment& alignment,
                const ToleranceChoices& choices = {}) {
    Outcome result;
    result.assessment = assess(original, suspect, alignment, choices);
    result.verdict = decide(alignment, result.assessment);
    result.answer = answer(original.model, suspect.model, alignment, result.assessment, result.verdict);
    return result;
}

/// The design as original, other models as suspects.
class AssessTest : public testing::Test {
protected:
    const Model original_model = support::model_of({design()});
    const PreparedModel original = prepared_on_grid(original_model);

    Outcome against(std::vector<NurbsSurface> surfaces, const Alignment& alignment = at({}),
                    const ToleranceChoices& choices = {}) const {
        const Model suspect = support::model_of(std::move(surfaces));
        return outcome(original, prepared_on_grid(suspect), alignment, choices);
    }

    double delta(const Assessment& assessment, const char* name = "distance") const {
        return find_tolerance(assessment.tolerances, name).value;
    }
};

void expect_zero(const DirectedComparison& d, double length_unit, double kappa_unit) {
    EXPECT_LT(d.distance.max, rounding * length_unit);
    EXPECT_LT(d.kappa_max.max, rounding * kappa_unit);
    EXPECT_LT(d.kappa_min.max, rounding * kappa_unit);
    EXPECT_LT(d.direction.max, 1e-6);
    EXPECT_EQ(d.distance.count, 1600);
    EXPECT_EQ(d.coverage, 1.0);
    EXPECT_GT(d.direction.count, 500);
}

TEST_F(AssessTest, ExactCopiesOfAnyPoseSizeHandAndParametrisation) {
    unsigned seed = 0;
    for (const double scale : {0.01, 1.0, 2.703, 1000.0})
        for (const bool mirrored : {false, true})
            for (const bool swapped : {false, true})
                for (const bool reversed : {false, true}) {
                    const SimilarityTransform pose = support::random_similarity(++seed, scale, mirrored);
                    NurbsSurface surface = support::transformed(design(), pose);
                    if (swapped) surface = surface.swapped();
                    if (reversed) surface = surface.u_reversed();
                    const Outcome o = against({surface}, at(pose.inverse()));
                    SCOPED_TRACE(testing::Message() << scale << mirrored << swapped << reversed);
                    expect_zero(o.assessment.suspect_on_original, 1.0, 1.0);
                    expect_zero(o.assessment.original_on_suspect, 1.0, 1.0);
                    // r_u x r_v of a mirror image points to the other side.
                    EXPECT_EQ(o.assessment.flipped, mirrored != (swapped != reversed));
                    EXPECT_EQ(o.verdict.level, Level::intermediate) << "no umbilics were given";
                    EXPECT_EQ(o.answer.kind, mirrored       ? AnswerClass::mirrored
                                             : scale != 1.0 ? AnswerClass::scaled
                                                            : AnswerClass::moved)
                        << o.answer.text;
                }
}

TEST_F(AssessTest, WeightsAreAreasOfTheOriginal) {
    const SimilarityTransform pose = support::random_similarity(7, 50.0, false);
    const Outcome o = against({support::transformed(design(), pose)}, at(pose.inverse()));
    double area = 0.0;
    for (const NodeComparison& node : o.assessment.suspect_on_original.nodes) area += node.weight;
    EXPECT_NEAR(area, original_model.area, 1e-3 * original_model.area);
}

TEST_F(AssessTest, OrientedModelsKeepTheirNormals) {
    // A solid knows its outward side: a copy whose face is turned inside out is not the same.
    Model inside_out = original_model, solid = original_model;
    solid.faces[0].solid = inside_out.faces[0].solid = 0;
    inside_out.faces[0].reversed = true;
    const PreparedModel a = prepared_on_grid(solid), b = prepared_on_grid(inside_out);
    EXPECT_FALSE(assess(a, b, at({})).flipped);
    EXPECT_EQ(outcome(a, b, at({})).verdict.level, Level::weak);
    EXPECT_EQ(outcome(original, b, at({})).verdict.level, Level::intermediate);
}

TEST_F(AssessTest, OffsetHasTheDistanceOfItsOffset) {
    // The graph lifted by h along its normals would be an offset; a plane has an exact one.
    const Model plane = support::model_of({support::graph_patch(1, 1, [](double, double) { return 0.0; })});
    const Model lifted = support::model_of({support::graph_patch(1, 1, [](double, double) { return 0.25; })});
    const Assessment a = assess(prepared_on_grid(plane), prepared_on_grid(lifted), at({}));
    EXPECT_NEAR(a.suspect_on_original.distance.max, 0.25, 1e-12);
    EXPECT_NEAR(a.suspect_on_original.distance.standard_deviation, 0.0, 1e-12);
    for (const NodeComparison& node : a.suspect_on_original.nodes) EXPECT_NEAR(node.signed_distance, 0.25, 1e-12);
    for (const NodeComparison& node : a.original_on_suspect.nodes) EXPECT_NEAR(node.signed_distance, 0.25, 1e-12);
    EXPECT_FALSE(a.weak_passed);
    EXPECT_EQ(a.distance.percent, 0.0);
}

TEST_F(AssessTest, ReapproximatedCopyPassesWeakAndIntermediate) {
    for (const int poles : {12, 14}) {
        const SimilarityTransform pose = support::random_similarity(9, 1.6, false);
        const Outcome o =
            against({support::transformed(reapproximated(design(), 5, poles), pose).swapped()}, at(pose.inverse()));
        const Statistics& distance = o.assessment.suspect_on_original.distance;
        RecordProperty("deviation" + std::to_string(poles), std::to_string(distance.max / original_model.size()));
        EXPECT_GT(distance.max, 2e-5 * original_model.size()) << "the test must re-approximate";
        EXPECT_LT(distance.max, 4e-4 * original_model.size());
        EXPECT_TRUE(o.assessment.weak_passed);
        EXPECT_TRUE(o.assessment.intermediate_passed);
        EXPECT_EQ(o.verdict.level, Level::intermediate);
        EXPECT_EQ(o.answer.kind, AnswerClass::reapproximated) << o.answer.text;
    }
}

TEST_F(AssessTest, LocalRedesignIsPartlyTheSameAndDoesNotPassAsAWhole) {
    const NurbsSurface fine = reapproximated(design(), 3, 9);  // the design itself, in the same spline space
    for (const MatchScope scope : {MatchScope::global, MatchScope::partial})
        for (const double height : {0.02, 0.1}) {
            const Outcome o = against({with_bump(fine, 6, 6, height)}, at({}, scope));
            EXPECT_EQ(o.verdict.level, Level::none);
            EXPECT_EQ(o.answer.kind, AnswerClass::partly) << o.answer.text;
            EXPECT_GT(o.assessment.suspect_on_original.coverage, 0.2);
            EXPECT_LT(o.assessment.suspect_on_original.coverage, 0.8);
            EXPECT_NEAR(o.assessment.distance.percent, 100.0 * o.assessment.suspect_on_original.coverage, 1e-9);
            EXPECT_NE(o.verdict.explanation.find("a part of it"), std::string::npos) << o.verdict.explanation;
        }
}

TEST_F(AssessTest, PieceIsPartOfTheOriginalAndNotItsWhole) {
    const SimilarityTransform pose = support::random_similarity(11, 3.0, false);
    std::vector<NurbsSurface> cut;
    for (const NurbsSurface& piece : pieces(design(), 3, 4)) cut.push_back(support::transformed(piece, pose));
    const Outcome partial = against(cut, at(pose.inverse(), MatchScope::partial));
    EXPECT_EQ(partial.verdict.level, Level::intermediate);
    EXPECT_EQ(partial.answer.kind, AnswerClass::piece) << partial.answer.text;
    EXPECT_NEAR(partial.assessment.original_on_suspect.coverage, 12.0 / 36.0, 0.1);
    ASSERT_EQ(partial.assessment.faces.size(), 12u);
    for (const FaceCoverage& face : partial.assessment.faces) {
        EXPECT_EQ(face.original_face, 1);
        EXPECT_EQ(face.fraction, 1.0);
        EXPECT_EQ(face.level, "intermediate");
    }
    // One-sided, it would pass as a whole.
    EXPECT_EQ(against(cut, at(pose.inverse(), MatchScope::global)).verdict.level, Level::none);
}

TEST_F(AssessTest, OriginalInsideALargerModel) {
    const NurbsSurface addition = support::transformed(support::smooth_bicubic(7, 99), {.translation = {2.0, 0, 0}});
    const Outcome o = against({design(), addition}, at({}, MatchScope::partial));
    EXPECT_EQ(o.verdict.level, Level::intermediate);
    EXPECT_EQ(o.answer.kind, AnswerClass::contains) << o.answer.text;
    EXPECT_EQ(o.assessment.faces[0].level, "intermediate");
    EXPECT_EQ(o.assessment.faces[1].level, "none");
    EXPECT_EQ(o.assessment.faces[1].original_face, 0);
}

TEST_F(AssessTest, CopiedPatchInAForeignModelIsShownByItsFace) {
    std::vector<NurbsSurface> suspect = pieces(design(), 3, 3);
    suspect.push_back(support::transformed(support::smooth_bicubic(7, 99), {.translation = {2.0, 0, 0}}));
    const Outcome o = against(suspect, at({}, MatchScope::partial));
    EXPECT_EQ(o.answer.kind, AnswerClass::partly) << o.answer.text;
    EXPECT_EQ(o.verdict.level, Level::none);
    for (int i = 0; i < 9; ++i) EXPECT_EQ(o.assessment.faces[i].level, "intermediate");
    EXPECT_EQ(o.assessment.faces[9].level, "none");
}

TEST_F(AssessTest, UnrelatedDesignsAreDifferent) {
    for (unsigned seed = 20; seed < 26; ++seed)
        for (const MatchScope scope : {MatchScope::global, MatchScope::partial}) {
            const Outcome o = against({support::smooth_bicubic(9, seed)}, at({}, scope));
            EXPECT_EQ(o.verdict.level, Level::none) << seed;
            EXPECT_EQ(o.answer.kind, AnswerClass::different) << seed << ": " << o.answer.text;
            EXPECT_FALSE(o.assessment.weak_passed);
        }
}

TEST_F(AssessTest, DirectionsAreLeftOutWhereTheyAreNotDefined) {
    const Model sphere = support::model_of({support::ellipsoid_octant(2, 2, 2)});
    const PreparedModel prepared = prepared_on_grid(sphere, 20);
    const Outcome o = outcome(prepared, prepared, at({}));
    EXPECT_EQ(o.assessment.suspect_on_original.direction.count, 0);
    EXPECT_GT(o.assessment.suspect_on_original.kappa_max.count, 300);
    EXPECT_EQ(o.assessment.direction.cells, 0);
    EXPECT_EQ(o.verdict.level, Level::intermediate);
    EXPECT_EQ(o.answer.kind, AnswerClass::same);
}

TEST_F(AssessTest, AnglesBetweenDirectionsAreThoseOfLines) {
    // A cylinder-like graph against itself turned by 90 degrees about z: the directions differ by pi / 2, never more.
    const NurbsSurface trough = support::graph_patch(2, 2, [](double x, double) { return x * x; });
    const NurbsSurface turned = support::graph_patch(2, 2, [](double, double y) { return y * y; });
    const Model a = support::model_of({trough}), b = support::model_of({turned});
    const Assessment assessment = assess(prepared_on_grid(a), prepared_on_grid(b), at({}));
    for (const NodeComparison& node : assessment.suspect_on_original.nodes)
        EXPECT_LE(node.direction.value_or(0.0), std::numbers::pi / 2);
    EXPECT_GT(assessment.suspect_on_original.direction.max, 1.2);
}

TEST_F(AssessTest, CurvatureBesideAKnotWhereItJumpsDoesNotFail) {
    // A quadratic spline has a curvature jump at its knots; its copy is shifted by far less than the tolerance, so that
    // feet fall on the other side.
    const NurbsSurface quadratic = support::random_surface(2, 2, 7, 7, 5, 0.2);
    const Model model = support::model_of({quadratic});
    const double shift = 0.5 * tolerance::relative_distance * model.size();
    const Model shifted =
        support::model_of({support::transformed(quadratic, {.translation = Vector3(shift, shift, 0.0) / 2})});
    const Assessment a = assess(prepared_on_grid(model, 50), prepared_on_grid(shifted, 50), at({}));
    EXPECT_TRUE(a.intermediate_passed);
    EXPECT_LT(a.suspect_on_original.kappa_max.max, delta(a, "kappa"));
}

TEST_F(AssessTest, ChoicesOfTheUserAreUsedAndShown) {
    const Outcome o = against({support::transformed(design(), {.translation = {0, 0, 0.01}})}, at({}),
                              {.distance = 0.02, .kappa = 1.0, .direction = 0.2, .umbilic_distance = 0.1, .cell = 0.1});
    EXPECT_TRUE(o.assessment.weak_passed);
    EXPECT_EQ(o.assessment.distance.tolerance, 0.02);
    EXPECT_EQ(o.assessment.cell, 0.1);
    EXPECT_EQ(o.assessment.distance.cells, 100);
    for (const char* name : {"distance", "kappa", "direction", "umbilic-distance", "cell"})
        EXPECT_EQ(find_tolerance(o.assessment.tolerances, name).origin, ToleranceOrigin::user) << name;
    EXPECT_FALSE(against({support::transformed(design(), {.translation = {0, 0, 0.01}})}).assessment.weak_passed);
}

TEST_F(AssessTest, SameInputGivesTheSameNumbers) {
    const SimilarityTransform pose = support::random_similarity(13, 1.6, true);
    const std::vector<NurbsSurface> suspect = {support::transformed(reapproximated(design(), 4, 13), pose)};
    const Outcome a = against(suspect, at(pose.inverse())), b = against(suspect, at(pose.inverse()));
    EXPECT_EQ(a.assessment.suspect_on_original.distance.mean, b.assessment.suspect_on_original.distance.mean);
    EXPECT_EQ(a.assessment.original_on_suspect.kappa_min.standard_deviation,
              b.assessment.original_on_suspect.kappa_min.standard_deviation);
    EXPECT_EQ(a.verdict.explanation, b.verdict.explanation);
    EXPECT_EQ(a.answer.text, b.answer.text);
}

TEST_F(AssessTest, CancelIsHeard) {
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(assess(original, original, at({}), {}, progress), Cancelled);
}

}  // namespace
}  // namespace umbilic
