// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <support/clouds.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/similarity/assess_points.h>
#include <umbilic/similarity/compare.h>
#include <umbilic/similarity/thresholds.h>
#include <umbilic/similarity/verdict.h>

namespace umbilic {
namespace {

Alignment at(const SimilarityTransform& original_suspect, MatchScope scope = MatchScope::global) {
    Alignment alignment;
    alignment.status = AlignmentStatus::found;
    alignment.method = MatchMethod::given;
    alignment.scope = scope;
    alignment.original_suspect = original_suspect;
    return alignment;
}

class AssessPoints : public ::testing::Test {
protected:
    const Model model = support::model_of({support::smooth_bicubic(8, 41, 0.3)});
    const PreparedModel original = prepare(model);
    const double size = model.size();
};

TEST_F(AssessPoints, ANoisyScanInItsTruePosePassesTheIntermediateTest) {
    for (const bool mirrored : {false, true}) {
        const SimilarityTransform truth = support::random_similarity(5, 2.4, mirrored);
        const double noise = 3e-4 * size;
        const PointCloud cloud = support::scan_of(model, {.points = 3000, .noise = noise}, truth, 9);
        const PreparedPoints suspect = prepare(cloud);
        const Assessment a = assess(original, suspect, at(truth));
        EXPECT_TRUE(a.measured);
        EXPECT_TRUE(a.weak_passed);
        EXPECT_TRUE(a.intermediate_passed);
        EXPECT_EQ(a.intermediate_why, "");
        EXPECT_FALSE(a.strong.passed.has_value());
        EXPECT_NEAR(find_tolerance(a.tolerances, "noise").value, noise, 0.3 * noise);
        EXPECT_GE(find_tolerance(a.tolerances, "distance").value,
                  measured_noise_tolerance * find_tolerance(a.tolerances, "noise").value);
        // Mean size of a normal deviate; a tenth for what the border takes away and noise adds.
        EXPECT_NEAR(a.suspect_on_original.distance.mean, std::sqrt(2.0 / M_PI) * noise, 0.1 * noise);
        EXPECT_GT(a.suspect_on_original.coverage, 0.99);
        EXPECT_GT(a.original_on_suspect.coverage, 0.95);
        EXPECT_GT(a.suspect_on_original.kappa_max.count, 1500);
        const Verdict verdict = decide(at(truth), a);
        EXPECT_EQ(verdict.level, Level::intermediate);
    }
}

TEST_F(AssessPoints, CurvaturesOfAnExactScanAgreeBesideWhatPolynomialsMiss) {
    const PointCloud cloud = support::scan_of(model, {.points = 2000}, {}, 10);
    const PreparedPoints suspect = prepare(cloud);
    const Assessment a = assess(original, suspect, at({}));
    // Both sides miss the same of the shape: without noise nothing is left but rounding.
    EXPECT_LT(a.suspect_on_original.kappa_max.max, 1e-6 / size);
    EXPECT_LT(a.suspect_on_original.direction.max, 1e-6);
    EXPECT_LT(a.suspect_on_original.distance.max, 1e-9 * size);
}

TEST_F(AssessPoints, CurvatureOfAnotherRadiusDiffersAsItShould) {
    const Model ball = support::model_of({support::ellipsoid_octant(3, 3, 3)});
    const PreparedModel prepared = prepare(ball);
    const double grown = 1.02;
    PointCloud cloud = support::scan_of(ball, {.points = 2000}, {}, 11);
    for (Vector3& p : cloud.points) p *= grown;
    const PreparedPoints suspect = prepare(cloud);
    const Assessment a = assess(prepared, suspect, at({}), {.distance = 1.0});
    const double expected = (1.0 - 1.0 / grown) / 3.0;
    EXPECT_NEAR(a.suspect_on_original.kappa_max.mean, expected, 0.05 * expected);
    EXPECT_NEAR(a.suspect_on_original.kappa_min.mean, expected, 0.05 * expected);
    EXPECT_EQ(a.suspect_on_original.direction.count, 0);  // a sphere has no principal directions
    EXPECT_NEAR(a.suspect_on_original.distance.mean, 0.06, 0.005);
    for (const NodeComparison& node : a.suspect_on_original.nodes)
        EXPECT_NEAR(std::abs(node.signed_distance), node.distance, 1e-12);
}

TEST_F(AssessPoints, AMovedScanFailsTheWeakTest) {
    const PointCloud cloud = support::scan_of(model, {.points = 2000, .noise = 3e-4 * size}, {}, 12);
    const PreparedPoints suspect = prepare(cloud);
    const SimilarityTransform off{.translation = Vector3(0, 0, 0.02 * size)};
    const Assessment a = assess(original, suspect, at(off));
    EXPECT_FALSE(a.weak_passed);
    EXPECT_FALSE(a.intermediate_passed);
    EXPECT_EQ(decide(at(off), a).level, Level::none);
}

TEST_F(AssessPoints, TooMuchNoiseLeavesTheIntermediateTestOpen) {
    const PointCloud cloud = support::scan_of(model, {.points = 400, .noise = 0.02 * size}, {}, 13);
    const PreparedPoints suspect = prepare(cloud);
    const Assessment a = assess(original, suspect, at({}), {.kappa = 0.05 / size});
    EXPECT_TRUE(a.weak_passed);
    EXPECT_FALSE(a.intermediate_passed);
    EXPECT_NE(a.intermediate_why.find("noise"), std::string::npos) << a.intermediate_why;
    EXPECT_EQ(decide(at({}), a).level, Level::weak);
}

TEST_F(AssessPoints, PointsAgainstPoints) {
    const PointCloud first = support::scan_of(model, {.points = 3000, .noise = 1e-4 * size}, {}, 14);
    const SimilarityTransform truth = support::random_similarity(6, 0.5, false);
    const PointCloud second =
        support::scan_of(model, {.points = 3000, .coverage = 0.5, .noise = 1e-4 * size}, truth, 15);
    const PreparedPoints points = prepare(first), suspect = prepare(second);
    const Assessment a = assess(points, suspect, at(truth, MatchScope::partial));
    EXPECT_TRUE(a.weak_passed);
    EXPECT_TRUE(a.intermediate_passed) << a.suspect_on_original.kappa_max.mean;
    EXPECT_NEAR(a.original_on_suspect.coverage, 0.5, 0.15);
    EXPECT_EQ(a.suspect_on_original.nodes.front().foot.face, 0);
}

TEST_F(AssessPoints, OutliersOfAScanAreForgivenAndForeignPointsAreNot) {
    for (const double foreign : {0.03, 0.2}) {
        PointCloud cloud = support::scan_of(model, {.points = 2000, .noise = 3e-4 * size}, {}, 16);
        for (std::size_t i = 0; i < static_cast<std::size_t>(foreign * 2000); ++i)
            cloud.points[i] += Vector3(0, 0, 0.1 * size);
        const PreparedPoints suspect = prepare(cloud);
        const Assessment a = assess(original, suspect, at({}));
        EXPECT_EQ(a.weak_passed, foreign < 0.05) << foreign;
        EXPECT_NEAR(a.suspect_on_original.overlap, 1.0 - foreign, 0.05);
    }
}

TEST_F(AssessPoints, AnswersSayWhatTheScanIs) {
    const SimilarityTransform truth = support::random_similarity(7, 2.0, false);
    const auto compared = [&](const PointCloud& cloud) {
        const PreparedPoints suspect = prepare(cloud);
        return compare(original, suspect, {.match = {.mirror = MirrorChoice::never}});
    };
    const Comparison whole = compared(support::scan_of(model, {.points = 2500, .noise = 3e-4 * size}, truth, 17));
    EXPECT_EQ(whole.answer.kind, AnswerClass::scaled) << whole.answer.text;
    EXPECT_NE(whole.answer.text.find("a scan of the whole original, moved and scaled by 0.5"), std::string::npos)
        << whole.answer.text;
    EXPECT_EQ(whole.verdict.level, Level::intermediate);
    const Comparison piece =
        compared(support::scan_of(model, {.points = 2500, .coverage = 0.5, .noise = 3e-4 * size}, truth, 18));
    EXPECT_EQ(piece.answer.kind, AnswerClass::piece) << piece.answer.text;
    const Comparison mesh = compared(support::mesh_of(support::smooth_bicubic(8, 41, 0.3), 40));
    EXPECT_EQ(mesh.answer.kind, AnswerClass::same) << mesh.answer.text;
    EXPECT_NE(mesh.answer.text.find("a mesh of the whole original, in the same place"), std::string::npos)
        << mesh.answer.text;
    const Model other = support::model_of({support::smooth_bicubic(8, 50, 0.3)});
    const Comparison foreign = compared(support::scan_of(other, {.points = 2000, .noise = 3e-4 * size}, truth, 19));
    EXPECT_NE(foreign.alignment.status, AlignmentStatus::found);
    EXPECT_EQ(foreign.answer.kind, AnswerClass::different) << foreign.answer.text;
    EXPECT_EQ(foreign.verdict.level, Level::none);
    EXPECT_TRUE(foreign.assessment.measured);
}

TEST_F(AssessPoints, AModelIsNoSuspectOfPoints) {
    const PointCloud cloud = support::scan_of(model, {.points = 500}, {}, 20);
    const PreparedPoints points = prepare(cloud);
    EXPECT_THROW(compare(PreparedShape(points), PreparedShape(original)), Unsupported);
    EXPECT_THROW(match(PreparedShape(points), PreparedShape(original)), Unsupported);
    EXPECT_THROW(assess(original, points, at({}), {.kappa = -1.0}), InvalidInput);
}

}  // namespace
}  // namespace umbilic
