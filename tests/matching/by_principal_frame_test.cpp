// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <support/surfaces.h>
#include <umbilic/matching/by_principal_frame.h>

namespace umbilic {
namespace {

constexpr int original_samples = 20000;
constexpr int suspect_samples = 4000;

double pose_error(const SimilarityTransform& found, const SimilarityTransform& truth, const Model& suspect) {
    double worst = 0.0;
    for (int k = 0; k < 8; ++k) {
        const Vector3 corner(k & 1 ? suspect.box.low.x() : suspect.box.high.x(),
                             k & 2 ? suspect.box.low.y() : suspect.box.high.y(),
                             k & 4 ? suspect.box.low.z() : suspect.box.high.z());
        worst = std::max(worst, (found.apply(corner) - truth.apply(corner)).norm());
    }
    return worst;
}

TEST(ShapeSignature, KeepsUnderSimilarityAndChangesAsStatedInAMirror) {
    const NurbsSurface surface = support::smooth_bicubic(8, 3);
    for (const bool mirror : {false, true}) {
        const NurbsSurface moved = support::transformed(surface, support::random_similarity(4, 7.5, mirror));
        const ShapeSignature before = shape_signature(surface.derivatives(0.31, 0.62, 3), true);
        // A mirror turns r_u x r_v to the other side of the material.
        const ShapeSignature after = shape_signature(moved.derivatives(0.31, 0.62, 3), !mirror);
        EXPECT_NEAR(after.angle, before.angle, 1e-10);
        EXPECT_NEAR(after.magnitude * 7.5, before.magnitude, 1e-9 * before.magnitude);
        const ShapeSignature expected = mirror ? mirrored(before) : before;
        const double direct = std::abs(after.cubic.b - expected.cubic.b);
        const double turned = std::abs(after.cubic.b + expected.cubic.b);
        EXPECT_LT(std::min(direct, turned), 1e-8 * std::sqrt(before.cubic.squared_norm()));
    }
}

TEST(ShapeSignature, SeenFromBehindTwiceIsTheSame) {
    const ShapeSignature s = shape_signature(support::smooth_bicubic(8, 5).derivatives(0.4, 0.3, 3), true);
    const ShapeSignature back = seen_from_behind(seen_from_behind(s));
    EXPECT_NEAR(back.angle, s.angle, 1e-14);
    EXPECT_EQ(back.cubic.a, s.cubic.a);
}

TEST(ByPrincipalFrame, ProposesTheTruePose) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        const bool mirror = seed % 2 == 1;
        const double scale = std::pow(10.0, 0.5 * seed - 1.0);
        const NurbsSurface surface = support::smooth_bicubic(8, 40 + seed, 0.3);
        const SimilarityTransform truth = support::random_similarity(seed, scale, mirror);
        const Model original = support::model_of({surface});
        const Model suspect = support::model_of({support::transformed(surface, truth.inverse()).swapped()});
        const PrincipalFrameTable a(original, original_samples), b(suspect, suspect_samples);
        for (const bool third_order : {true, false}) {
            const auto poses = propose_by_principal_frame(a, b, {.seeds = 6, .third_order = third_order});
            ASSERT_FALSE(poses.empty());
            double best = INFINITY;
            for (const PoseCandidate& pose : poses)
                best = std::min(best, pose_error(pose.original_suspect, truth, suspect));
            // Within the basin of the refinement.
            EXPECT_LT(best, 0.2 * original.box.diagonal()) << seed << ' ' << third_order;
            EXPECT_LT(pose_error(poses.front().original_suspect, truth, suspect), 0.2 * original.box.diagonal());
        }
    }
}

TEST(ByPrincipalFrame, HonoursScaleAndHand) {
    const NurbsSurface surface = support::smooth_bicubic(8, 60, 0.3);
    const SimilarityTransform truth = support::random_similarity(1, 3.0, true);
    const Model original = support::model_of({surface});
    const Model suspect = support::model_of({support::transformed(surface, truth.inverse())});
    const PrincipalFrameTable a(original, original_samples), b(suspect, suspect_samples);
    for (const PoseCandidate& pose : propose_by_principal_frame(a, b, {.mirror = MirrorChoice::never}))
        EXPECT_FALSE(pose.original_suspect.mirrored);
    for (const PoseCandidate& pose : propose_by_principal_frame(a, b, {.scale = {ScaleChoice::Kind::fixed}}))
        EXPECT_EQ(pose.original_suspect.scale, 1.0);
    const auto ranged = propose_by_principal_frame(a, b, {.scale = {ScaleChoice::Kind::range, 2.0, 4.0}});
    ASSERT_FALSE(ranged.empty());
    EXPECT_LT(pose_error(ranged.front().original_suspect, truth, suspect), 0.2 * original.box.diagonal());
}

TEST(ByPrincipalFrame, SphereAndPlaneProposeNothing) {
    const Model sphere = support::model_of({support::ellipsoid_octant(2, 2, 2)});
    const Model plane = support::model_of({support::graph_patch(2, 2, [](double, double) { return 0.0; })});
    const Model other = support::model_of({support::smooth_bicubic(8, 1)});
    const PrincipalFrameTable table(other, 2000);
    EXPECT_TRUE(propose_by_principal_frame(table, PrincipalFrameTable(sphere, 500)).empty());
    EXPECT_TRUE(propose_by_principal_frame(table, PrincipalFrameTable(plane, 500)).empty());
}

TEST(ByPrincipalFrame, CancelStopsTheSearch) {
    const Model model = support::model_of({support::smooth_bicubic(8, 1)});
    const PrincipalFrameTable table(model, 5000);
    const Progress progress;
    progress.cancel();
    EXPECT_ANY_THROW(propose_by_principal_frame(table, table, {}, progress));
}

}  // namespace
}  // namespace umbilic
