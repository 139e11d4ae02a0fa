// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/horn.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <umbilic/core/errors.h>
#include <support/surfaces.h>

namespace umbilic {
namespace {

using support::random_similarity;

/// Pairs whose suspect points are Gaussian with the given extents along the axes, moved exactly.
std::vector<PointPair> pairs_of(const SimilarityTransform& pose, const Vector3& extents, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<PointPair> pairs;
    for (int i = 0; i < count; ++i) {
        const double x = normal(random), y = normal(random), z = normal(random);
        const Vector3 p = extents.cwiseProduct(Vector3(x, y, z));
        pairs.push_back({pose.apply(p), p, 1.0 + std::abs(normal(random))});
    }
    return pairs;
}

void expect_equal(const SimilarityTransform& a, const SimilarityTransform& b, double tolerance) {
    EXPECT_EQ(a.mirrored, b.mirrored);
    EXPECT_NEAR(a.scale / b.scale, 1.0, tolerance);
    EXPECT_LT((a.rotation - b.rotation).norm(), tolerance);
    EXPECT_LT((a.translation - b.translation).norm(), tolerance * (1.0 + b.translation.norm()));
}

TEST(Horn, RecoversRandomSimilarities) {
    for (unsigned seed = 0; seed < 100; ++seed)
        for (const bool mirrored : {false, true}) {
            const auto pose = random_similarity(seed, std::exp(0.06 * seed - 3.0), mirrored);
            const auto pairs = pairs_of(pose, Vector3(1, 2, 3), 3 + static_cast<int>(seed % 20), seed);
            const PointFit fit = fit_points(pairs, {.mirrored = mirrored});
            expect_equal(fit.original_suspect, pose, 1e-12);
            EXPECT_LT(fit.max, 1e-12 * (pose.scale + 10.0));
        }
}

TEST(Horn, RotationIsProperForPlanarSets) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        const auto pose = random_similarity(seed, 2.0, false);
        const PointFit fit = fit_points(pairs_of(pose, Vector3(1, 1, 0), 6, seed));
        expect_equal(fit.original_suspect, pose, 1e-12);
        EXPECT_NEAR(fit.original_suspect.rotation.determinant(), 1.0, 1e-12);
    }
}

TEST(Horn, NearlyCollinearSetsLoseAccuracyOnlyWithTheSquareOfTheirWidth) {
    for (const double width : {1e-1, 1e-2, 1e-3}) {
        const auto pose = random_similarity(7, 1.5, false, 1.0);
        const PointFit fit = fit_points(pairs_of(pose, Vector3(1, width, width), 10, 3));
        EXPECT_NEAR(fit.original_suspect.rotation.determinant(), 1.0, 1e-12);
        const double conditioning = 1.0 / (width * width);
        expect_equal(fit.original_suspect, pose, 100 * std::numeric_limits<double>::epsilon() * conditioning);
    }
}

TEST(Horn, MirroredSetNeedsItsOwnHypothesis) {
    const auto pose = random_similarity(4, 3.0, true);
    const auto pairs = pairs_of(pose, Vector3(1, 2, 3), 12, 5);
    const PointFit proper = fit_points(pairs);
    EXPECT_NEAR(proper.original_suspect.rotation.determinant(), 1.0, 1e-12);
    EXPECT_FALSE(proper.original_suspect.mirrored);
    EXPECT_GT(proper.rms, 0.1);
    EXPECT_LT(fit_points(pairs, {.mirrored = true}).rms, 1e-12 * 30);
}

TEST(Horn, FixedScaleStaysOne) {
    const auto pose = random_similarity(4, 1.0, false);
    auto pairs = pairs_of(pose, Vector3(1, 2, 3), 12, 5);
    expect_equal(fit_points(pairs, {.free_scale = false}).original_suspect, pose, 1e-12);
    for (PointPair& pair : pairs) pair.original *= 2.0;
    EXPECT_EQ(fit_points(pairs, {.free_scale = false}).original_suspect.scale, 1.0);
    EXPECT_NEAR(fit_points(pairs).original_suspect.scale, 2.0, 1e-12);
}

TEST(Horn, NoSmallMotionImprovesANoisyFit) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0.0, 0.05);
    auto pairs = pairs_of(random_similarity(9, 0.3, false), Vector3(1, 2, 3), 15, 11);
    for (PointPair& pair : pairs) pair.original += Vector3(normal(random), normal(random), normal(random));
    const PointFit fit = fit_points(pairs);
    const auto suspect_rms = [&](const SimilarityTransform& pose) {
        double sum = 0.0;
        for (const PointPair& pair : pairs)
            sum += pair.weight * (pose.apply(pair.suspect) - pair.original).squaredNorm() / (pose.scale * pose.scale);
        return sum;
    };
    const double best = suspect_rms(fit.original_suspect);
    for (unsigned seed = 0; seed < 200; ++seed) {
        const auto other = random_similarity(seed, 1.0 + 1e-3 * (seed % 7 - 3.0), false, 1e-3);
        SimilarityTransform turned = fit.original_suspect;
        turned.scale *= other.scale;
        turned.rotation = fit.original_suspect.rotation;
        turned.translation += other.translation;
        EXPECT_GE(suspect_rms(turned), best);
        const Matrix3 q = Eigen::AngleAxisd(1e-3, other.rotation.col(0)).toRotationMatrix();
        SimilarityTransform rotated = fit.original_suspect;
        rotated.rotation = q * rotated.rotation;
        EXPECT_GE(suspect_rms(rotated), best);
    }
}

TEST(Horn, RejectsWhatDoesNotDetermineThePose) {
    const auto pose = random_similarity(2, 1.0, false);
    EXPECT_THROW(fit_points(pairs_of(pose, Vector3(1, 1, 1), 2, 1)), InvalidInput);
    EXPECT_THROW(fit_points(pairs_of(pose, Vector3(1, 0, 0), 8, 1)), InvalidInput);
    EXPECT_THROW(fit_points(pairs_of(pose, Vector3(0, 0, 0), 8, 1)), InvalidInput);
    auto pairs = pairs_of(pose, Vector3(1, 1, 1), 5, 1);
    pairs[2].suspect.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(fit_points(pairs), InvalidInput);
    pairs = pairs_of(pose, Vector3(1, 1, 1), 5, 1);
    pairs[2].weight = 0.0;
    EXPECT_THROW(fit_points(pairs), InvalidInput);
}

}  // namespace
}  // namespace umbilic
