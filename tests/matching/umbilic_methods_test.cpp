// SPDX-License-Identifier: LGPL-2.1-or-later
// Matching by umbilics: the complete method beside the two of the thesis (4.7.1).
#include <umbilic/matching/by_umbilic_lines.h>
#include <umbilic/matching/by_umbilics.h>

#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <umbilic/matching/horn.h>
#include <umbilic/matching/match.h>
#include <support/reparametrisation.h>
#include <support/surfaces.h>

namespace umbilic {
namespace {

using support::model_of;
using support::random_similarity;
using support::transformed;

FeatureOptions quick() {
    FeatureOptions options;
    options.samples.count = 1500;
    options.umbilics.certificate = false;
    return options;
}

/// Greatest displacement between the two poses of the suspect's samples, relative to the original's size.
double pose_error(const SimilarityTransform& found, const SimilarityTransform& truth, const PreparedModel& suspect,
                  const Model& original) {
    double greatest = 0.0;
    for (const AreaSample& sample : suspect.features.samples)
        greatest =
            std::max(greatest, (found.apply(sample.curvature.point) - truth.apply(sample.curvature.point)).norm());
    return greatest / original.size();
}

Alignment by(MethodChoice method, const PreparedModel& original, const PreparedModel& suspect) {
    return match(original, suspect, {.method = method});
}

NurbsSurface patch_of(std::complex<double> omega, double kappa) {
    const Cubic c = cubic_of_omega(omega);
    return support::monge_patch(kappa, c.a, c.b, c.c, c.d);
}

TEST(UmbilicMethods, AllAgreeOnExactCopies) {
    for (const unsigned seed : {1u, 2u})
        for (const bool mirrored : {false, true}) {
            const NurbsSurface surface = seed == 1 ? support::table_3_1_patch() : support::smooth_bicubic(10, 3);
            const SimilarityTransform truth = random_similarity(seed, 0.4 * seed * seed, mirrored);
            const Model original_model = model_of({surface});
            const Model suspect_model = model_of({transformed(surface, truth.inverse())});
            const PreparedModel original = prepare(original_model, quick()), suspect = prepare(suspect_model, quick());
            for (const MethodChoice method :
                 {MethodChoice::umbilics, MethodChoice::umbilic_lines, MethodChoice::umbilic_kh}) {
                const Alignment alignment = by(method, original, suspect);
                SCOPED_TRACE(alignment.why);
                ASSERT_TRUE(alignment.found());
                double error = pose_error(alignment.original_suspect, truth, suspect, original_model);
                for (const SimilarityTransform& symmetric : alignment.symmetries)
                    error = std::min(error, pose_error(symmetric, truth, suspect, original_model));
                EXPECT_LT(error, 1e-9);
            }
        }
}

TEST(UmbilicMethods, OneUmbilicGivesThePoseByItsNormalAndLines) {
    // One star: three directions, two senses, both hands, both orientations of an open surface.
    const NurbsSurface surface = support::restricted(patch_of({0.5, 0.4}, 0.8), {{0.3, 0.7}, {0.3, 0.7}});
    const SimilarityTransform truth = random_similarity(4, 2.5, false);
    const Model original_model = model_of({surface});
    const Model suspect_model = model_of({transformed(surface, truth.inverse())});
    const PreparedModel original = prepare(original_model, quick()), suspect = prepare(suspect_model, quick());
    ASSERT_EQ(umbilic_marks(original_model, original.features).size(), 1u);
    const Proposals proposals = poses_by_umbilic_lines(original, suspect, {}, MirrorChoice::never, 0.15);
    double least = 1.0;
    for (const PoseHypothesis& pose : proposals.poses)
        least = std::min(least, pose_error(pose.original_suspect, truth, suspect, original_model));
    EXPECT_LT(least, 1e-8) << proposals.why;
    // Only one of the six poses is right: the same umbilic under the wrong direction is elsewhere.
    EXPECT_EQ(proposals.poses.size(), 6u) << proposals.why;
}

TEST(UmbilicMethods, PairsByOmegaObeyTheThesis) {
    UmbilicMark a, b;
    a.type = b.type = UmbilicType::star;
    a.kappa = 2.0;
    b.kappa = 3.0;
    a.omega = std::complex<double>(0.2, 0.3);
    // Another of the three values of the same omega, a little off.
    b.omega = *a.omega * std::polar(1.0, 2 * std::numbers::pi / 3) + 0.01;
    const auto pairs = pairs_by_omega({a}, {b}, 0.1);
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_NEAR(pairs[0].distance, 0.01, 1e-12);
    EXPECT_DOUBLE_EQ(pairs[0].scale, 1.5);
    EXPECT_TRUE(pairs_by_omega({a}, {b}, 0.005).empty());
    b.kappa = -3.0;
    EXPECT_TRUE(pairs_by_omega({a}, {b}, 0.1).empty());
    EXPECT_EQ(pairs_by_omega({a}, {flipped(b)}, 1.0).size(), 1u);
    b.kappa = 3.0;
    b.flat = true;
    EXPECT_TRUE(pairs_by_omega({a}, {b}, 0.1).empty());
    b.flat = false;
    b.type = UmbilicType::lemon;
    EXPECT_TRUE(pairs_by_omega({a}, {b}, 0.1).empty());
    a.type = b.type = UmbilicType::non_generic;
    EXPECT_TRUE(pairs_by_omega({a}, {b}, 0.1).empty());
    a.type = b.type = UmbilicType::star;
    b.omega.reset();
    EXPECT_TRUE(pairs_by_omega({a}, {b}, 0.1).empty());
}

TEST(UmbilicMethods, UmbilicsOfQuadricsAndFlatOnesAreBeyondTheThesis) {
    // alpha = 0 as on every quadric; kappa = 0. The pieces are small enough to hold one umbilic.
    for (const NurbsSurface& whole : {support::monge_patch(1.0, 3.0, 0.0, 1.0, 0.0), patch_of({0.5, 0.4}, 0.0)}) {
        const NurbsSurface surface = support::restricted(whole, {{0.35, 0.7}, {0.3, 0.65}});
        const SimilarityTransform truth = random_similarity(9, 0.3, false);
        const Model original_model = model_of({surface});
        const Model suspect_model = model_of({transformed(surface, truth.inverse())});
        const PreparedModel original = prepare(original_model, quick()), suspect = prepare(suspect_model, quick());
        ASSERT_EQ(umbilic_marks(original_model, original.features).size(), 1u);
        EXPECT_TRUE(poses_by_umbilic_lines(original, suspect, {}, MirrorChoice::automatic, 0.15).poses.empty());
        EXPECT_TRUE(poses_by_umbilic_scale(original, suspect, {}, 0.15).poses.empty());
        const Proposals ours = poses_by_umbilics(original, suspect, {}, MirrorChoice::automatic, 0.15);
        double least = 1.0;
        for (const PoseHypothesis& pose : ours.poses)
            least = std::min(least, pose_error(pose.original_suspect, truth, suspect, original_model));
        EXPECT_LT(least, 1e-8) << ours.why;
    }
}

TEST(UmbilicMethods, TypesThatChangeAcrossADividingCurveAreSurvived) {
    // A monstar inside Gamma_2, a lemon outside; the cubics differ by a thousandth, the surfaces by less.
    const auto piece = [](double factor) {
        const std::complex<double> on_gamma_2 = -(std::polar(2.0, 0.5) + std::polar(1.0, -1.0));
        return support::restricted(patch_of(factor * on_gamma_2, 0.6), {{0.4, 0.65}, {0.35, 0.6}});
    };
    const SimilarityTransform truth = random_similarity(15, 1.7, true);
    const Model original_model = model_of({piece(0.9995)});
    const Model suspect_model = model_of({transformed(piece(1.0005), truth.inverse())});
    const PreparedModel original = prepare(original_model, quick()), suspect = prepare(suspect_model, quick());
    const auto at_origin = [](const PreparedModel& prepared, const Vector3& place) {
        for (const UmbilicMark& mark : umbilic_marks(prepared.model, prepared.features))
            if ((mark.point - place).norm() < 1e-6) return mark;
        ADD_FAILURE() << "no umbilic";
        return UmbilicMark();
    };
    const UmbilicMark monstar = at_origin(original, Vector3::Zero());
    const UmbilicMark lemon = at_origin(suspect, truth.inverse().apply(Vector3::Zero()));
    EXPECT_EQ(monstar.type, UmbilicType::monstar);
    EXPECT_EQ(lemon.type, UmbilicType::lemon);
    EXPECT_TRUE(pairs_by_omega({monstar}, {mirrored(lemon)}, 0.15).empty());
    const Alignment alignment = by(MethodChoice::umbilics, original, suspect);
    EXPECT_EQ(alignment.method, MatchMethod::umbilics) << alignment.why;
    double error = pose_error(alignment.original_suspect, truth, suspect, original_model);
    for (const SimilarityTransform& symmetric : alignment.symmetries)
        error = std::min(error, pose_error(symmetric, truth, suspect, original_model));
    EXPECT_LT(error, 1e-3) << alignment.why;
}

TEST(UmbilicMethods, APieceAmongForeignUmbilicsIsFound) {
    const NurbsSurface surface = support::smooth_bicubic(12, 3);
    const NurbsSurface foreign = support::smooth_bicubic(12, 8);
    const SimilarityTransform truth = random_similarity(16, 0.8, false);
    const Model original_model = model_of({surface});
    const NurbsSurface piece = support::restricted(surface, {{0.2, 0.9}, {0.1, 0.7}});
    SimilarityTransform beside;
    beside.translation = Vector3(3, 0, 0);
    const Model suspect_model =
        model_of({transformed(piece, truth.inverse()), transformed(foreign, compose(truth.inverse(), beside))});
    const PreparedModel original = prepare(original_model, quick()), suspect = prepare(suspect_model, quick());
    const Alignment alignment = by(MethodChoice::umbilics, original, suspect);
    SCOPED_TRACE(alignment.why);
    ASSERT_TRUE(alignment.found());
    EXPECT_EQ(alignment.scope, MatchScope::partial);
    EXPECT_LT(pose_error(alignment.original_suspect, truth, suspect, original_model), 1e-8);
}

TEST(UmbilicMethods, ErrorsOfInvariantsWidenTheTolerance) {
    UmbilicMark a, b;
    a.alpha = b.alpha = {1.0, 0.0};
    a.delta = 0.2;
    b.delta = 0.6;
    EXPECT_FALSE(may_correspond(a, b, 0.15));
    a.delta_error = 0.1;
    EXPECT_FALSE(may_correspond(a, b, 0.15));
    b.delta_error = 0.16;
    EXPECT_TRUE(may_correspond(a, b, 0.15));
    b.zeta = {0.0, 0.3};
    EXPECT_FALSE(may_correspond(a, b, 0.15));
    b.zeta_error = 0.2;
    EXPECT_TRUE(may_correspond(a, b, 0.15));
    b.kappa = 1.0;  // bend pi / 4 instead of 0
    EXPECT_FALSE(may_correspond(a, b, 0.15));
    a.bend_error = 0.7;
    EXPECT_TRUE(may_correspond(a, b, 0.15));

    // Errors of computed umbilics are those of rounding.
    const Model model = model_of({support::smooth_bicubic(10, 3)});
    for (const UmbilicMark& mark : umbilic_marks(model, prepare(model, quick()).features)) {
        EXPECT_GT(mark.bend_error, 0.0);
        EXPECT_LT(mark.bend_error, 1e-3);
    }
}

TEST(UmbilicMethods, SteadyUmbilicsCountMore) {
    // Umbilics displaced by normal errors of a standard deviation of 0.01 over their steadiness.
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto vector = [&] {
        const double x = normal(random), y = normal(random), z = normal(random);
        return Vector3(x, y, z);
    };
    double weighted = 0.0, plain = 0.0;
    constexpr int trials = 200;
    for (int trial = 0; trial < trials; ++trial) {
        const SimilarityTransform truth = random_similarity(trial, 1.6, false);
        std::vector<std::pair<UmbilicMark, UmbilicMark>> pairs;
        std::vector<PointPair> points;
        for (int k = 0; k < 8; ++k) {
            UmbilicMark suspect;
            suspect.point = vector();
            suspect.normal = vector().normalized();
            suspect.beta = {0.0, 0.0};
            suspect.alpha = {k < 4 ? 1.0 : 0.05, 0.0};
            UmbilicMark original = suspect;
            original.alpha /= truth.scale * truth.scale;
            original.point = truth.apply(suspect.point) + 0.01 / suspect.steadiness() * vector();
            original.normal = truth.apply_direction(suspect.normal);
            pairs.emplace_back(original, suspect);
            points.push_back({original.point, suspect.point});
            points.push_back({original.point + truth.scale * original.normal, suspect.point + suspect.normal});
        }
        const auto error = [&](const SimilarityTransform& pose) {
            return (pose.scale * pose.rotation - truth.scale * truth.rotation).squaredNorm();
        };
        const auto pose = pose_from_pairs(pairs, truth, 2.0, true);
        ASSERT_TRUE(pose);
        weighted += error(*pose);
        plain += error(fit_points(points).original_suspect);
    }
    // Half of the pairs are twenty times less steady: what they add drowns the others if all count alike.
    EXPECT_LT(std::sqrt(weighted), 0.3 * std::sqrt(plain));
    const UmbilicMark lone{.beta = {1.0, 0.0}};
    EXPECT_FALSE(pose_from_pairs(std::vector{std::pair(lone, lone)}, {}, 1.0, true));
}

}  // namespace
}  // namespace umbilic
