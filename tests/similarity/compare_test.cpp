// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <similarity/shapes.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/similarity/compare.h>

namespace umbilic {
namespace {

using namespace test;

/// A free-form original with isolated umbilics: nothing is told to compare() about the suspects' poses.
class CompareTest : public testing::Test {
protected:
    const Model original_model = support::model_of({support::smooth_bicubic(8, 2, 0.3)});
    const PreparedModel original = prepare(original_model);

    Comparison against(std::vector<NurbsSurface> surfaces, const CompareOptions& options = {}) const {
        const Model suspect = support::model_of(std::move(surfaces));
        return compare(original, prepare(suspect), options);
    }
    NurbsSurface surface() const { return original_model.faces[0].surface; }
};

TEST_F(CompareTest, ExactCopiesReachStrong) {
    unsigned seed = 0;
    for (const double scale : {1.0, 2.703, 1.0 / 25.4})
        for (const bool mirrored : {false, true})
            for (const bool swapped : {false, true}) {
                const SimilarityTransform pose = support::random_similarity(++seed, scale, mirrored);
                NurbsSurface copy = support::transformed(surface(), pose);
                if (swapped) copy = copy.swapped();
                const Comparison c = against({copy});
                SCOPED_TRACE(c.answer.text + " | " + c.alignment.why);
                EXPECT_EQ(c.verdict.level, Level::strong) << c.verdict.explanation << c.assessment.strong.why;
                EXPECT_EQ(c.answer.kind, mirrored       ? AnswerClass::mirrored
                                         : scale != 1.0 ? AnswerClass::scaled
                                                        : AnswerClass::moved);
                EXPECT_LT(c.assessment.suspect_on_original.distance.max, 1e-9);
            }
}

TEST_F(CompareTest, TheFileItselfIsTheSame) {
    EXPECT_EQ(against({surface()}).answer.kind, AnswerClass::same);
}

TEST_F(CompareTest, Reapproximated) {
    const SimilarityTransform pose = support::random_similarity(30, 1.6, false);
    const Comparison c = against({support::transformed(reapproximated(surface(), 5, 14), pose).swapped()});
    EXPECT_EQ(c.answer.kind, AnswerClass::reapproximated) << c.answer.text << c.alignment.why;
    EXPECT_GE(c.verdict.level, Level::intermediate) << c.verdict.explanation;
}

TEST_F(CompareTest, Piece) {
    const SimilarityTransform pose = support::random_similarity(31, 1.0, false);
    std::vector<NurbsSurface> cut;
    for (const NurbsSurface& piece : pieces(surface(), 4, 3)) cut.push_back(support::transformed(piece, pose));
    const Comparison c = against(cut);
    EXPECT_EQ(c.answer.kind, AnswerClass::piece) << c.answer.text << c.alignment.why;
    EXPECT_GE(c.verdict.level, Level::intermediate) << c.verdict.explanation;
}

TEST_F(CompareTest, Redesigned) {
    const SimilarityTransform pose = support::random_similarity(32, 1.0, false);
    const Comparison c = against({support::transformed(with_bump(surface(), 6, 6, 0.1), pose)});
    EXPECT_EQ(c.answer.kind, AnswerClass::partly) << c.answer.text << c.alignment.why;
    EXPECT_EQ(c.verdict.level, Level::none) << c.verdict.explanation;
}

TEST_F(CompareTest, Different) {
    for (unsigned seed = 40; seed < 43; ++seed) {
        const Comparison c = against({support::smooth_bicubic(8, seed, 0.3)});
        EXPECT_EQ(c.answer.kind, AnswerClass::different) << c.answer.text << c.alignment.why;
        EXPECT_FALSE(c.verdict.derived);
    }
}

TEST_F(CompareTest, StagesAreTimedAndToleranceChoicesReachTheReport) {
    CompareOptions options;
    options.tolerances.distance = 0.01;
    options.algorithm = 1;
    const Comparison c = against({surface()}, options);
    ASSERT_EQ(c.timing.size(), 4u);
    EXPECT_EQ(c.timing[0].first, "match");
    EXPECT_EQ(c.timing[1].first, "nodes");
    EXPECT_EQ(c.timing[2].first, "assess");
    EXPECT_EQ(c.timing[3].first, "decide");
    EXPECT_EQ(find_tolerance(c.assessment.tolerances, "distance").origin, ToleranceOrigin::user);
    EXPECT_EQ(c.verdict.chosen_algorithm, 1);
    EXPECT_EQ(c.verdict.level, c.verdict.algorithm_1.level);
}

TEST_F(CompareTest, NodesAreThoseOfTheWireframeOrOfTheArea) {
    const SimilarityTransform pose = support::random_similarity(11, 3.0, false);
    const std::vector<NurbsSurface> suspect = {support::transformed(surface(), pose)};
    CompareOptions options;
    for (const NodeChoice choice : {NodeChoice::wireframe, NodeChoice::area}) {
        options.nodes = choice;
        const Comparison c = against(suspect, options);
        for (const DirectedComparison* directed :
             {&c.assessment.suspect_on_original, &c.assessment.original_on_suspect}) {
            const int count = static_cast<int>(directed->nodes.size());
            EXPECT_EQ(directed->of_wireframe, choice == NodeChoice::wireframe ? count : 0);
            EXPECT_GT(count, options.features.samples.count / 2);
            EXPECT_LT(count, options.features.samples.count * 2);
            EXPECT_LT(directed->distance.max, 1e-6);
        }
        EXPECT_GE(c.verdict.level, Level::intermediate);
    }
}

TEST_F(CompareTest, WrongChoicesAreRefusedBeforeTheWork) {
    CompareOptions options;
    options.tolerances.kappa = -1.0;
    EXPECT_THROW(against({surface()}, options), InvalidInput);
}

TEST_F(CompareTest, ResultsDoNotDependOnTheRun) {
    const std::vector<NurbsSurface> suspect = {
        support::transformed(reapproximated(surface(), 4, 13), support::random_similarity(33, 0.5, true))};
    const Comparison a = against(suspect), b = against(suspect);
    EXPECT_EQ(a.alignment.original_suspect.scale, b.alignment.original_suspect.scale);
    EXPECT_EQ(a.assessment.suspect_on_original.distance.mean, b.assessment.suspect_on_original.distance.mean);
    EXPECT_EQ(a.answer.text, b.answer.text);
    EXPECT_EQ(a.verdict.explanation, b.verdict.explanation);
}

}  // namespace
}  // namespace umbilic
