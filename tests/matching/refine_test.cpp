// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/refine.h>
#include <umbilic/matching/score.h>

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <support/surfaces.h>

namespace umbilic {
namespace {

FeatureOptions without_certificate() {
    FeatureOptions options;
    options.samples.count = 600;
    options.umbilics.certificate = false;
    return options;
}

/// A surface, its samples moved back by `truth`, and the ground they belong on.
struct Scene {
    Model model;
    PreparedModel prepared;
    Ground ground;
    SimilarityTransform truth;
    std::vector<WeightedPoint> points;

    Scene(const NurbsSurface& surface, const SimilarityTransform& pose)
        : model(support::model_of({surface})),
          prepared(prepare(model, without_certificate())),
          ground(prepared),
          truth(pose) {
        for (const AreaSample& sample : prepared.features.samples)
            points.push_back({truth.inverse().apply(sample.curvature.point), sample.weight});
    }

    double error(const SimilarityTransform& pose) const {
        double greatest = 0.0;
        for (const WeightedPoint& p : points)
            greatest = std::max(greatest, (pose.apply(p.point) - truth.apply(p.point)).norm());
        return greatest / model.size();
    }

    /// The truth, turned about the middle of the surface, shifted and scaled.
    SimilarityTransform disturbed(double angle, double shift, double factor) const {
        const Vector3 centre = model.box.center();
        const Matrix3 turn = Eigen::AngleAxisd(angle, Vector3(1, 2, 2).normalized()).toRotationMatrix();
        const SimilarityTransform about =
            similarity_from_orthogonal(factor, turn, centre - factor * (turn * centre) + shift * Vector3(0.6, 0, 0.8));
        return compose(about, truth);
    }
};

TEST(Refine, ExactCopiesEndWithinRoundingFromTheWholeBasin) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        const Scene scene(support::smooth_bicubic(9, seed),
                          support::random_similarity(seed, 0.2 * (1 + seed), seed % 2));
        const Refinement refinement = refine(
            scene.ground, scene.points, scene.disturbed(0.25, 0.08, seed % 2 ? 1.15 : 0.87), {.start_cutoff = 0.25});
        EXPECT_TRUE(refinement.converged);
        EXPECT_LT(scene.error(refinement.original_suspect), 1e-12);
        EXPECT_GT(refinement.share, 0.99);
    }
}

TEST(Refine, NoiseDoesNotShrinkTheScale) {
    const Scene clean(support::smooth_bicubic(9, 4), support::random_similarity(4, 3.0, false));
    double sum = 0.0;
    constexpr int trials = 8;
    for (unsigned seed = 0; seed < trials; ++seed) {
        std::mt19937 random(seed);
        std::normal_distribution<double> noise(0.0, 3e-3 / clean.truth.scale);
        std::vector<WeightedPoint> points = clean.points;
        for (WeightedPoint& p : points) p.point += Vector3(noise(random), noise(random), noise(random));
        const Refinement refinement = refine(clean.ground, points, clean.truth);
        const double shift = std::log(refinement.original_suspect.scale / clean.truth.scale);
        EXPECT_LT(std::abs(shift), 5.0 * refinement.scale_deviation);
        EXPECT_NEAR(refinement.rms, 3e-3, 3e-4);
        sum += shift / refinement.scale_deviation;
    }
    EXPECT_LT(std::abs(sum / trials), 5.0 / std::sqrt(trials));
}

/// On a piece that hardly differs from a quadric, undamped steps of Gauss and Newton run away from the truth itself,
/// until the residuals are ten times the noise.
TEST(Refine, HardlyDeterminedMotionsDoNotRunAway) {
    const auto height = [](double x, double y) {
        return -0.25 * x * x - 0.15 * y * y + 0.02 * x * x * x - 0.02 * x * y * y;
    };
    constexpr double deviation = 2e-3;
    const Scene scene(support::graph_patch(3, 3, height), SimilarityTransform{});
    for (unsigned seed = 0; seed < 10; ++seed) {
        std::mt19937 random(seed);
        std::normal_distribution<double> noise(0.0, deviation);
        std::uniform_real_distribution<double> inside(-0.35, 0.35);
        std::vector<WeightedPoint> points;
        for (int k = 0; k < 300; ++k) {
            const double x = inside(random), y = inside(random);
            points.push_back({Vector3(x, y, height(x, y)) + Vector3(noise(random), noise(random), noise(random))});
        }
        const Refinement refinement =
            refine(scene.ground, points, SimilarityTransform{}, {.start_cutoff = 0.05, .hold_borders = true});
        double square = 0.0;
        for (const WeightedPoint& p : points) {
            const auto foot = scene.ground.foot(refinement.original_suspect.apply(p.point), 10.0);
            ASSERT_TRUE(foot);
            square += foot->distance * foot->distance /
                      (refinement.original_suspect.scale * refinement.original_suspect.scale);
        }
        // 300 residuals: their rms is within 4.1 % of the noise in two of three cases; five times that.
        EXPECT_LT(std::sqrt(square / 300), 1.2 * deviation);
    }
}

TEST(Refine, ForeignMaterialHasNoPull) {
    Scene scene(support::smooth_bicubic(9, 4), support::random_similarity(4, 3.0, false));
    const Scene foreign(support::smooth_bicubic(9, 5), scene.truth);
    std::vector<WeightedPoint> points = scene.points;
    for (std::size_t i = 0; i < foreign.points.size(); i += 2) points.push_back(foreign.points[i]);
    const Refinement refinement = refine(scene.ground, points, scene.disturbed(0.05, 0.02, 1.02));
    EXPECT_LT(scene.error(refinement.original_suspect), 1e-12);
    EXPECT_LT(refinement.share, 0.9);
}

TEST(Refine, KnownScaleAndRangeAreKept) {
    const Scene scene(support::smooth_bicubic(9, 4), support::random_similarity(4, 1.0, false));
    const Refinement fixed =
        refine(scene.ground, scene.points, scene.disturbed(0.1, 0.05, 1.0), {.scale = {ScaleChoice::Kind::fixed}});
    EXPECT_EQ(fixed.original_suspect.scale, 1.0);
    EXPECT_LT(scene.error(fixed.original_suspect), 1e-12);
    const Refinement range = refine(scene.ground, scene.points, scene.disturbed(0.05, 0.02, 1.1),
                                    {.scale = {ScaleChoice::Kind::range, 1.05, 1.2}});
    EXPECT_GE(range.original_suspect.scale, 1.05);
    EXPECT_LE(range.original_suspect.scale, 1.2);
}

TEST(Refine, APlaneLeavesSlidingAlone) {
    const Scene scene(support::graph_patch(1, 1, [](double, double) { return 0.0; }), SimilarityTransform{});
    std::vector<WeightedPoint> inner;
    for (WeightedPoint p : scene.points) inner.push_back({0.5 * p.point + Vector3(0.1, 0.05, 0.03), p.weight});
    const Refinement refinement = refine(scene.ground, inner, SimilarityTransform{});
    EXPECT_NEAR(refinement.original_suspect.scale, 1.0, 1e-9);
    EXPECT_LT((refinement.original_suspect.translation - Vector3(0, 0, -0.03)).norm(), 1e-9);
    EXPECT_TRUE(std::isinf(refinement.scale_deviation));
}

}  // namespace
}  // namespace umbilic
