// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/match.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <umbilic/core/errors.h>
#include <support/surfaces.h>

#include "pose_error.h"

namespace umbilic {
namespace {

using support::model_of;
using support::pose_error;
using support::random_similarity;
using support::rough_bicubic;
using support::smooth_bicubic;
using support::transformed;

/// Model of one surface trimmed to a rectangle of its domain (fractions of its sides).
Model cut_out(const NurbsSurface& surface, double u0, double u1, double v0, double v1) {
    const ParameterBox domain = surface.domain();
    const auto at = [&](double u, double v) {
        return Vector2(domain.u.low + u * domain.u.length(), domain.v.low + v * domain.v.length());
    };
    const std::vector<Vector2> corners = {at(u0, v0), at(u1, v0), at(u1, v1), at(u0, v1)};
    TrimmingLoop loop;
    for (int i = 0; i < 4; ++i)
        loop.push_back({.curve = NurbsCurve2(KnotVector::bezier(1), {corners[i], corners[(i + 1) % 4]})});
    Model model = model_of({surface});
    Face& face = model.faces.front();
    face.region = TrimmingRegion(domain, {loop}, {}, {});
    // Midpoint rule: only the weights of samples depend on it.
    constexpr int parts = 200;
    face.area = 0.0;
    model.box = {};
    for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j) {
            const Vector2 p = at(u0 + (u1 - u0) * (i + 0.5) / parts, v0 + (v1 - v0) * (j + 0.5) / parts);
            const SurfaceDerivatives d = surface.derivatives(p.x(), p.y(), 1);
            face.area += d.r_u().cross(d.r_v()).norm() * (u1 - u0) * (v1 - v0) * domain.u.length() * domain.v.length() /
                         (parts * parts);
            model.box.add(d.r());
        }
    model.area = face.area;
    return model;
}

/// Closed box of six planar faces with its solid, moved.
Model box(const Vector3& sides, const SimilarityTransform& pose) {
    std::vector<NurbsSurface> faces;
    for (int axis = 0; axis < 3; ++axis)
        for (const double at : {0.0, 1.0}) {
            const Vector3 base = at * sides[axis] * Vector3::Unit(axis);
            Vector3 u = Vector3::Zero(), v = Vector3::Zero();
            u[(axis + 1) % 3] = sides[(axis + 1) % 3];
            v[(axis + 2) % 3] = sides[(axis + 2) % 3];
            faces.emplace_back(KnotVector::bezier(1), KnotVector::bezier(1),
                               std::vector<Vector3>{pose.apply(base), pose.apply(base + v), pose.apply(base + u),
                                                    pose.apply(base + u + v)});
        }
    Model model = model_of(std::move(faces));
    for (Face& face : model.faces) {
        face.kind = SurfaceKind::plane;
        face.solid = 0;
        // r_u x r_v runs along the axis, which is outward at its far end; a reflection turns it.
        face.reversed = (face.number % 2 == 1) != pose.mirrored;
    }
    const Vector3 square = pose.scale * pose.scale * sides.cwiseProduct(sides) / 12.0;
    Solid solid;
    solid.volume = std::pow(pose.scale, 3) * sides.prod();
    solid.centroid = pose.apply(0.5 * sides);
    solid.inertia = solid.volume * pose.orthogonal() *
                    Vector3(square.y() + square.z(), square.x() + square.z(), square.x() + square.y()).asDiagonal() *
                    pose.orthogonal().transpose();
    model.solids = {solid};
    model.volume = solid.volume;
    return model;
}

/// Closed prism over a regular polygon of n corners on a circle, along z, with its solid, moved; each base is made of n
/// kites.
Model prism(int n, double radius, double height, const SimilarityTransform& pose) {
    const auto corner = [&](double i, double z) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        return Vector3(radius * std::cos(angle), radius * std::sin(angle), z);
    };
    const auto middle = [&](int i, double z) -> Vector3 { return 0.5 * (corner(i, z) + corner(i + 1, z)); };
    std::vector<NurbsSurface> faces;
    const auto add = [&](const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
        faces.emplace_back(KnotVector::bezier(1), KnotVector::bezier(1),
                           std::vector<Vector3>{pose.apply(a), pose.apply(b), pose.apply(c), pose.apply(d)});
    };
    // The normal r_u x r_v = (c - a) x (b - a) points outwards.
    for (int k = 0; k < n; ++k) {
        add(corner(k, 0), corner(k, height), corner(k + 1, 0), corner(k + 1, height));
        add(Vector3(0, 0, height), middle(k, height), middle(k - 1, height), corner(k, height));
        add(Vector3::Zero(), middle(k - 1, 0), middle(k, 0), corner(k, 0));
    }
    Model model = model_of(std::move(faces));
    for (Face& face : model.faces) {
        face.kind = SurfaceKind::plane;
        face.solid = 0;
        face.reversed = pose.mirrored;
    }
    const double angle = std::numbers::pi / n;
    const double area = 0.5 * n * radius * radius * std::sin(2.0 * angle);
    const double across = 0.25 * radius * radius * (1.0 - 2.0 / 3.0 * std::pow(std::sin(angle), 2));
    const double along = height * height / 12.0;
    Solid solid;
    solid.volume = std::pow(pose.scale, 3) * area * height;
    solid.centroid = pose.apply(Vector3(0, 0, 0.5 * height));
    solid.inertia = solid.volume * pose.scale * pose.scale * pose.orthogonal() *
                    Vector3(across + along, across + along, 2.0 * across).asDiagonal() * pose.orthogonal().transpose();
    model.solids = {solid};
    model.volume = solid.volume;
    return model;
}

FeatureOptions quick() {
    FeatureOptions options;
    options.samples.count = 1500;
    options.umbilics.certificate = false;
    return options;
}

Alignment match_models(const Model& original, const Model& suspect, const MatchOptions& options = {}) {
    return match(prepare(original, quick()), prepare(suspect, quick()), options);
}

TEST(Match, FindsMovedScaledAndMirroredCopies) {
    const double scales[] = {0.05, 0.3, 1.0, 2.54, 20.0};
    for (int i = 0; i < 5; ++i)
        for (const bool mirrored : {false, true}) {
            const NurbsSurface surface = i % 2 == 0 ? smooth_bicubic(8 + 3 * i, 40 + i) : rough_bicubic(8 + 3 * i, i);
            const SimilarityTransform truth = random_similarity(100 + i, scales[i], mirrored);
            const Model original = model_of({surface});
            const Model suspect = model_of({transformed(surface, truth.inverse())});
            const Alignment alignment = match_models(original, suspect);
            SCOPED_TRACE(alignment.why);
            ASSERT_EQ(alignment.status, AlignmentStatus::found);
            EXPECT_EQ(alignment.scope, MatchScope::global);
            EXPECT_EQ(alignment.original_suspect.mirrored, mirrored);
            EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-9);
            EXPECT_NEAR(alignment.original_suspect.scale / truth.scale, 1.0, 1e-9);
            EXPECT_GT(alignment.suspect_coverage, 0.99);
            EXPECT_GT(alignment.original_coverage, 0.99);
            EXPECT_TRUE(alignment.symmetries.empty());
        }
}

TEST(Match, ParametrisationDoesNotMatter) {
    const NurbsSurface surface = smooth_bicubic(10, 3);
    const SimilarityTransform truth = random_similarity(5, 0.8, false);
    const NurbsSurface moved = transformed(surface, truth.inverse());
    const Model original = model_of({surface});
    for (const NurbsSurface& variant : {moved.swapped(), moved.u_reversed(), moved.swapped().u_reversed()}) {
        const Alignment alignment = match_models(original, model_of({variant}));
        SCOPED_TRACE(alignment.why);
        ASSERT_EQ(alignment.status, AlignmentStatus::found);
        EXPECT_FALSE(alignment.original_suspect.mirrored);
        EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-9);
    }
}

TEST(Match, MirrorImagesOnlyWhereAllowed) {
    const NurbsSurface surface = smooth_bicubic(10, 3);
    const SimilarityTransform truth = random_similarity(5, 0.8, true);
    const Model original = model_of({surface}), suspect = model_of({transformed(surface, truth.inverse())});
    EXPECT_TRUE(match_models(original, suspect).original_suspect.mirrored);
    EXPECT_FALSE(match_models(original, suspect, {.mirror = MirrorChoice::never}).found());
}

TEST(Match, FindsAPieceOnItsOriginal) {
    const NurbsSurface surface = rough_bicubic(14, 6);
    const SimilarityTransform truth = random_similarity(9, 3.0, false);
    const Model original = model_of({surface});
    const Model piece = cut_out(transformed(surface, truth.inverse()), 0.3, 0.75, 0.2, 0.7);
    const Alignment alignment = match_models(original, piece);
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    EXPECT_EQ(alignment.scope, MatchScope::partial);
    EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-9);
    EXPECT_GT(alignment.suspect_coverage, 0.99);
    EXPECT_NEAR(alignment.original_coverage, 0.45 * 0.5, 0.05);
}

TEST(Match, FindsTheOriginalInsideALargerSuspect) {
    const NurbsSurface surface = rough_bicubic(14, 6);
    const SimilarityTransform truth = random_similarity(9, 0.4, false);
    const Model original = cut_out(surface, 0.1, 0.5, 0.3, 0.8);
    const Model suspect = model_of({transformed(surface, truth.inverse())});
    const Alignment alignment = match_models(original, suspect);
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-9);
    EXPECT_GT(alignment.original_coverage, 0.99);
}

TEST(Match, FindsACopiedPieceBesideForeignMaterial) {
    const NurbsSurface surface = rough_bicubic(12, 6);
    const SimilarityTransform truth = random_similarity(9, 1.7, false);
    SimilarityTransform beside;
    beside.translation = Vector3(1.5, 0.4, 0.3);
    const Model original = model_of({surface, transformed(rough_bicubic(9, 50), beside)});
    const NurbsSurface foreign = transformed(transformed(rough_bicubic(12, 77), beside), truth.inverse());
    const Model suspect = model_of({transformed(surface, truth.inverse()), foreign});
    const Alignment alignment = match_models(original, suspect);
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    EXPECT_EQ(alignment.scope, MatchScope::partial);
    EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-9);
    EXPECT_NEAR(alignment.suspect_coverage, 0.5, 0.05);
}

TEST(Match, IndependentDesignsAreNotFound) {
    for (unsigned seed = 0; seed < 8; ++seed) {
        const NurbsSurface a = seed % 2 == 0 ? smooth_bicubic(10, seed) : rough_bicubic(10, seed);
        const NurbsSurface b = seed % 2 == 0 ? smooth_bicubic(10, seed + 500) : rough_bicubic(10, seed + 500);
        const Alignment alignment =
            match_models(model_of({a}), model_of({transformed(b, random_similarity(seed, 1.3, false))}));
        SCOPED_TRACE(alignment.why);
        EXPECT_EQ(alignment.status, AlignmentStatus::not_found);
        EXPECT_FALSE(alignment.why.empty());
    }
}

TEST(Match, MirrorSymmetricShapeFitsInBothHands) {
    // Even in x: the reflection x -> -x maps the surface onto itself.
    const NurbsSurface surface = support::graph_patch(4, 3, [](double x, double y) {
        return 0.3 * x * x + 0.15 * y * y - 0.25 * x * x * y + 0.2 * y * y * y - 0.1 * x * x * x * x;
    });
    const SimilarityTransform truth = random_similarity(12, 2.0, false);
    const Alignment alignment = match_models(model_of({surface}), model_of({transformed(surface, truth.inverse())}));
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    EXPECT_FALSE(alignment.original_suspect.mirrored);
    EXPECT_LT(pose_error(alignment.original_suspect, truth, model_of({surface})), 1e-9);
    ASSERT_EQ(alignment.symmetries.size(), 1u);
    EXPECT_TRUE(alignment.symmetries.front().mirrored);
    const SimilarityTransform reflection = compose(alignment.symmetries.front(), alignment.original_suspect.inverse());
    EXPECT_LT((reflection.orthogonal() - Matrix3(Vector3(-1, 1, 1).asDiagonal())).norm(), 1e-9);
}

TEST(Match, APieceBesideForeignMaterialIsFound) {
    const NurbsSurface surface = rough_bicubic(10, 3);
    const SimilarityTransform truth = random_similarity(9, 1.4, false);
    Model piece = cut_out(transformed(surface, truth.inverse()), 0.2, 0.75, 0.3, 0.9);
    Model both = model_of({transformed(smooth_bicubic(10, 77), random_similarity(6, 0.5, false, 2.0))});
    both.faces.push_back(piece.faces.front());
    both.faces.back().number = 2;
    both.area += piece.area;
    both.box.add(piece.box.low);
    both.box.add(piece.box.high);
    const Alignment alignment = match_models(model_of({surface}), both);
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    EXPECT_LT(pose_error(alignment.original_suspect, truth, model_of({surface})), 1e-9);
    EXPECT_LT(alignment.suspect_coverage, 0.6);
}

TEST(Match, ATimeLimitLeavesTheBestPoseSoFar) {
    const NurbsSurface surface = rough_bicubic(10, 3);
    const Model original = model_of({surface});
    const Model suspect = model_of({transformed(surface, random_similarity(4, 1.0, false))});
    MatchOptions options;
    options.seconds = 1e-9;
    const Alignment none = match_models(original, suspect, options);
    EXPECT_EQ(none.status, AlignmentStatus::not_found);
    EXPECT_NE(none.why.find("in the time allowed"), std::string::npos) << none.why;
    options.seconds = 1e9;
    EXPECT_EQ(match_models(original, suspect, options).status, AlignmentStatus::found);
    for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        options.seconds = seconds;
        EXPECT_THROW(match_models(original, suspect, options), InvalidInput);
    }
}

TEST(Match, AFreeTurnStandsForTheSampledTurnsOfATorus) {
    const NurbsSurface torus = support::full_torus(5.0, 2.0);
    const Model original = model_of({torus}),
                suspect = model_of({transformed(torus, random_similarity(7, 1.0, false))});
    const Alignment alignment = match_models(original, suspect);
    SCOPED_TRACE(alignment.why);
    ASSERT_EQ(alignment.status, AlignmentStatus::found);
    ASSERT_EQ(alignment.free_motions.size(), 1u);
    EXPECT_EQ(alignment.free_motions.front().kind, FreeMotionKind::turn);
    // Beside the turn only the torus upside down: no reflection, which is its own turned about.
    ASSERT_EQ(alignment.symmetries.size(), 1u);
    const Vector3 axis =
        compose(alignment.symmetries.front(), alignment.original_suspect.inverse()).apply_direction(Vector3::UnitZ());
    EXPECT_NEAR(axis.z(), -1.0, 1e-9);
}

TEST(Match, FixedScaleRefusesAScaledCopy) {
    const NurbsSurface surface = smooth_bicubic(10, 3);
    const Model original = model_of({surface});
    const Model same = model_of({transformed(surface, random_similarity(5, 1.0, false).inverse())});
    const Model scaled = model_of({transformed(surface, random_similarity(5, 2.0, false).inverse())});
    const MatchOptions fixed{.scale = {ScaleChoice::Kind::fixed}};
    const Alignment alignment = match_models(original, same, fixed);
    ASSERT_TRUE(alignment.found()) << alignment.why;
    EXPECT_EQ(alignment.original_suspect.scale, 1.0);
    EXPECT_FALSE(match_models(original, scaled, fixed).found());
    EXPECT_TRUE(match_models(original, scaled, {.scale = {ScaleChoice::Kind::range, 1.9, 2.1}}).found());
    EXPECT_FALSE(match_models(original, scaled, {.scale = {ScaleChoice::Kind::range, 0.5, 1.5}}).found());
}

TEST(Match, GivenPairsAndInitialPoseAreRefined) {
    const NurbsSurface surface = smooth_bicubic(9, 8);
    const SimilarityTransform truth = random_similarity(6, 1.4, false);
    const Model original = model_of({surface}), suspect = model_of({transformed(surface, truth.inverse())});
    MatchOptions options;
    const double rough = 0.01 * original.size();
    int corner = 0;
    for (const auto& [u, v] : {std::pair(0.0, 0.0), std::pair(1.0, 0.1), std::pair(0.2, 1.0), std::pair(0.9, 0.8)}) {
        const Vector3 p = surface.value(u, v);
        options.pairs.emplace_back(p + rough * Vector3::Unit(corner++ % 3), truth.inverse().apply(p));
    }
    const Alignment by_pairs = match_models(original, suspect, options);
    ASSERT_TRUE(by_pairs.found()) << by_pairs.why;
    EXPECT_EQ(by_pairs.method, MatchMethod::given);
    EXPECT_LT(pose_error(by_pairs.original_suspect, truth, original), 1e-9);

    MatchOptions initial;
    initial.initial = truth;
    initial.initial->translation += Vector3(rough, -rough, rough);
    initial.initial->scale *= 1.02;
    const Alignment by_initial = match_models(original, suspect, initial);
    ASSERT_TRUE(by_initial.found()) << by_initial.why;
    EXPECT_EQ(by_initial.method, MatchMethod::given);
    EXPECT_LT(pose_error(by_initial.original_suspect, truth, original), 1e-9);

    options.pairs.resize(2);
    EXPECT_THROW(match_models(original, suspect, options), InvalidInput);
}

TEST(Match, SurfacesWithoutUmbilicsMatchByTheirCurvature) {
    // Gaussian curvature is negative everywhere: no umbilic. The suspect is a piece.
    const NurbsSurface surface = support::graph_patch(4, 4, [](double x, double y) {
        return 0.5 * x * y + 0.05 * x * x * x - 0.08 * y * y * y + 0.04 * x * x * y + 0.03 * x * x * x * y;
    });
    const SimilarityTransform truth = random_similarity(14, 0.2, true);
    const Model original = model_of({surface});
    const Model piece = cut_out(transformed(surface, truth.inverse()), 0.15, 0.8, 0.3, 0.9);
    for (const MethodChoice method : {MethodChoice::automatic, MethodChoice::curvature}) {
        const Alignment alignment = match_models(original, piece, {.method = method});
        SCOPED_TRACE(alignment.why);
        ASSERT_EQ(alignment.status, AlignmentStatus::found);
        EXPECT_EQ(alignment.method, MatchMethod::curvature);
        EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-9);
    }
}

TEST(Match, BoxesMatchByFacesAndByMomentsInAllTheirSymmetries) {
    const SimilarityTransform identity, place = random_similarity(17, 25.4, false);
    for (const auto& [choice, method] : {std::pair(MethodChoice::automatic, MatchMethod::analytic),
                                         std::pair(MethodChoice::moments, MatchMethod::moments)}) {
        const Alignment moved =
            match_models(box({3, 2, 1}, identity), box({3, 2, 1}, place.inverse()), {.method = choice});
        SCOPED_TRACE(moved.why);
        ASSERT_EQ(moved.status, AlignmentStatus::found);
        EXPECT_EQ(moved.method, method);
        EXPECT_EQ(moved.scope, MatchScope::global);
        EXPECT_FALSE(moved.original_suspect.mirrored);
        EXPECT_NEAR(moved.original_suspect.scale, 25.4, 25.4e-9);
        EXPECT_EQ(moved.symmetries.size(), 7u);
        EXPECT_TRUE(moved.free_motions.empty());

        const Alignment cube =
            match_models(box({2, 2, 2}, identity), box({2, 2, 2}, place.inverse()), {.method = choice});
        SCOPED_TRACE(cube.why);
        ASSERT_EQ(cube.status, AlignmentStatus::found);
        EXPECT_EQ(cube.symmetries.size(), 47u);
    }

    // Two moments of a prism are equal, so its turns are sampled: n of them, turned over too, and their mirrors.
    for (const int n : {3, 5, 6}) {
        const Alignment turned = match_models(prism(n, 2.0, 1.3, identity), prism(n, 2.0, 1.3, place.inverse()),
                                              {.method = MethodChoice::moments});
        SCOPED_TRACE(turned.why);
        ASSERT_EQ(turned.status, AlignmentStatus::found);
        EXPECT_NE(turned.why.find("moments"), std::string::npos);
        EXPECT_EQ(turned.symmetries.size(), 4u * n - 1) << n;
    }

    // Two boxes share edges and angles, never the ratio of their sides.
    EXPECT_FALSE(match_models(box({3, 2, 1}, identity), box({3, 2.4, 1}, identity)).found());
}

TEST(Match, APlaneIsNoEvidence) {
    const NurbsSurface plane = support::graph_patch(1, 1, [](double, double) { return 0.0; });
    const SimilarityTransform pose = random_similarity(2, 2.0, false);
    const Alignment alignment = match_models(model_of({plane}), model_of({transformed(plane, pose)}));
    SCOPED_TRACE(alignment.why);
    EXPECT_NE(alignment.status, AlignmentStatus::found);
    EXPECT_NE(alignment.status, AlignmentStatus::ambiguous);
    EXPECT_FALSE(alignment.why.empty());
}

TEST(Match, SaysWhyNothingApplies) {
    const NurbsSurface cylinder_like = support::graph_patch(3, 1, [](double x, double) { return 0.3 * x * x * x; });
    const NurbsSurface saddle = support::graph_patch(2, 2, [](double x, double y) { return 0.3 * x * y; });
    const Alignment alignment =
        match_models(model_of({cylinder_like}), model_of({saddle}), {.method = MethodChoice::umbilics});
    EXPECT_EQ(alignment.status, AlignmentStatus::not_found);
    EXPECT_NE(alignment.why.find("umbilics"), std::string::npos) << alignment.why;
}

TEST(Match, RejectsMeaninglessOptions) {
    const Model model = model_of({smooth_bicubic(6, 1)});
    EXPECT_THROW(match_models(model, model, {.scale = {ScaleChoice::Kind::range, 2.0, 1.0}}), InvalidInput);
    EXPECT_THROW(match_models(model, model, {.tolerance = -1.0}), InvalidInput);
    MatchOptions options;
    options.initial = SimilarityTransform{.scale = 0.0};
    EXPECT_THROW(match_models(model, model, options), InvalidInput);
    EXPECT_THROW(prepare(Model{}), InvalidInput);
}

TEST(Match, StopsWhenCancelled) {
    const Model model = model_of({smooth_bicubic(8, 1)});
    const PreparedModel prepared = prepare(model, quick());
    int reports = 0;
    const Progress progress([&](double fraction, std::string_view) {
        EXPECT_GE(fraction, 0.0);
        EXPECT_LE(fraction, 1.0);
        return ++reports < 3;
    });
    EXPECT_THROW(match(prepared, prepared, {}, progress), Cancelled);
}

TEST(Match, GivesTheSameResultTwice) {
    const NurbsSurface surface = rough_bicubic(10, 2);
    const Model original = model_of({surface});
    const Model suspect = model_of({transformed(surface, random_similarity(3, 0.5, true))});
    const PreparedModel a = prepare(original, quick()), b = prepare(suspect, quick());
    const Alignment first = match(a, b), second = match(a, b);
    EXPECT_EQ(first.why, second.why);
    EXPECT_EQ(first.original_suspect.scale, second.original_suspect.scale);
    EXPECT_EQ(first.original_suspect.rotation, second.original_suspect.rotation);
    EXPECT_EQ(first.original_suspect.translation, second.original_suspect.translation);
    ASSERT_EQ(first.runners_up.size(), second.runners_up.size());
    for (std::size_t i = 0; i < first.runners_up.size(); ++i)
        EXPECT_EQ(first.runners_up[i].score, second.runners_up[i].score);
}

}  // namespace
}  // namespace umbilic
