// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <umbilic/core/errors.h>
#include <umbilic/similarity/thresholds.h>
#include <umbilic/similarity/verdict.h>

namespace umbilic {
namespace {

constexpr double size = 33.3;

Statistics alike(double tolerance, double factor = 0.5) {
    return {.max = factor * tolerance, .mean = 0.5 * factor * tolerance, .standard_deviation = 0.0, .count = 400};
}

/// An assessment in which everything stays within half its tolerance and three umbilics coincide.
Assessment passing() {
    Assessment a;
    a.tolerances = derive_tolerances(size, 0.0);
    for (DirectedComparison* d : {&a.suspect_on_original, &a.original_on_suspect}) {
        d->distance = alike(find_tolerance(a.tolerances, "distance").value);
        d->kappa_max = d->kappa_min = alike(find_tolerance(a.tolerances, "kappa").value);
        d->direction = alike(find_tolerance(a.tolerances, "direction").value);
        d->coverage = d->overlap = 1.0;
    }
    a.strong.passed = true;
    a.strong.pairs = {{0, 0, UmbilicType::star, 0.001}, {1, 2, UmbilicType::star, 0.002}};
    return a;
}

Alignment pose() {
    Alignment alignment;
    alignment.status = AlignmentStatus::found;
    alignment.method = MatchMethod::curvature;
    return alignment;
}

std::vector<bool> answers(const Decision& decision) {
    std::vector<bool> result;
    for (const DecisionStep& step : decision.path) result.push_back(step.answer);
    return result;
}

using Path = std::vector<bool>;

// Fig. 5-1 -----------------------------------------------------------------------------------------------------------

TEST(DecideByMaxima, EverythingPassed) {
    const Decision d = decide_by_maxima(passing());
    EXPECT_EQ(d.level, Level::strong);
    // distance, comparable, two curvatures and the direction, umbilics exist, umbilics agree
    EXPECT_EQ(answers(d), Path(7, true));
    EXPECT_NE(d.path[0].question.find("mm"), std::string::npos);
}

TEST(DecideByMaxima, WeakTestFailsAndIsRetriedWithALargerTolerance) {
    Assessment a = passing();
    a.suspect_on_original.distance.max = 2.0 * find_tolerance(a.tolerances, "distance").value;
    const Decision d = decide_by_maxima(a);
    EXPECT_EQ(d.level, Level::strong);
    const Path path = answers(d);
    EXPECT_FALSE(path[0]);
    EXPECT_TRUE(path[1]);
    EXPECT_TRUE(path[2]);
}

TEST(DecideByMaxima, WeakTestFailsEvenWithTheLargerToleranceAndStops) {
    Assessment a = passing();
    a.suspect_on_original.distance.max = 4.0 * find_tolerance(a.tolerances, "distance").value;
    const Decision d = decide_by_maxima(a);
    EXPECT_EQ(d.level, Level::none);
    EXPECT_EQ(answers(d), Path({false, true, false}));
}

TEST(DecideByMaxima, ToleranceOfTheUserIsNotRaised) {
    Assessment a = passing();
    ToleranceChoices choices;
    choices.distance = 0.01;
    a.tolerances = derive_tolerances(size, 0.0, choices);
    a.suspect_on_original.distance.max = 0.011;
    const Decision d = decide_by_maxima(a);
    EXPECT_EQ(d.level, Level::none);
    EXPECT_EQ(answers(d), Path({false, false}));
}

TEST(DecideByMaxima, IntermediateTestRetried) {
    Assessment a = passing();
    a.suspect_on_original.kappa_min.max = 2.0 * find_tolerance(a.tolerances, "kappa").value;
    const Decision d = decide_by_maxima(a);
    EXPECT_EQ(d.level, Level::strong);
    EXPECT_EQ(answers(d), Path({true, true, true, false, true, true, true, true, true}));
}

TEST(DecideByMaxima, IntermediateTestFailedLeavesWeak) {
    for (auto quantity :
         {&DirectedComparison::kappa_max, &DirectedComparison::kappa_min, &DirectedComparison::direction}) {
        Assessment a = passing();
        (a.suspect_on_original.*quantity).max = 100.0;
        const Decision d = decide_by_maxima(a);
        EXPECT_EQ(d.level, Level::weak);
        EXPECT_FALSE(d.path.back().answer);
    }
}

TEST(DecideByMaxima, WithoutUmbilicsItEndsAtIntermediate) {
    Assessment a = passing();
    a.strong = {};
    const Decision d = decide_by_maxima(a);
    EXPECT_EQ(d.level, Level::intermediate);
    EXPECT_FALSE(d.path.back().answer);
}

TEST(DecideByMaxima, StrongTestFailedLeavesIntermediate) {
    Assessment a = passing();
    a.strong.passed = false;
    a.strong.unmatched_suspect = {1};
    EXPECT_EQ(decide_by_maxima(a).level, Level::intermediate);
}

TEST(DecideByMaxima, OneDistantNodeIsEnoughToFail) {
    // Algorithm 2 forgives it: the two may give different levels from the same input.
    Assessment a = passing();
    a.suspect_on_original.distance.max = 10.0;
    EXPECT_EQ(decide_by_maxima(a).level, Level::none);
    EXPECT_EQ(decide_by_statistics(a).level, Level::strong);
}

// Fig. 5-2 -----------------------------------------------------------------------------------------------------------

TEST(DecideByStatistics, EverythingPassed) {
    const Decision d = decide_by_statistics(passing());
    EXPECT_EQ(d.level, Level::strong);
    // two directions each for distance, two curvatures and the angle; comparable; umbilics exist; umbilics agree
    EXPECT_EQ(answers(d), Path(11, true));
}

TEST(DecideByStatistics, WeakTestFails) {
    Assessment a = passing();
    a.suspect_on_original.distance.mean = 2.0 * find_tolerance(a.tolerances, "distance").value;
    const Decision d = decide_by_statistics(a);
    EXPECT_EQ(d.level, Level::none);
    EXPECT_EQ(answers(d), Path({false}));
}

TEST(DecideByStatistics, SpreadAloneCanFailIt) {
    Assessment a = passing();
    a.suspect_on_original.distance.standard_deviation = 2.0 * find_tolerance(a.tolerances, "distance").value;
    EXPECT_EQ(decide_by_statistics(a).level, Level::none);
}

TEST(DecideByStatistics, GlobalScopeAsksBothDirections) {
    Assessment a = passing();
    a.original_on_suspect.distance.mean = 1.0;  // the suspect is only a piece
    a.original_on_suspect.coverage = a.original_on_suspect.overlap = 0.4;
    EXPECT_EQ(decide_by_statistics(a).level, Level::none);
    a.scope = MatchScope::partial;
    EXPECT_EQ(decide_by_statistics(a).level, Level::strong);
}

TEST(DecideByStatistics, IntermediateTestFailedLeavesWeak) {
    for (auto quantity :
         {&DirectedComparison::kappa_max, &DirectedComparison::kappa_min, &DirectedComparison::direction}) {
        Assessment a = passing();
        (a.original_on_suspect.*quantity).mean = 100.0;
        EXPECT_EQ(decide_by_statistics(a).level, Level::weak);
    }
}

TEST(DecideByStatistics, UndefinedDirectionsAreNoQuestion) {
    Assessment a = passing();
    a.suspect_on_original.direction = a.original_on_suspect.direction = {};
    EXPECT_EQ(decide_by_statistics(a).level, Level::strong);
    EXPECT_EQ(decide_by_maxima(a).level, Level::strong);
}

TEST(DecideByStatistics, CurvaturesThatCannotBeComparedLeaveWeak) {
    Assessment a = passing();
    a.suspect_on_original.kappa_max.count = 199;  // of 400 nodes
    EXPECT_EQ(decide_by_statistics(a).level, Level::weak);
    EXPECT_EQ(decide_by_maxima(a).level, Level::weak);
}

TEST(DecideByStatistics, UmbilicsMissingOrDisagreeing) {
    Assessment a = passing();
    a.strong = {};
    EXPECT_EQ(decide_by_statistics(a).level, Level::intermediate);
    a.strong.passed = false;
    EXPECT_EQ(decide_by_statistics(a).level, Level::intermediate);
}

TEST(DecideByStatistics, PartialScopeIsDecidedOnTheModelThatLiesOnTheOther) {
    Assessment a = passing();
    a.scope = MatchScope::partial;
    a.suspect_on_original.overlap = 0.4;  // the suspect contains the original
    a.suspect_on_original.distance.mean = 1.0;
    EXPECT_EQ(decide_by_statistics(a).level, Level::strong);
    EXPECT_EQ(decide_by_maxima(a).level, Level::strong);
}

TEST(DecideByStatistics, PartOfBothDoesNotPassAsAWhole) {
    Assessment a = passing();
    a.scope = MatchScope::partial;
    a.suspect_on_original.overlap = 0.85;
    a.original_on_suspect.overlap = 0.8;
    EXPECT_EQ(answers(decide_by_statistics(a)), Path({false}));
    EXPECT_EQ(answers(decide_by_maxima(a)), Path({false}));
    EXPECT_EQ(decide_by_statistics(a).level, Level::none);
}

TEST(DecideByStatistics, ThesisBottlesReachStrong) {
    // Table 6.12 and 6.13 with the tolerances of 6.2.3; the angle as left over once it is not taken near umbilics.
    Assessment a = passing();
    ToleranceChoices choices{.distance = 0.01, .kappa = 0.03, .direction = 0.06};
    a.tolerances = derive_tolerances(size, 0.0, choices);
    for (DirectedComparison* d : {&a.suspect_on_original, &a.original_on_suspect}) {
        d->distance = {0.03456, 0.00814, 0.00665, 429};
        d->kappa_max = {0.07872, 0.01572, 0.01530, 429};
        d->kappa_min = {0.10577, 0.01411, 0.02165, 429};
        d->direction = {0.15, 0.04, 0.04, 300};
    }
    EXPECT_EQ(decide_by_statistics(a).level, Level::strong);
    EXPECT_EQ(decide_by_maxima(a).level, Level::none) << "the largest distance is 3.5 times the tolerance";
}

TEST(DecideByStatistics, ThesisDeformedBottleFails) {
    Assessment a = passing();
    a.suspect_on_original.distance.max = 2.13435;
    a.suspect_on_original.distance.mean = 0.3;
    EXPECT_EQ(decide_by_statistics(a).level, Level::none);
}

// The verdict --------------------------------------------------------------------------------------------------------

TEST(Decide, ChosenAlgorithmGivesTheLevelAndBothAreKept) {
    Assessment a = passing();
    a.suspect_on_original.distance.max = 10.0;
    const Verdict two = decide(pose(), a), one = decide(pose(), a, 1);
    EXPECT_EQ(two.level, Level::strong);
    EXPECT_TRUE(two.derived);
    EXPECT_EQ(one.level, Level::none);
    EXPECT_FALSE(one.derived);
    EXPECT_EQ(one.algorithm_2.level, Level::strong);
    EXPECT_THROW(decide(pose(), a, 3), InvalidInput);
}

TEST(Decide, WithoutAPoseNothingIsDerived) {
    Alignment none;
    none.why = "no hypothesis fits.";
    const Verdict v = decide(none, {});
    EXPECT_EQ(v.level, Level::none);
    EXPECT_FALSE(v.derived);
    EXPECT_NE(v.explanation.find("no hypothesis fits"), std::string::npos);
    EXPECT_FALSE(v.algorithm_1.path.empty());
}

TEST(Decide, CompatiblePoseIsNoEvidence) {
    Alignment alignment = pose();
    alignment.status = AlignmentStatus::compatible;
    const Verdict v = decide(alignment, passing());
    EXPECT_FALSE(v.derived);
    EXPECT_NE(v.explanation.find("does not show"), std::string::npos);
}

TEST(Decide, ExplanationStatesToleranceAndCoverageAndNeverInfringement) {
    Assessment a = passing();
    a.suspect_on_original.coverage = 0.625;
    for (int algorithm : {1, 2})
        for (AlignmentStatus status :
             {AlignmentStatus::found, AlignmentStatus::ambiguous, AlignmentStatus::compatible}) {
            Alignment alignment = pose();
            alignment.status = status;
            const std::string text = decide(alignment, a, algorithm).explanation;
            EXPECT_NE(text.find("0.01 mm"), std::string::npos) << text;
            EXPECT_NE(text.find("62.5 %"), std::string::npos) << text;
            EXPECT_EQ(text.find("infring"), std::string::npos) << text;
        }
}

}  // namespace
}  // namespace umbilic
