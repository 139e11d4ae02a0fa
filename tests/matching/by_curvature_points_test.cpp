// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_curvature_points.h>

#include <cmath>

#include <gtest/gtest.h>

#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/matching/match.h>

namespace umbilic {
namespace {

using support::model_of;
using support::random_similarity;
using support::transformed;

/// Greatest displacement, relative to the original's size, between two poses of points around the suspect.
double pose_error(const SimilarityTransform& found, const SimilarityTransform& truth, const Model& original) {
    const Vector3 centre = original.box.center();
    double greatest = 0.0;
    for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}) {
        const Vector3 p = truth.inverse().apply(centre + 0.5 * original.size() * offset);
        greatest = std::max(greatest, (found.apply(p) - truth.apply(p)).norm());
    }
    return greatest / original.size();
}

FeatureOptions quick() {
    FeatureOptions options;
    options.samples.count = 1500;
    options.umbilics.certificate = false;
    return options;
}

/// No umbilics: Gaussian curvature is negative everywhere.
NurbsSurface saddle() {
    return support::graph_patch(4, 4, [](double x, double y) {
        return 0.5 * x * y + 0.05 * x * x * x - 0.08 * y * y * y + 0.04 * x * x * y + 0.03 * x * x * x * y;
    });
}

NurbsSurface piece_of(const NurbsSurface& surface) {
    const ParameterBox domain = surface.domain();
    const auto part = [](const ParameterInterval& whole, double from, double to) {
        return ParameterInterval{whole.low + from * whole.length(), whole.low + to * whole.length()};
    };
    return support::restricted(surface, {part(domain.u, 0.15, 0.8), part(domain.v, 0.3, 0.9)});
}

TEST(ByCurvaturePoints, SeedsAreWellConditionedAndSpread) {
    const Model model = model_of({support::smooth_bicubic(12, 3)});
    const PreparedModel prepared = prepare(model, quick());
    const std::vector<CurvatureSeed> seeds = choose_curvature_seeds(prepared, 8);
    ASSERT_EQ(seeds.size(), 8u);
    for (std::size_t k = 0; k < seeds.size(); ++k) {
        EXPECT_LT(seeds[k].sensitivity, 2.0 * model.size());
        for (std::size_t j = 0; j < k; ++j)
            EXPECT_GT((seeds[k].curvature.point - seeds[j].curvature.point).norm(), 0.05 * model.size());
    }
    EXPECT_TRUE(choose_curvature_seeds(prepare(model_of({support::full_torus(3.0, 1.0)}), quick()), 8).empty());
}

TEST(ByCurvaturePoints, KnownScaleFindsWholesAndPiecesOfEitherHand) {
    for (const NurbsSurface& surface : {saddle(), support::smooth_bicubic(12, 3)})
        for (const bool mirrored : {false, true})
            for (const bool whole : {false, true}) {
                const SimilarityTransform truth = random_similarity(14, 1.0, mirrored);
                const Model original = model_of({surface});
                const NurbsSurface copy = transformed(whole ? surface : piece_of(surface), truth.inverse());
                const Model suspect = model_of({copy});
                const PreparedModel a = prepare(original, quick()), b = prepare(suspect, quick());
                const Alignment alignment =
                    match(a, b, {.method = MethodChoice::kh, .scale = {.kind = ScaleChoice::Kind::fixed}});
                SCOPED_TRACE(alignment.why);
                ASSERT_TRUE(alignment.found());
                EXPECT_EQ(alignment.method, MatchMethod::kh);
                EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-9);
            }
}

TEST(ByCurvaturePoints, ReapproximatedAndReversedCopiesAreFound) {
    const NurbsSurface surface = support::smooth_bicubic(12, 3);
    const SimilarityTransform truth = random_similarity(4, 1.0, false);
    const Model original = model_of({surface});
    const double size = original.size();
    const support::Reapproximated copy = support::reapproximated(support::u_backwards(surface).surface, 5, 1e-4 * size);
    const Model suspect = model_of({transformed(copy.surface, truth.inverse())});
    const Alignment alignment = match(prepare(original, quick()), prepare(suspect, quick()),
                                      {.method = MethodChoice::kh, .scale = {.kind = ScaleChoice::Kind::fixed}});
    SCOPED_TRACE(alignment.why);
    ASSERT_TRUE(alignment.found());
    EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-3);
}

TEST(ByCurvaturePoints, ScaleIsFoundInABracketByBothSearches) {
    const NurbsSurface surface = saddle();
    for (const double scale : {0.45, 1.7}) {
        const SimilarityTransform truth = random_similarity(21, scale, scale > 1.0);
        const Model original = model_of({surface});
        const Model suspect = model_of({transformed(piece_of(surface), truth.inverse())});
        const PreparedModel a = prepare(original, quick()), b = prepare(suspect, quick());
        for (const ScaleSearch search : {ScaleSearch::golden_section, ScaleSearch::brent}) {
            const Alignment alignment = match(
                a, b,
                {.method = MethodChoice::kh, .scale = {ScaleChoice::Kind::range, 0.3, 3.0}, .scale_search = search});
            SCOPED_TRACE(alignment.why);
            ASSERT_TRUE(alignment.found());
            EXPECT_NEAR(alignment.original_suspect.scale, scale, 1e-8 * scale);
            EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-8);
        }
    }
}

TEST(ByCurvaturePoints, WithoutABracketTheSizesGiveOne) {
    const SimilarityTransform truth = random_similarity(22, 8.0, false);
    const Model original = model_of({saddle()});
    const Model suspect = model_of({transformed(piece_of(saddle()), truth.inverse())});
    const Alignment alignment =
        match(prepare(original, quick()), prepare(suspect, quick()), {.method = MethodChoice::kh});
    SCOPED_TRACE(alignment.why);
    ASSERT_TRUE(alignment.found());
    EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-8);
}

TEST(ByCurvaturePoints, TheSolversOfTheThesisFindTheSamePose) {
    const SimilarityTransform truth = random_similarity(23, 1.0, false);
    const Model original = model_of({saddle()});
    const Model suspect = model_of({transformed(support::u_backwards(saddle()).surface, truth.inverse())});
    const PreparedModel a = prepare(original, quick()), b = prepare(suspect, quick());
    for (const CurvatureSolver solver :
         {CurvatureSolver::direct, CurvatureSolver::auxiliary, CurvatureSolver::approximated}) {
        const Alignment alignment = match(
            a, b,
            {.method = MethodChoice::kh, .scale = {.kind = ScaleChoice::Kind::fixed}, .curvature_solver = solver});
        SCOPED_TRACE(alignment.why);
        ASSERT_TRUE(alignment.found());
        EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-9);
    }
}

TEST(ByCurvaturePoints, SaysWhyNothingCanBeProposed) {
    const Model torus = model_of({support::full_torus(3.0, 1.0)}), free_form = model_of({saddle()});
    const PreparedModel a = prepare(torus, quick()), b = prepare(free_form, quick());
    const CurvaturePointMatching known{.scale = {.kind = ScaleChoice::Kind::fixed}};
    const Proposals on_torus = poses_by_curvature_points(a, b, known);
    EXPECT_TRUE(on_torus.poses.empty());
    EXPECT_NE(on_torus.why.find("the original has no face"), std::string::npos) << on_torus.why;
    EXPECT_NE(poses_by_curvature_points(b, a, known).why.find("the suspect has no face"), std::string::npos);
}

}  // namespace
}  // namespace umbilic
