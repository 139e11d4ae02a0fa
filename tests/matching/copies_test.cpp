// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/copies.h>

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <support/surfaces.h>
#include <umbilic/matching/match.h>

#include "mechanical_shapes.h"
#include "pose_error.h"

namespace umbilic {
namespace {

using support::model_of;
using support::pose_error;
using support::random_similarity;
using support::rough_bicubic;
using support::transformed;

Alignment match_models(const Model& original, const Model& suspect) {
    FeatureOptions quick;
    quick.samples.count = 1500;
    quick.umbilics.certificate = false;
    return match(prepare(original, quick), prepare(suspect, quick));
}

TEST(Copies, EveryOneInsideTheOriginalIsListed) {
    const NurbsSurface surface = rough_bicubic(10, 21);
    const SimilarityTransform second = random_similarity(31, 1.0, false, 3.0), place = random_similarity(8, 0.6, false);
    const Model original = model_of({surface, transformed(surface, second)});
    const Model suspect = model_of({transformed(surface, place.inverse())});
    const Alignment alignment = match_models(original, suspect);
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    ASSERT_EQ(alignment.symmetries.size(), 1u);
    std::vector<double> errors;
    for (const SimilarityTransform& pose : {alignment.original_suspect, alignment.symmetries.front()})
        errors.push_back(
            std::min(pose_error(pose, place, original), pose_error(pose, compose(second, place), original)));
    EXPECT_LT(errors[0], 1e-9);
    EXPECT_LT(errors[1], 1e-9);
    EXPECT_EQ(alignment.copies.size(), 2u);
}

TEST(Copies, InAnAssemblyCountOncePerPlace) {
    // Even in x: each copy fits in both hands, but stands in one place.
    const NurbsSurface surface = support::graph_patch(4, 3, [](double x, double y) {
        return 0.3 * x * x + 0.15 * y * y - 0.25 * x * x * y + 0.2 * y * y * y - 0.1 * x * x * x * x;
    });
    const Model original = model_of({surface});
    std::vector<NurbsSurface> faces = {rough_bicubic(10, 5)};
    for (const int seed : {41, 42, 43})
        faces.push_back(transformed(surface, compose(random_similarity(seed, 1.0, false, 6.0), SimilarityTransform())));
    const Alignment alignment = match_models(original, model_of(faces));
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    EXPECT_EQ(alignment.symmetries.size(), 5u);
    ASSERT_EQ(alignment.copies.size(), 3u);
    for (const int seed : {41, 42, 43}) {
        const Vector3 stands = random_similarity(seed, 1.0, false, 6.0).apply(Vector3(0.5, 0.5, 0.0));
        const auto near = [&](const SimilarityTransform& pose) {
            return std::min((pose.apply(stands) - Vector3(0.5, 0.5, 0.0)).norm(),
                            (pose.apply(stands) - Vector3(-0.5, 0.5, 0.0)).norm()) < 1e-9;
        };
        EXPECT_EQ(std::count_if(alignment.copies.begin(), alignment.copies.end(), near), 1) << seed;
    }
}

/// Faces at the given places, and others around them.
Model assembly(const std::vector<NurbsSurface>& part, const std::vector<SimilarityTransform>& places,
               std::vector<NurbsSurface> others) {
    for (const SimilarityTransform& place : places)
        for (const NurbsSurface& face : support::all_moved(part, place)) others.push_back(face);
    return model_of(others);
}

TEST(Copies, AreFoundWhereAnalyticFacesLeaveAMotionFree) {
    // A neck, about whose axis analytic faces alone may turn, and a free-form body.
    const std::vector<NurbsSurface> part = {support::cylinder({0.5, 0.5, 1.0}, {0, 0, 0.4}, 0.1), rough_bicubic(10, 5)};
    std::vector<SimilarityTransform> places;
    for (const int seed : {41, 42, 43}) places.push_back(random_similarity(seed, 1.0, false, 6.0));
    const Alignment alignment = match_models(model_of(part), assembly(part, places, {}));
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    ASSERT_EQ(alignment.copies.size(), places.size());
    for (const SimilarityTransform& place : places) {
        const auto here = [&](const SimilarityTransform& pose) {
            return (pose.apply(place.apply(Vector3(0.5, 0.5, 0.0))) - Vector3(0.5, 0.5, 0.0)).norm() < 1e-9;
        };
        EXPECT_EQ(std::count_if(alignment.copies.begin(), alignment.copies.end(), here), 1);
    }
}

TEST(Copies, OfABodyOfRevolutionAmongManyPartsAreLaidOnOneOfThem) {
    // A bolt: shaft, head and three rings would fit many shapes, and turn; but it must not go by unnoticed.
    const std::vector<NurbsSurface> bolt = {
        support::cylinder({0, 0, 0}, {0, 0, 40}, 5), support::cylinder({0, 0, 40}, {0, 0, 6}, 9),
        support::frustum({0, 0, 0}, {0, 0, 1e-9}, 0.01, 5), support::frustum({0, 0, 40}, {0, 0, 1e-9}, 9, 5)};
    std::vector<NurbsSurface> others = support::flange();
    for (const NurbsSurface& face : support::all_moved(support::bracket(), random_similarity(3, 1.0, false, 300.0)))
        others.push_back(face);
    std::vector<SimilarityTransform> places;
    for (const int seed : {51, 52, 53}) places.push_back(random_similarity(seed, 1.0, false, 300.0));
    const Alignment alignment = match_models(model_of(bolt), assembly(bolt, places, others));
    SCOPED_TRACE(alignment.why);
    EXPECT_NE(alignment.status, AlignmentStatus::not_found);
    EXPECT_GT(alignment.original_coverage, 0.95);
    EXPECT_NEAR(alignment.original_suspect.scale, 1.0, 1e-6);
}

}  // namespace
}  // namespace umbilic
