// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/consistent_pairs.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <umbilic/core/errors.h>
#include <support/surfaces.h>

namespace umbilic {
namespace {

using support::random_similarity;

struct Planted {
    std::vector<PointPair> pairs;
    std::vector<int> wrong;
};

Vector3 gaussian(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random), y = normal(random), z = normal(random);
    return {x, y, z};
}

/// Points of a box of size 1 x 2 x 3 (standard deviations), moved with noise (a part of the moved size); of `wrong`
/// pairs the original's point is another point of the box.
Planted planted(const SimilarityTransform& pose, int count, int wrong, double noise, unsigned seed) {
    std::mt19937 random(seed);
    const auto point = [&] { return Vector3(gaussian(random).cwiseProduct(Vector3(1, 2, 3))); };
    Planted result;
    for (int i = 0; i < count; ++i) {
        const Vector3 p = point();
        result.pairs.push_back({pose.apply(p) + noise * pose.scale * gaussian(random), p});
    }
    while (static_cast<int>(result.wrong.size()) < wrong) {
        const int i = static_cast<int>(random() % static_cast<unsigned>(count));
        if (std::count(result.wrong.begin(), result.wrong.end(), i)) continue;
        const Vector3 elsewhere = point();
        // A pair that is wrong by less than its size may be right by accident.
        if ((elsewhere - result.pairs[i].suspect).norm() < 1.0) continue;
        result.pairs[i].original = pose.apply(elsewhere);
        result.wrong.push_back(i);
    }
    std::sort(result.wrong.begin(), result.wrong.end());
    return result;
}

double pose_error(const SimilarityTransform& a, const SimilarityTransform& b) {
    return std::abs(a.scale / b.scale - 1.0) + (a.rotation - b.rotation).norm() +
           (a.translation - b.translation).norm() / (b.scale + b.translation.norm());
}

TEST(ConsistentPairs, WrongOnesAreFoundWhateverTheirShare) {
    for (const bool free_scale : {true, false})
        for (const bool mirrored : {false, true})
            for (const double noise : {0.0, 1e-4})
                for (const int count : {5, 8, 10, 20, 60})
                    for (const double share : {0.0, 0.1, 0.25, 0.4})
                        for (unsigned seed = 0; seed < 3; ++seed) {
                            const int wrong = static_cast<int>(share * count);
                            const auto pose =
                                random_similarity(100 * seed + count, free_scale ? 0.2 + seed : 1.0, mirrored);
                            const Planted given = planted(pose, count, wrong, noise, 1000 * seed + count + wrong);
                            const ConsistentPointFit fit =
                                fit_consistent_points(given.pairs, {.free_scale = free_scale, .mirrored = mirrored});
                            const std::string trace = std::to_string(count) + " pairs, " + std::to_string(wrong) +
                                                      " wrong, noise " + std::to_string(noise) + ", seed " +
                                                      std::to_string(seed);
                            ASSERT_EQ(fit.outliers, given.wrong) << trace;
                            EXPECT_LT(pose_error(fit.original_suspect, pose), noise > 0.0 ? 20 * noise : 1e-12)
                                << trace;
                            for (const int k : given.wrong) EXPECT_GT(fit.residuals[k], 0.5 * pose.scale) << trace;
                            EXPECT_LT(fit.max, noise > 0.0 ? 6 * noise * pose.scale : 1e-12 * (pose.scale + 10.0))
                                << trace;
                        }
}

TEST(ConsistentPairs, LargeNoiseAloneNamesNone) {
    int named = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const int count = 4 + static_cast<int>(seed % 30);
        const Planted given = planted(random_similarity(seed, 1.5, false), count, 0, 0.1, seed);
        const ConsistentPointFit fit = fit_consistent_points(given.pairs);
        named += !fit.outliers.empty();
        // Then it is the plain least-squares fit.
        if (fit.outliers.empty()) {
            EXPECT_EQ(fit.rms, fit_points(given.pairs).rms) << seed;
        }
    }
    // The chance of a false name is 1e-3 a set: none of 200 is expected, more than two would be a surprise of 1e-3.
    EXPECT_LE(named, 2);
}

TEST(ConsistentPairs, NoiseIsEstimated) {
    const Planted given = planted(random_similarity(3, 2.0, false), 400, 100, 0.01, 7);
    const ConsistentPointFit fit = fit_consistent_points(given.pairs);
    EXPECT_EQ(fit.outliers, given.wrong);
    // 300 right pairs: the standard error of a standard deviation from 900 coordinates is 2.4 %.
    EXPECT_NEAR(fit.deviation, 0.01 * 2.0, 0.1 * 0.02);
}

TEST(ConsistentPairs, ThreePairsAreTakenAsTheyAre) {
    const Planted given = planted(random_similarity(4, 0.7, false), 3, 0, 0.2, 5);
    const ConsistentPointFit fit = fit_consistent_points(given.pairs);
    EXPECT_TRUE(fit.outliers.empty());
    EXPECT_EQ(fit.residuals.size(), 3u);
}

TEST(ConsistentPairs, RightOnesOnALineDoNotSuffice) {
    // Four exact pairs on a line and one beside it: whatever is left out, a pair beside the line must stay.
    const auto pose = random_similarity(8, 1.3, false);
    std::vector<PointPair> pairs;
    for (int i = 0; i < 4; ++i) pairs.push_back({pose.apply(Vector3(i, 0, 0)), Vector3(i, 0, 0)});
    pairs.push_back({pose.apply(Vector3(1, 2, 0)), Vector3(1, 2, 0)});
    const ConsistentPointFit fit = fit_consistent_points(pairs);
    EXPECT_TRUE(fit.outliers.empty());
    EXPECT_LT(pose_error(fit.original_suspect, pose), 1e-12);
    pairs.pop_back();
    EXPECT_THROW(fit_consistent_points(pairs), InvalidInput);
}

TEST(ConsistentPairs, TheOrderOfPairsDoesNotMatter) {
    const auto pose = random_similarity(12, 3.0, true);
    Planted given = planted(pose, 15, 5, 1e-3, 3);
    const ConsistentPointFit fit = fit_consistent_points(given.pairs, {.mirrored = true});
    EXPECT_EQ(fit.outliers, given.wrong);
    std::reverse(given.pairs.begin(), given.pairs.end());
    const ConsistentPointFit reversed = fit_consistent_points(given.pairs, {.mirrored = true});
    ASSERT_EQ(reversed.outliers.size(), fit.outliers.size());
    for (std::size_t k = 0; k < fit.outliers.size(); ++k)
        EXPECT_EQ(reversed.outliers[fit.outliers.size() - 1 - k], 14 - fit.outliers[k]);
    EXPECT_LT(pose_error(fit.original_suspect, reversed.original_suspect), 1e-12);
}

TEST(ConsistentPairs, BadInputIsRefused) {
    const auto pose = random_similarity(1, 1.0, false);
    EXPECT_THROW(fit_consistent_points(planted(pose, 2, 0, 0.0, 1).pairs), InvalidInput);
    Planted given = planted(pose, 6, 0, 0.0, 1);
    given.pairs[2].suspect.y() = std::numeric_limits<double>::infinity();
    EXPECT_THROW(fit_consistent_points(given.pairs), InvalidInput);
}

}  // namespace
}  // namespace umbilic
