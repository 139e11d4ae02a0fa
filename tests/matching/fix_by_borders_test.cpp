// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/fix_by_borders.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <support/surfaces.h>
#include <umbilic/matching/match.h>
#include <umbilic/matching/shared_borders.h>

namespace umbilic {
namespace {

using Polygon = std::vector<Vector2>;

Polygon rectangle(double u0, double u1, double v0, double v1) {
    return {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
}

/// A hole without symmetry.
Polygon window(double u, double v) {
    return {{u, v}, {u + 0.12, v}, {u + 0.12, v + 0.1}, {u + 0.05, v + 0.1}, {u + 0.05, v + 0.3}, {u, v + 0.3}};
}

/// The part of a surface inside the first polygon and outside the others; corners as fractions of the domain's sides.
Model trimmed(const NurbsSurface& surface, const std::vector<Polygon>& polygons) {
    Model model = support::model_of({surface});
    Face& face = model.faces.front();
    const ParameterBox domain = surface.domain();
    std::vector<TrimmingLoop> loops;
    for (const Polygon& polygon : polygons) {
        TrimmingLoop loop;
        const auto corner = [&](std::size_t i) {
            const Vector2& p = polygon[i % polygon.size()];
            return Vector2(domain.u.low + p.x() * domain.u.length(), domain.v.low + p.y() * domain.v.length());
        };
        for (std::size_t i = 0; i < polygon.size(); ++i)
            loop.push_back({.curve = NurbsCurve2(KnotVector::bezier(1), {corner(i), corner(i + 1)})});
        loops.push_back(std::move(loop));
    }
    face.region = TrimmingRegion(domain, loops, {}, {});
    // Midpoint rule: only the weights of samples depend on it.
    constexpr int parts = 200;
    face.area = 0.0;
    model.box = {};
    for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j) {
            const double u = domain.u.low + domain.u.length() * (i + 0.5) / parts;
            const double v = domain.v.low + domain.v.length() * (j + 0.5) / parts;
            if (face.region.classify(u, v) == Containment::outside) continue;
            const SurfaceDerivatives d = surface.derivatives(u, v, 1);
            face.area += d.r_u().cross(d.r_v()).norm() * domain.u.length() * domain.v.length() / (parts * parts);
            model.box.add(d.r());
        }
    model.area = face.area;
    return model;
}

/// A vase: no symmetry but the turn about the z axis.
NurbsSurface vase() {
    return support::revolved(KnotVector(2, {0, 0, 0, 0.5, 1, 1, 1}), {{20, 0}, {34, 30}, {10, 55}, {18, 80}},
                             {1, 1, 1, 1});
}

/// A sheet that slides along x.
NurbsSurface corrugated() {
    return support::graph_patch(1, 4, [](double, double y) { return 0.3 * y * y * y * y - 0.2 * y; });
}

NurbsSurface moved(const NurbsSurface& surface, const SimilarityTransform& truth) {
    return support::transformed(surface, truth.inverse());
}

/// Greatest error of the pose at the corners of the original's box, relative to its size.
double pose_error(const SimilarityTransform& found, const SimilarityTransform& truth, const Model& original) {
    double greatest = 0.0;
    for (const Vector3& corner : {Vector3(original.box.low), Vector3(original.box.high)}) {
        const Vector3 p = truth.inverse().apply(corner);
        greatest = std::max(greatest, (found.apply(p) - corner).norm());
    }
    return greatest / original.size();
}

TEST(FixByBorders, AWindowTellsHowAPieceOfAVaseIsTurned) {
    const Model original = trimmed(vase(), {rectangle(0, 1, 0, 1), window(0.2, 0.3)});
    for (unsigned seed : {1u, 2u, 3u}) {
        const SimilarityTransform truth = support::random_similarity(seed, 0.4, seed == 2u, 100.0);
        const Model suspect = trimmed(moved(vase(), truth), {rectangle(0.08, 0.55, 0.1, 0.85), window(0.2, 0.3)});
        const Alignment alignment = match(prepare(original), prepare(suspect), {});
        EXPECT_EQ(alignment.status, AlignmentStatus::found) << alignment.why;
        EXPECT_LT(pose_error(alignment.original_suspect, truth, original), 1e-5) << alignment.why;
        EXPECT_TRUE(alignment.free_motions.empty());
        EXPECT_NE(alignment.why.find("borders that both share"), std::string::npos) << alignment.why;
    }
}

TEST(FixByBorders, WithoutASharedBorderTheTurnStaysFree) {
    const Model original = trimmed(vase(), {rectangle(0, 1, 0, 1)});
    const SimilarityTransform truth = support::random_similarity(4, 2.5, false, 100.0);
    const Model suspect = trimmed(moved(vase(), truth), {rectangle(0.08, 0.55, 0.1, 0.85), window(0.2, 0.3)});
    const Alignment alignment = match(prepare(original), prepare(suspect), {});
    EXPECT_EQ(alignment.status, AlignmentStatus::compatible) << alignment.why;
    ASSERT_EQ(alignment.free_motions.size(), 1u);
    EXPECT_EQ(alignment.free_motions.front().kind, FreeMotionKind::turn);
}

TEST(FixByBorders, EqualWindowsAroundTheAxisAreAllNamed) {
    std::vector<Polygon> loops = {rectangle(0, 1, 0, 1)};
    for (const double u : {0.05, 0.3, 0.55, 0.8}) loops.push_back(window(u, 0.3));
    const Model original = trimmed(vase(), loops);
    const SimilarityTransform truth = support::random_similarity(5, 1.0, false, 100.0);
    const Model suspect = trimmed(moved(vase(), truth), {rectangle(0.01, 0.24, 0.1, 0.85), window(0.05, 0.3)});
    const Alignment alignment = match(prepare(original), prepare(suspect), {});
    EXPECT_EQ(alignment.status, AlignmentStatus::found) << alignment.why;
    EXPECT_EQ(alignment.symmetries.size(), 3u) << alignment.why;
}

TEST(SharedBorders, OfASlideAreFoundInMillimetres) {
    const NurbsSurface sheet = corrugated();
    const Model original = trimmed(sheet, {rectangle(0, 1, 0, 1), window(0.4, 0.3)});
    const Model suspect = trimmed(sheet, {rectangle(0.217, 0.771, 0.1, 0.9), window(0.4, 0.3)});
    SimilarityTransform off;
    off.translation = Vector3(0.137, 0, 0);
    const FreeMotion slide{.kind = FreeMotionKind::slide, .direction = Vector3::UnitX()};
    const auto borders = shared_borders(slide, off, BorderSamples(original, 1500), BorderSamples(suspect, 1500), 1e-6);
    ASSERT_EQ(borders.size(), 1u);
    EXPECT_NEAR(borders.front().amount, -0.137, 1e-9);
    // The sides of the window across the slide are longer than 0.6 + 0.2 + 0.4 in the plane by the slope; the longest
    // one alone tells nothing.
    EXPECT_GT(borders.front().length, 0.6);
    EXPECT_LT(borders.front().length, 0.7);
}

TEST(SharedBorders, OneEndOfASweepOnAnotherTellsNothing) {
    const NurbsSurface sheet = corrugated();
    const Model original = trimmed(sheet, {rectangle(0, 1, 0, 1)});
    const Model suspect = trimmed(sheet, {rectangle(0.17, 0.83, 0, 1)});
    const auto borders = shared_borders({.kind = FreeMotionKind::slide, .direction = Vector3::UnitX()}, {},
                                        BorderSamples(original, 1500), BorderSamples(suspect, 1500), 1e-6);
    EXPECT_TRUE(borders.empty());
}

TEST(SharedBorders, OfOtherMotionsAreNone) {
    const Model model = trimmed(vase(), {rectangle(0, 1, 0, 1), window(0.2, 0.3)});
    const BorderSamples borders(model, 500);
    EXPECT_TRUE(shared_borders({.kind = FreeMotionKind::size}, {}, borders, borders, 1e-3).empty());
}

}  // namespace
}  // namespace umbilic
