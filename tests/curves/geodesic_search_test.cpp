// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <support/surfaces.h>
#include <tbb/global_control.h>
#include <umbilic/core/errors.h>
#include <umbilic/curves/geodesic.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Model closed_model(NurbsSurface surface, bool v_closed = false) {
    Model model = support::model_of({std::move(surface)});
    model.faces[0].u_closed = model.faces[0].u_periodic = true;
    model.faces[0].v_closed = model.faces[0].v_periodic = v_closed;
    return model;
}

NurbsCurve2 segment(Vector2 from, Vector2 to) {
    return NurbsCurve2(KnotVector::bezier(1), {from, to});
}

/// The direction in which a curve leaves its start.
Vector3 start_direction(const Model& model, const SurfaceCurve& curve) {
    const SurfacePoint& at = curve.points.front().at;
    const SurfaceDerivatives d = model.face(at.face).surface.derivatives(at.u, at.v, 1);
    const Vector3 n = unit_normal(d);
    // The second point lies on the osculating circle: its chord is off by half the turn in the normal plane only.
    const Vector3 chord = curve.points[1].point - curve.points[0].point;
    return (chord - chord.dot(n) * n).normalized();
}

TEST(GeodesicSearch, FindsBothArcsOfAGreatCircle) {
    const double radius = 2.0;
    const Model model = closed_model(support::full_sphere(radius));
    const SurfacePoint a{1, 0.3, 0.8}, b{1, 1.4, 1.3};
    const GeodesicSearch found = geodesics_between(model, a, b);
    const NurbsSurface& sphere = model.faces[0].surface;
    const double angle = std::acos(sphere.value(a.u, a.v).dot(sphere.value(b.u, b.v)) / (radius * radius));
    ASSERT_EQ(found.curves.size(), 2u) << found.why;
    EXPECT_NEAR(found.curves[0].length, radius * angle, 1e-7);
    EXPECT_NEAR(found.curves[1].length, radius * (2 * pi - angle), 1e-7);
    for (const SurfaceCurve& curve : found.curves) {
        EXPECT_EQ(curve.ended, CurveEnd::point);
        EXPECT_LE((curve.points.back().point - sphere.value(b.u, b.v)).norm(), 1e-7);
        EXPECT_EQ(curve.points.front().at.u, a.u);
        EXPECT_EQ(curve.points.back().at.v, b.v);
    }
}

TEST(GeodesicSearch, FindsTheHelicesOnACylinder) {
    const double radius = 1.0, height = 3.0;
    const Model model = closed_model(support::full_cone(radius, radius, height));
    // From longitude 0 to 90 degrees, 1.2 mm higher.
    const GeodesicSearch found = geodesics_between(model, {1, 0.0, 0.2}, {1, 1.0, 0.6}, {.longest = 12.0});
    std::vector<double> expected;
    for (int turns = -3; turns <= 3; ++turns) {
        const double length = std::hypot(radius * (pi / 2 + 2 * pi * turns), 0.4 * height);
        if (length <= 12.0) expected.push_back(length);
    }
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(found.curves.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found.curves[i].length, expected[i], 1e-7);
}

TEST(GeodesicSearch, OppositePointsOfASphereHaveMany) {
    const Model model = closed_model(support::full_sphere(1.0));
    const GeodesicSearch found = geodesics_between(model, {1, 0.5, 0.9}, {1, 2.5, 1.1}, {.longest = 3.5, .most = 8});
    ASSERT_EQ(found.curves.size(), 8u);
    for (const SurfaceCurve& curve : found.curves) EXPECT_NEAR(curve.length, pi, 1e-6);
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_LT(start_direction(model, found.curves[i]).dot(start_direction(model, found.curves[j])), 1 - 1e-6);
}

TEST(GeodesicSearch, AgreesWithTheInitialValueProblem) {
    const Model model = support::model_of({support::smooth_bicubic(9, 3)});
    const GeodesicSearch found = geodesics_between(model, {1, 0.15, 0.2}, {1, 0.8, 0.7});
    ASSERT_FALSE(found.curves.empty()) << found.why;
    for (const SurfaceCurve& curve : found.curves) {
        const Vector2 start(curve.points.front().at.u, curve.points.front().at.v);
        // A first guess of the direction from the chord, improved by the miss at the end.
        Vector3 direction = start_direction(model, curve);
        const Vector3 normal = unit_normal(model.faces[0].surface.derivatives(start.x(), start.y(), 1));
        Vector3 end;
        for (int i = 0; i < 8; ++i) {
            const SurfaceCurve shot = geodesic(model.faces[0], start, direction, curve.length);
            end = shot.points.back().point;
            const Vector3 side = normal.cross(direction);
            const SurfaceCurve turned =
                geodesic(model.faces[0], start, std::cos(1e-5) * direction + std::sin(1e-5) * side, curve.length);
            const Vector3 move = (turned.points.back().point - end) / 1e-5;
            const double turn = (curve.points.back().point - end).dot(move) / move.squaredNorm();
            direction = std::cos(turn) * direction + std::sin(turn) * side;
        }
        EXPECT_LE((curve.points.back().point - end).norm(), 1e-8);
        EXPECT_LE((curve.points.back().point - model.faces[0].surface.value(0.8, 0.7)).norm(), 1e-8);
    }
}

TEST(GeodesicSearch, GoesOverAnEdgeAsOverTheWholeSurface) {
    const auto height = [](double x, double y) { return 0.3 * x * x - 0.2 * x * y * y + 0.1 * y; };
    const NurbsSurface whole = support::graph_patch(2, 2, height);
    const auto half = [&](double middle) {
        const NurbsSurface graph =
            support::graph_patch(2, 2, [&](double x, double y) { return height(middle + 0.5 * x, y); });
        std::vector<Vector3> poles;
        for (const Vector3& p : graph.poles()) poles.emplace_back(middle + 0.5 * p.x(), p.y(), p.z());
        return NurbsSurface(graph.u_knots(), graph.v_knots(), poles);
    };
    const Model one = support::model_of({whole});
    const Model two = support::model_of({half(-0.5), half(0.5)});
    const FaceAdjacency adjacency = face_adjacency(two);
    const SmoothJoins joins = smooth_joins(adjacency);
    const ParameterBox box = whole.domain();
    const auto at = [&](double x, double y) {
        return Vector2(box.u.low + 0.5 * (x + 1) * box.u.length(), box.v.low + 0.5 * (y + 1) * box.v.length());
    };
    const Vector2 a = at(-0.5, -0.4), b = at(0.6, 0.3);
    const GeodesicSearch expected = geodesics_between(one, {1, a.x(), a.y()}, {1, b.x(), b.y()});
    const Vector2 a_half = at(0.0, -0.4), b_half = at(0.2, 0.3);
    const GeodesicSearch found =
        geodesics_between(two, {1, a_half.x(), a_half.y()}, {2, b_half.x(), b_half.y()}, {.joins = &joins});
    ASSERT_EQ(expected.curves.size(), 1u);
    ASSERT_EQ(found.curves.size(), 1u) << found.why;
    EXPECT_NEAR(found.curves[0].length, expected.curves[0].length, 1e-8);

    const GeodesicSearch none = geodesics_between(two, {1, a_half.x(), a_half.y()}, {2, b_half.x(), b_half.y()});
    EXPECT_TRUE(none.curves.empty());
    EXPECT_NE(none.why.find("different faces"), std::string::npos);
}

TEST(GeodesicSearch, PointsOnDifferentComponentsHaveNone) {
    SimilarityTransform away;
    away.translation = Vector3(5, 0, 0);
    const NurbsSurface patch = support::smooth_bicubic(6, 2);
    const Model model = support::model_of({patch, support::transformed(patch, away)});
    const FaceAdjacency adjacency = face_adjacency(model);
    const SmoothJoins joins = smooth_joins(adjacency);
    const GeodesicSearch none = geodesics_between(model, {1, 0.2, 0.2}, {2, 0.5, 0.5}, {.joins = &joins});
    EXPECT_TRUE(none.curves.empty());
    EXPECT_NE(none.why.find("not connected"), std::string::npos);
}

TEST(GeodesicSearch, AHoleInTheWayLeavesNone) {
    Model model = support::model_of(
        {NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1), {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}})});
    const auto ring = [](double low, double high) {
        return TrimmingLoop{{segment({low, low}, {high, low})},
                            {segment({high, low}, {high, high})},
                            {segment({high, high}, {low, high})},
                            {segment({low, high}, {low, low})}};
    };
    model.faces[0].region = TrimmingRegion(model.faces[0].surface.domain(), {ring(0, 1), ring(0.4, 0.6)}, {}, {});
    const GeodesicSearch none = geodesics_between(model, {1, 0.2, 0.5}, {1, 0.8, 0.5});
    EXPECT_TRUE(none.curves.empty());
    EXPECT_NE(none.why.find("stays inside"), std::string::npos);
    const GeodesicSearch beside = geodesics_between(model, {1, 0.2, 0.7}, {1, 0.8, 0.65});
    ASSERT_EQ(beside.curves.size(), 1u);
    EXPECT_NEAR(beside.curves[0].length, std::hypot(0.6, 0.05), 1e-12);
}

TEST(GeodesicSearch, MeetsACurveAtARightAngle) {
    // On a plane the perpendicular to a line; on a cylinder that to a generator, and once around.
    const Model plane = support::model_of(
        {NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1), {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}})});
    const FaceCurve diagonal{1, segment({0.5, 0.0}, {1.0, 0.5})};
    const GeodesicSearch one = geodesics_to_curve(plane, {1, 0.4, 0.4}, diagonal);
    ASSERT_EQ(one.curves.size(), 1u) << one.why;
    EXPECT_NEAR(one.curves[0].length, std::sqrt(0.5) * 0.5, 1e-9);
    EXPECT_LE((one.curves[0].points.back().point - Vector3(0.65, 0.15, 0)).norm(), 1e-8);
    const GeodesicSearch none = geodesics_to_curve(plane, {1, 0.1, 0.1}, FaceCurve{1, segment({0.5, 0.1}, {0.9, 0.5})});
    EXPECT_TRUE(none.curves.empty());
    EXPECT_NE(none.why.find("right angle"), std::string::npos);

    const Model cylinder = closed_model(support::full_cone(1.0, 1.0, 3.0));
    const GeodesicSearch two =
        geodesics_to_curve(cylinder, {1, 0.0, 0.5}, FaceCurve{1, segment({1.0, 0.1}, {1.0, 0.9})}, {.longest = 6.0});
    ASSERT_EQ(two.curves.size(), 2u) << two.why;
    EXPECT_NEAR(two.curves[0].length, pi / 2, 1e-8);
    EXPECT_NEAR(two.curves[1].length, 1.5 * pi, 1e-8);
}

TEST(GeodesicSearch, DoesNotDependOnTheNumberOfThreads) {
    const Model model = closed_model(support::full_torus(3.0, 1.0), true);
    const auto run = [&](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return geodesics_between(model, {1, 0.3, 0.4}, {1, 2.1, 1.7});
    };
    const GeodesicSearch one = run(1), two = run(2);
    ASSERT_GE(one.curves.size(), 3u);
    ASSERT_EQ(one.curves.size(), two.curves.size());
    for (std::size_t i = 0; i < one.curves.size(); ++i) EXPECT_EQ(one.curves[i].length, two.curves[i].length);
}

TEST(GeodesicSearch, RefusesBadInput) {
    const Model model = support::model_of({support::smooth_bicubic(6, 2)});
    EXPECT_THROW(geodesics_between(model, {1, 1.2, 0.2}, {1, 0.5, 0.5}), InvalidInput);
    EXPECT_THROW(geodesics_between(model, {1, 0.2, 0.2}, {1, 0.5, -0.5}), InvalidInput);
    EXPECT_THROW(geodesics_between(model, {1, 0.2, not_a_number}, {1, 0.5, 0.5}), InvalidInput);
    EXPECT_THROW(geodesics_between(model, {1, 0.2, 0.2}, {1, 0.2, 0.2}), InvalidInput);
    EXPECT_THROW(geodesics_between(model, {2, 0.2, 0.2}, {1, 0.5, 0.5}), InvalidInput);
    EXPECT_THROW(geodesics_between(model, {1, 0.2, 0.2}, {1, 0.5, 0.5}, {.tolerance = -1.0}), InvalidInput);
    EXPECT_THROW(geodesics_between(model, {1, 0.2, 0.2}, {1, 0.5, 0.5}, {.longest = not_a_number}), InvalidInput);
    EXPECT_THROW(geodesics_between(model, {1, 0.2, 0.2}, {1, 0.5, 0.5}, {.most = 0}), InvalidInput);
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(geodesics_between(model, {1, 0.2, 0.2}, {1, 0.5, 0.5}, {}, progress), Cancelled);
}

}  // namespace
}  // namespace umbilic
