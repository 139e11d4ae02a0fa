// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <support/clouds.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/matching/match_points.h>
#include <umbilic/matching/quadric.h>
#include <umbilic/matching/table_ground.h>

namespace umbilic {
namespace {

PointCloud scan(const Model& model, int count, double coverage, double noise, const SimilarityTransform& truth,
                unsigned seed) {
    return support::scan_of(model, {.points = count, .coverage = coverage, .noise = noise}, truth, seed);
}

/// Greatest distance between where two poses take the points, relative to the size.
double pose_error(const PointCloud& cloud, const SimilarityTransform& a, const SimilarityTransform& b, double size) {
    double worst = 0.0;
    for (const Vector3& p : cloud.points) worst = std::max(worst, (a.apply(p) - b.apply(p)).norm() / size);
    return worst;
}

class MatchPoints : public ::testing::Test {
protected:
    const Model model = support::model_of({support::smooth_bicubic(8, 41, 0.3)});
    const PreparedModel original = prepare(model);
};

TEST_F(MatchPoints, FindsWholeNoisyCloudsOfUnknownScaleAndHand) {
    for (const bool mirrored : {false, true}) {
        const SimilarityTransform truth = support::random_similarity(5, 2.4, mirrored);
        const PointCloud cloud = scan(model, 2000, 1.0, 3e-4, truth, 9);
        const PreparedPoints suspect = prepare(cloud);
        const Alignment alignment = match(original, suspect);
        ASSERT_EQ(alignment.status, AlignmentStatus::found) << alignment.why;
        EXPECT_EQ(alignment.method, MatchMethod::points);
        EXPECT_LT(pose_error(cloud, alignment.original_suspect, truth, model.size()), 1e-2);
        EXPECT_NEAR(alignment.original_suspect.scale, 2.4, 0.02 * 2.4);
        EXPECT_GT(alignment.suspect_coverage, 0.95);
        EXPECT_NEAR(suspect.noise * 2.4, 3e-4, 1e-4);
    }
}

TEST_F(MatchPoints, ExactPointsEndExactlyOnTheSurface) {
    const SimilarityTransform truth = support::random_similarity(6, 0.5, false);
    const PointCloud cloud = scan(model, 1500, 0.5, 0.0, truth, 10);
    const Alignment alignment = match(original, prepare(cloud), {.mirror = MirrorChoice::never});
    ASSERT_EQ(alignment.status, AlignmentStatus::found) << alignment.why;
    EXPECT_EQ(alignment.scope, MatchScope::partial);
    EXPECT_LT(pose_error(cloud, alignment.original_suspect, truth, model.size()), 1e-10);
}

TEST_F(MatchPoints, WrongPairsAreLeftOutAndNamed) {
    const SimilarityTransform truth = support::random_similarity(8, 0.7, true);
    const PointCloud cloud = scan(model, 1500, 1.0, 3e-4, truth, 12);
    MatchOptions options;
    for (int k = 0; k < 10; ++k) {
        const Vector3& p = cloud.points[140 * k];
        // The second and the ninth were taken for others.
        options.pairs.emplace_back(truth.apply(k == 1 || k == 8 ? cloud.points[1400 - 140 * k] : p), p);
    }
    const Alignment alignment = match(original, prepare(cloud), options);
    ASSERT_EQ(alignment.status, AlignmentStatus::found) << alignment.why;
    EXPECT_TRUE(alignment.original_suspect.mirrored);
    EXPECT_NE(alignment.why.find("without number 2, 9, which do not agree"), std::string::npos) << alignment.why;
    ASSERT_EQ(alignment.given_pairs.size(), 10u);
    for (int k = 0; k < 10; ++k) EXPECT_EQ(alignment.given_pairs[k].outlier, k == 1 || k == 8) << k;
}

TEST_F(MatchPoints, MeshesAndPointsAgainstPoints) {
    const SimilarityTransform truth = support::random_similarity(7, 1.7, false);
    const PointCloud mesh =
        support::mesh_of(support::transformed(support::smooth_bicubic(8, 41, 0.3), truth.inverse()), 50);
    const PreparedPoints suspect = prepare(mesh);
    EXPECT_TRUE(suspect.oriented);
    const Alignment on_model = match(original, suspect, {.mirror = MirrorChoice::never});
    ASSERT_EQ(on_model.status, AlignmentStatus::found) << on_model.why;
    EXPECT_EQ(on_model.scope, MatchScope::global);
    EXPECT_LT(pose_error(mesh, on_model.original_suspect, truth, model.size()), 1e-8);

    const PointCloud cloud = scan(model, 3000, 1.0, 0.0, {}, 11);
    const Alignment on_points = match(prepare(cloud), suspect, {.mirror = MirrorChoice::never});
    ASSERT_NE(on_points.status, AlignmentStatus::not_found) << on_points.why;
    EXPECT_LT(pose_error(mesh, on_points.original_suspect, truth, model.size()), 1e-2);
}

TEST_F(MatchPoints, AFewForeignPointsFarAwayChangeNothing) {
    const SimilarityTransform truth = support::random_similarity(9, 1.6, false);
    const PointCloud piece = scan(model, 2000, 0.6, 3e-4, truth, 16);
    const PreparedPoints alone = prepare(piece);
    for (const double diagonals : {1.0, 5.0, 20.0, 1000.0}) {
        PointCloud cloud = piece;
        const Vector3 away(diagonals * piece.box().diagonal(), 0.0, 0.0);
        // A clump of three per cent, and one point by itself on the other side.
        for (const Vector3& p : support::sphere_cloud(36, 0.1, 0.0, 5).points) cloud.points.push_back(p + away);
        cloud.points.push_back(-2.0 * away);
        const PreparedPoints suspect = prepare(cloud);
        EXPECT_NEAR(suspect.noise, alone.noise, 0.1 * alone.noise) << diagonals;
        const Alignment alignment = match(original, suspect, {.mirror = MirrorChoice::never});
        ASSERT_EQ(alignment.status, AlignmentStatus::found) << diagonals << ' ' << alignment.why;
        EXPECT_LT(pose_error(piece, alignment.original_suspect, truth, model.size()), 1e-2);
        EXPECT_LT(alignment.suspect_coverage, 0.98) << diagonals;
        if (diagonals >= 5.0) {
            EXPECT_NEAR(suspect.length, alone.length, 1e-6 * alone.length);
        }
    }
    // What lies apart is counted, not forgotten: with 10 % of it no pose lays the points on the original.
    PointCloud cloud = piece;
    for (const Vector3& p : support::sphere_cloud(140, 0.1, 0.0, 6).points)
        cloud.points.push_back(p + Vector3(100, 0, 0));
    EXPECT_EQ(match(original, prepare(cloud), {.mirror = MirrorChoice::never}).status, AlignmentStatus::not_found);
}

TEST_F(MatchPoints, OtherDesignsAreNotFound) {
    for (const unsigned seed : {50u, 51u, 52u}) {
        const Model other = support::model_of({support::smooth_bicubic(8, seed, 0.3)});
        const PointCloud cloud = scan(other, 1500, 1.0, 3e-4, support::random_similarity(seed, 1.3, false), seed);
        const Alignment alignment = match(original, prepare(cloud));
        EXPECT_NE(alignment.status, AlignmentStatus::found) << alignment.why;
        EXPECT_FALSE(alignment.why.empty());
    }
}

TEST_F(MatchPoints, HonoursScaleHandAndGivenPose) {
    const SimilarityTransform truth = support::random_similarity(8, 1.0, false);
    const PointCloud cloud = scan(model, 1500, 0.6, 3e-4, truth, 12);
    const PreparedPoints suspect = prepare(cloud);
    const Alignment fixed = match(original, suspect, {.scale = {ScaleChoice::Kind::fixed}});
    ASSERT_EQ(fixed.status, AlignmentStatus::found) << fixed.why;
    EXPECT_EQ(fixed.original_suspect.scale, 1.0);
    const Alignment wrong = match(original, suspect, {.scale = {ScaleChoice::Kind::range, 2.0, 3.0}});
    EXPECT_NE(wrong.status, AlignmentStatus::found);
    const Alignment given = match(original, suspect, {.initial = truth});
    EXPECT_LT(pose_error(cloud, given.original_suspect, truth, model.size()), 5e-3);
}

TEST_F(MatchPoints, ShapesThatFitManyAreNoEvidence) {
    const Model ball = support::model_of({support::ellipsoid_octant(3, 3, 3)});
    const PointCloud on_ball = scan(ball, 1000, 1.0, 1e-4, {}, 13);
    EXPECT_NE(match(prepare(ball), prepare(on_ball)).status, AlignmentStatus::found);
    const PointCloud flat = support::graph_cloud(
        500, [](double, double) { return 0.0; }, 0.0, 14);
    EXPECT_NE(match(original, prepare(flat)).status, AlignmentStatus::found);
}

TEST_F(MatchPoints, RefusesWhatItCannotUse) {
    PointCloud few;
    few.source.path = "few.xyz";
    few.points.assign(5, Vector3::Zero());
    EXPECT_THROW(prepare(few), InvalidInput);
    PointCloud line;
    for (int i = 0; i < 100; ++i) line.points.emplace_back(i, 0, 0);
    EXPECT_THROW(prepare(line), InvalidInput);
    const PointCloud cloud = scan(model, 500, 1.0, 0.0, {}, 15);
    const PreparedPoints suspect = prepare(cloud);
    for (const MethodChoice method : {MethodChoice::umbilics, MethodChoice::umbilic_lines, MethodChoice::umbilic_kh,
                                      MethodChoice::moments, MethodChoice::analytic, MethodChoice::kh})
        EXPECT_THROW(match(original, suspect, {.method = method}), Unsupported);
    EXPECT_THROW(match(original, original, {.method = MethodChoice::points}), Unsupported);
    EXPECT_THROW(match(original, suspect, {.tolerance = -1.0}), InvalidInput);
    Progress progress;
    progress.cancel();
    EXPECT_THROW(match(original, suspect, {}, progress), Cancelled);
}

TEST(TableGround, IsTheSurfaceToThirdOrder) {
    const Model model = support::model_of({support::smooth_bicubic(8, 3, 0.3)});
    const PrincipalFrameTable coarse(model, 2000), fine(model, 8000);
    const ClosestPointTree tree(model);
    double worst[2] = {};
    for (const AreaSample& sample : area_samples(model, {.count = 300, .seed = 5})) {
        const SurfacePoint at = sample.at;
        if (std::min({at.u, at.v, 1.0 - at.u, 1.0 - at.v}) < 0.1) continue;
        const Vector3 query = sample.curvature.point + 0.02 * sample.curvature.normal;
        const double exact = tree.closest(query)->distance;
        int k = 0;
        for (const PrincipalFrameTable* table : {&coarse, &fine}) {
            const auto foot = TableGround(*table).foot(query, 1.0);
            ASSERT_TRUE(foot && !foot->at_border && foot->normal);
            worst[k] = std::max(worst[k], std::abs(foot->distance - exact));
            EXPECT_NEAR((query - foot->distance * *foot->normal - foot->point).norm() *
                            (query - foot->point).dot(*foot->normal),
                        0.0, 1e-12);
            ++k;
        }
    }
    EXPECT_LT(worst[0], 2e-3);
    EXPECT_LT(worst[1], 0.5 * worst[0]);
    EXPECT_FALSE(TableGround(coarse).foot(Vector3(50, 50, 50), 1.0));
}

TEST(Quadric, DeparturesOfQuadricsAreNothing) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::vector<Vector3> ellipsoid, cylinder, wave;
    for (int i = 0; i < 300; ++i) {
        const Vector3 d = Vector3(normal(random), normal(random), normal(random)).normalized();
        ellipsoid.push_back(Vector3(3 * d.x() + 7, 2 * d.y(), d.z()));
        cylinder.push_back(Vector3(std::hypot(d.x(), d.y()) > 0 ? d.x() / std::hypot(d.x(), d.y()) : 1,
                                   d.y() / std::hypot(d.x(), d.y()), d.z()));
        wave.push_back(Vector3(d.x(), d.y(), 0.1 * std::sin(6 * d.x())));
    }
    EXPECT_LT(departure_from_quadric(ellipsoid), 1e-5);
    EXPECT_LT(departure_from_quadric(cylinder), 1e-5);
    EXPECT_GT(departure_from_quadric(wave), 0.02);
    EXPECT_EQ(departure_from_quadric(std::vector<Vector3>(5, Vector3::Zero())), 0.0);
}

}  // namespace
}  // namespace umbilic
