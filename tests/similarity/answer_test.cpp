// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <numbers>

#include <Eigen/Geometry>
#include <support/surfaces.h>
#include <umbilic/similarity/verdict.h>

namespace umbilic {
namespace {

/// Nodes of equal weight: `alike` of 100 at distance `near`, the others at distance `far`.
DirectedComparison nodes(int alike, double near, double far, double tolerance) {
    DirectedComparison result;
    for (int i = 0; i < 100; ++i) {
        NodeComparison node;
        node.at = node.foot = {1, 0.5, 0.5};
        node.weight = 1.0;
        node.distance = i < alike ? near : far;
        node.covered = node.distance <= tolerance;
        node.kappa_max = node.kappa_min = 0.0;
        result.nodes.push_back(node);
    }
    result.coverage = result.overlap = alike / 100.0;
    return result;
}

class AnswerTest : public testing::Test {
protected:
    Model original = support::model_of({support::smooth_bicubic(6, 1)});
    Model suspect = original;
    Alignment alignment;
    Assessment assessment;
    double delta = 0.0;

    void SetUp() override {
        alignment.status = AlignmentStatus::found;
        alignment.method = MatchMethod::curvature;
        assessment.tolerances = derive_tolerances(original.size(), 0.0);
        delta = find_tolerance(assessment.tolerances, "distance").value;
        coverage(100, 100, 0.0);
        assessment.faces = {{.suspect_face = 1, .original_face = 1, .fraction = 1.0, .level = "intermediate"}};
    }

    void coverage(int of_suspect, int of_original, double deviation) {
        assessment.suspect_on_original = nodes(of_suspect, deviation, 0.3, delta);
        assessment.original_on_suspect = nodes(of_original, deviation, 0.3, delta);
    }

    /// Makes the suspect a copy in another pose.
    void place(const SimilarityTransform& suspect_original) {
        suspect = support::model_of({support::transformed(original.faces[0].surface, suspect_original)});
        alignment.original_suspect = suspect_original.inverse();
    }

    Answer ask() const { return answer(original, suspect, alignment, assessment, Verdict()); }
};

bool has(const Answer& answer, const char* words) {
    return answer.text.find(words) != std::string::npos;
}

TEST_F(AnswerTest, Same) {
    const Answer a = ask();
    EXPECT_EQ(a.kind, AnswerClass::same);
    EXPECT_EQ(a.text, "the same shape in the same place with the same control points");
}

TEST_F(AnswerTest, Moved) {
    place(support::random_similarity(1, 1.0, false));
    EXPECT_EQ(ask().kind, AnswerClass::moved);
    EXPECT_EQ(ask().text, "the same shape with the same control points, moved");
}

TEST_F(AnswerTest, MovedByLittleMoreThanTheTolerance) {
    SimilarityTransform shift;
    shift.translation.x() = 2.0 * find_tolerance(assessment.tolerances, "exact-distance").value;
    place(shift);
    EXPECT_EQ(ask().kind, AnswerClass::moved);
}

TEST_F(AnswerTest, ScaledMovedAndReparametrised) {
    const SimilarityTransform t = support::random_similarity(2, 2.703, false);
    suspect = support::model_of({support::transformed(support::smooth_bicubic(7, 1), t)});
    alignment.original_suspect = t.inverse();
    const Answer a = ask();
    EXPECT_EQ(a.kind, AnswerClass::scaled);
    EXPECT_EQ(a.text,
              "the same shape, moved, scaled by 2.703 (the suspect is 2.703 times as large) and re-parametrised");
}

TEST_F(AnswerTest, ScaledAboutTheOriginIsNotMoved) {
    place({.scale = 0.5});
    const Answer a = ask();
    EXPECT_EQ(a.kind, AnswerClass::scaled);
    EXPECT_FALSE(has(a, "moved"));
    EXPECT_TRUE(has(a, "2 times smaller"));
}

TEST_F(AnswerTest, UnitMixUpIsNamed) {
    for (double scale : {25.4, 1.0 / 25.4}) {
        place(support::random_similarity(3, scale, false));
        EXPECT_TRUE(has(ask(), "unit mix-up of inch and millimetre?")) << ask().text;
    }
}

TEST_F(AnswerTest, MirroredComesBeforeScaled) {
    place(support::random_similarity(4, 2.0, true));
    const Answer a = ask();
    EXPECT_EQ(a.kind, AnswerClass::mirrored);
    EXPECT_TRUE(has(a, "mirrored, moved and scaled by 2 ")) << a.text;
}

TEST_F(AnswerTest, ReflectionInAnyPlaneIsNotAMove) {
    const Vector3 normal = Vector3(1, 2, 3).normalized();
    const Matrix3 reflection = Matrix3::Identity() - 2.0 * normal * normal.transpose();
    place(similarity_from_orthogonal(1.0, reflection, 5.0 * normal));
    EXPECT_EQ(ask().kind, AnswerClass::mirrored);
    EXPECT_FALSE(has(ask(), "moved")) << ask().text;
    place(similarity_from_orthogonal(1.0, reflection, 5.0 * normal.unitOrthogonal()));
    EXPECT_TRUE(has(ask(), "moved"));
    place(similarity_from_orthogonal(1.0, -Matrix3::Identity(), Vector3::Zero()));
    EXPECT_TRUE(has(ask(), "moved")) << "a point reflection also turns";
}

TEST_F(AnswerTest, SymmetricPoseThatChangesNothingWins) {
    alignment.original_suspect = similarity_from_orthogonal(
        1.0, Matrix3(Eigen::AngleAxisd(std::numbers::pi, Vector3::UnitZ())), Vector3(1, 1, 0));
    alignment.symmetries = {support::random_similarity(5, 1.0, true), SimilarityTransform()};
    EXPECT_EQ(ask().kind, AnswerClass::same);
}

TEST_F(AnswerTest, Reapproximated) {
    coverage(100, 100, 0.3 * delta);
    place(support::random_similarity(6, 1.0, false));
    const Answer a = ask();
    EXPECT_EQ(a.kind, AnswerClass::reapproximated);
    EXPECT_TRUE(has(a, "moved and re-approximated within 0.000093 mm")) << a.text;
}

TEST_F(AnswerTest, Piece) {
    coverage(100, 37, 0.0);
    const Answer a = ask();
    EXPECT_EQ(a.kind, AnswerClass::piece);
    EXPECT_TRUE(has(a, "37.0 %")) << a.text;
}

TEST_F(AnswerTest, Contains) {
    coverage(37, 100, 0.0);
    const Answer a = ask();
    EXPECT_EQ(a.kind, AnswerClass::contains);
    EXPECT_TRUE(has(a, "37.0 % of the suspect")) << a.text;
    EXPECT_FALSE(has(a, "more cop")) << a.text;
    alignment.copies = {alignment.original_suspect, support::random_similarity(5, 1.0, false),
                        support::random_similarity(7, 1.0, false)};
    EXPECT_TRUE(has(ask(), "; 2 more copies of it stand elsewhere in the suspect")) << ask().text;
}

TEST_F(AnswerTest, Partly) {
    coverage(85, 80, 0.0);
    const Answer a = ask();
    EXPECT_EQ(a.kind, AnswerClass::partly);
    EXPECT_TRUE(has(a, "85.0 %") && has(a, "80.0 %") && has(a, "0.3 mm")) << a.text;
}

TEST_F(AnswerTest, OneNodeFarAwayMakesItPartly) {
    coverage(99, 99, 0.0);
    EXPECT_EQ(ask().kind, AnswerClass::partly);
}

TEST_F(AnswerTest, CrossingSurfacesAreDifferent) {
    coverage(20, 20, delta);  // nowhere at zero
    EXPECT_EQ(ask().kind, AnswerClass::different) << ask().text;
    EXPECT_TRUE(has(ask(), "20.0 %"));
}

TEST_F(AnswerTest, NothingFoundAndNothingTriedAreToldApart) {
    alignment = {};
    alignment.why = "no umbilic, no solid";
    EXPECT_EQ(ask().kind, AnswerClass::different);
    EXPECT_TRUE(has(ask(), "nothing could be decided")) << ask().text;
    alignment.runners_up.resize(1);
    EXPECT_EQ(ask().text.substr(0, 9), "different");
}

TEST_F(AnswerTest, DoubtsAreSaid) {
    alignment.status = AlignmentStatus::ambiguous;
    EXPECT_TRUE(has(ask(), "several positions"));
    alignment.status = AlignmentStatus::compatible;
    EXPECT_TRUE(has(ask(), "too little evidence"));
}

}  // namespace
}  // namespace umbilic
