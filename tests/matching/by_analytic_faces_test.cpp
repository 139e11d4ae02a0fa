// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_analytic_faces.h>

#include <gtest/gtest.h>

#include <support/reparametrisation.h>

#include <umbilic/matching/match.h>

#include "mechanical_shapes.h"

namespace umbilic {
namespace {

using support::all_moved;
using support::cylinder;
using support::model_of;
using support::random_similarity;
using support::rectangle;

FeatureOptions quick() {
    FeatureOptions options;
    options.samples.count = 1200;
    options.umbilics.certificate = false;
    return options;
}

Alignment match_faces(const std::vector<NurbsSurface>& original, const std::vector<NurbsSurface>& suspect,
                      const MatchOptions& options = {.method = MethodChoice::analytic}) {
    const Model a = model_of(original), b = model_of(suspect);
    return match(prepare(a, quick()), prepare(b, quick()), options);
}

double pose_error(const SimilarityTransform& found, const SimilarityTransform& truth) {
    double greatest = 0.0;
    for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(100, 0, 0), Vector3(0, 100, 0), Vector3(0, 0, 100)}) {
        const Vector3 p = truth.inverse().apply(offset);
        greatest = std::max(greatest, (found.apply(p) - truth.apply(p)).norm());
    }
    return greatest / 100.0;
}

const FreeMotion* motion(const Alignment& alignment, FreeMotionKind kind) {
    for (const FreeMotion& motion : alignment.free_motions)
        if (motion.kind == kind) return &motion;
    return nullptr;
}

TEST(ByAnalyticFaces, FindsCopiesInAnyPlaceSizeAndHand) {
    const std::vector<NurbsSurface> faces = support::bracket();
    const double scales[] = {0.05, 0.7, 20.0};
    for (int i = 0; i < 3; ++i)
        for (const bool mirrored : {false, true}) {
            const SimilarityTransform truth = random_similarity(30 + i, scales[i], mirrored);
            const Alignment alignment = match_faces(faces, all_moved(faces, truth.inverse()), {});
            SCOPED_TRACE(alignment.why);
            ASSERT_EQ(alignment.status, AlignmentStatus::found);
            EXPECT_EQ(alignment.method, MatchMethod::analytic);
            EXPECT_EQ(alignment.original_suspect.mirrored, mirrored);
            EXPECT_LT(pose_error(alignment.original_suspect, truth), 1e-9);
            EXPECT_TRUE(alignment.free_motions.empty());
        }
}

TEST(ByAnalyticFaces, FindsPiecesAndOriginalsWithinMore) {
    const std::vector<NurbsSurface> faces = support::bracket();
    const SimilarityTransform truth = random_similarity(5, 3.0, false);
    const std::vector<NurbsSurface> part(faces.begin() + 4, faces.begin() + 9);
    const Alignment piece = match_faces(faces, all_moved(part, truth.inverse()));
    SCOPED_TRACE(piece.why);
    ASSERT_EQ(piece.status, AlignmentStatus::found);
    EXPECT_EQ(piece.scope, MatchScope::partial);
    EXPECT_LT(pose_error(piece.original_suspect, truth), 1e-9);

    std::vector<NurbsSurface> more = faces;
    SimilarityTransform beside;
    beside.translation = Vector3(180, 20, -30);
    for (const NurbsSurface& face : all_moved(support::flange(), beside)) more.push_back(face);
    const Alignment within = match_faces(faces, all_moved(more, truth.inverse()));
    SCOPED_TRACE(within.why);
    ASSERT_EQ(within.status, AlignmentStatus::found);
    EXPECT_LT(pose_error(within.original_suspect, truth), 1e-9);
    EXPECT_GT(within.original_coverage, 0.99);
}

TEST(ByAnalyticFaces, ListsEverySymmetryOfASixFoldFlangeAndItsMirrorImage) {
    const std::vector<NurbsSurface> faces = support::flange();
    for (const bool mirrored : {false, true}) {
        const SimilarityTransform truth = random_similarity(9, 0.3, mirrored);
        const Alignment alignment = match_faces(faces, all_moved(faces, truth.inverse()));
        SCOPED_TRACE(alignment.why);
        ASSERT_EQ(alignment.status, AlignmentStatus::found);
        EXPECT_FALSE(alignment.original_suspect.mirrored);
        EXPECT_EQ(alignment.symmetries.size(), 11u);
        bool listed = pose_error(alignment.original_suspect, truth) < 1e-9;
        for (const SimilarityTransform& pose : alignment.symmetries) listed = listed || pose_error(pose, truth) < 1e-9;
        EXPECT_TRUE(listed);
    }
}

TEST(ByAnalyticFaces, TellsTheHandOfANearlySymmetricPart) {
    std::vector<NurbsSurface> faces = support::flange();
    // One hole is off its place by a fortieth of its radius.
    faces[6] = cylinder({46 * std::cos(2.0943951) + 0.1, 46 * std::sin(2.0943951) + 0.1, 0}, {0, 0, 14}, 5.5);
    for (const bool mirrored : {false, true}) {
        const SimilarityTransform truth = random_similarity(11, 4.0, mirrored);
        const Alignment alignment = match_faces(faces, all_moved(faces, truth.inverse()));
        SCOPED_TRACE(alignment.why);
        ASSERT_EQ(alignment.status, AlignmentStatus::found);
        EXPECT_EQ(alignment.original_suspect.mirrored, mirrored);
        EXPECT_LT(pose_error(alignment.original_suspect, truth), 1e-9);
    }
}

TEST(ByAnalyticFaces, NamesTheMotionsThatUndeterminedPiecesKeep) {
    const std::vector<NurbsSurface> faces = support::bracket();
    const SimilarityTransform truth = random_similarity(13, 2.0, false);
    const auto piece = [&](std::vector<NurbsSurface> part) {
        return match_faces(faces, all_moved(std::move(part), truth.inverse()), {});
    };
    const Vector3 z = Vector3::UnitZ();

    const Alignment hole = piece({faces[5]});
    SCOPED_TRACE(hole.why);
    EXPECT_EQ(hole.status, AlignmentStatus::compatible);
    // Without its ends it slides too.
    const ParameterInterval along = faces[5].domain().v;
    const NurbsSurface inner = support::restricted(
        faces[5], {faces[5].domain().u, {along.low + 0.2 * along.length(), along.high - 0.3 * along.length()}});
    const Alignment cut = piece({inner});
    SCOPED_TRACE(cut.why);
    EXPECT_EQ(cut.status, AlignmentStatus::compatible);
    EXPECT_EQ(cut.free_motions.size(), 2u);
    EXPECT_NE(motion(cut, FreeMotionKind::turn), nullptr);
    EXPECT_NE(motion(cut, FreeMotionKind::slide), nullptr);

    // Both ends of the hole meet those of the original's.
    ASSERT_EQ(hole.free_motions.size(), 1u);
    const FreeMotion* turn = motion(hole, FreeMotionKind::turn);
    ASSERT_NE(turn, nullptr);
    EXPECT_NE(hole.why.find("turns about the axis"), std::string::npos);
    EXPECT_NE(hole.why.find("borders that both share"), std::string::npos);

    const Alignment coaxial = piece({faces[5], faces[6]});
    SCOPED_TRACE(coaxial.why);
    EXPECT_EQ(coaxial.status, AlignmentStatus::compatible);
    EXPECT_EQ(coaxial.free_motions.size(), 1u);
    turn = motion(coaxial, FreeMotionKind::turn);
    ASSERT_NE(turn, nullptr);
    EXPECT_LT(turn->direction.cross(z).norm(), 1e-9);
    EXPECT_LT((turn->point - Vector3(70, 28, 0)).cross(z).norm(), 1e-6);

    const Alignment flat = piece({rectangle({50, 20, 0}, {20, 0, 0}, {0, -15, 0})});
    SCOPED_TRACE(flat.why);
    EXPECT_EQ(flat.status, AlignmentStatus::compatible);
    EXPECT_NE(motion(flat, FreeMotionKind::turn), nullptr);
    EXPECT_NE(motion(flat, FreeMotionKind::slide_in_plane), nullptr);
    EXPECT_NE(motion(flat, FreeMotionKind::size), nullptr);

    // A hole and the plane it stands on turn, and nothing else.
    const Alignment plate = piece({rectangle({60, 28, 10}, {25, 0, 0}, {0, 25, 0}), faces[5], faces[6]});
    SCOPED_TRACE(plate.why);
    EXPECT_EQ(plate.status, AlignmentStatus::compatible);
    ASSERT_EQ(plate.free_motions.size(), 1u);
    EXPECT_EQ(plate.free_motions[0].kind, FreeMotionKind::turn);
    EXPECT_LT((plate.free_motions[0].point - Vector3(70, 28, 0)).cross(z).norm(), 1e-6);
}

TEST(ByAnalyticFaces, WholesOfRevolutionAreFoundAndTurn) {
    const std::vector<NurbsSurface> shaft = {cylinder({0, 0, 0}, {0, 0, 40}, 15), cylinder({0, 0, 40}, {0, 0, 70}, 22),
                                             cylinder({0, 0, 110}, {0, 0, 30}, 12),
                                             support::frustum({0, 0, 140}, {0, 0, 6}, 12, 8)};
    const SimilarityTransform truth = random_similarity(15, 0.4, false);
    const Alignment alignment = match_faces(shaft, all_moved(shaft, truth.inverse()));
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    ASSERT_EQ(alignment.free_motions.size(), 1u);
    EXPECT_EQ(alignment.free_motions[0].kind, FreeMotionKind::turn);
    EXPECT_LT(alignment.free_motions[0].point.cross(Vector3::UnitZ()).norm(), 1e-7);
    EXPECT_NEAR(alignment.original_suspect.scale, truth.scale, 1e-9);
}

TEST(ByAnalyticFaces, SharesOfStandardSizesAreNoEvidence) {
    // The same plate thickness and hole in another part.
    const std::vector<NurbsSurface> other = {
        rectangle({0, 0, 0}, {80, 0, 0}, {0, -50, 0}), rectangle({0, 0, 10}, {80, 0, 0}, {0, 50, 0}),
        rectangle({80, 0, 5}, {0, 50, 0}, {0, 0, 5}), cylinder({20, -12, 0}, {0, 0, 10}, 4.5),
        cylinder({-33, 17, 0}, {0, 0, 10}, 21)};
    const SimilarityTransform pose = random_similarity(16, 1.0, false);
    const Alignment alignment = match_faces(support::bracket(), all_moved(other, pose));
    SCOPED_TRACE(alignment.why);
    EXPECT_NE(alignment.status, AlignmentStatus::found);
    EXPECT_NE(alignment.status, AlignmentStatus::ambiguous);
}

TEST(ByAnalyticFaces, FreeFormFacesComplementAHole) {
    // A hole and a sculpted face: neither method alone has all the evidence, the score has.
    SimilarityTransform beside;
    beside.scale = 60.0;
    beside.translation = Vector3(-30, -30, 20);
    const std::vector<NurbsSurface> faces = {support::transformed(support::smooth_bicubic(8, 3), beside),
                                             cylinder({0, 0, 0}, {0, 0, 15}, 6),
                                             rectangle({0, 0, 0}, {30, 0, 0}, {0, 30, 0})};
    const SimilarityTransform truth = random_similarity(18, 5.0, true);
    const Alignment alignment = match_faces(faces, all_moved(faces, truth.inverse()), {});
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    EXPECT_TRUE(alignment.original_suspect.mirrored);
    EXPECT_LT(pose_error(alignment.original_suspect, truth), 1e-9);
}

TEST(ByAnalyticFaces, KnownScaleIsKept) {
    const std::vector<NurbsSurface> faces = support::bracket();
    const MatchOptions fixed{.method = MethodChoice::analytic, .scale = {ScaleChoice::Kind::fixed}};
    const SimilarityTransform moved = random_similarity(20, 1.0, false), scaled = random_similarity(20, 1.5, false);
    const Alignment alignment = match_faces(faces, all_moved(faces, moved.inverse()), fixed);
    ASSERT_TRUE(alignment.found()) << alignment.why;
    EXPECT_EQ(alignment.original_suspect.scale, 1.0);
    EXPECT_FALSE(match_faces(faces, all_moved(faces, scaled.inverse()), fixed).found());
}

}  // namespace
}  // namespace umbilic
