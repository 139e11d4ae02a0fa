// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/projection.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/curves/geodesic.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Model sphere_model(double radius) {
    Model model = support::model_of({support::full_sphere(radius)});
    model.faces[0].u_closed = model.faces[0].u_periodic = true;
    return model;
}

/// Bicubic patches of 4 x 4 control points, one above the other (Fig. 3-1 and 3-2; the thesis prints no points).
struct TwoPatches {
    Model upper = support::model_of({support::smooth_bicubic(4, 7, 0.3)});
    Model lower = support::model_of({support::transformed(support::smooth_bicubic(4, 8, 0.1), shift())});

    static SimilarityTransform shift() {
        SimilarityTransform result;
        result.translation = Vector3(0, 0, -0.25);
        return result;
    }
    const Face& a() const { return upper.faces[0]; }
    const Face& b() const { return lower.faces[0]; }
};

/// Every point is the foot of its original: the line between them is normal to the surface (thesis 3.5.2).
void expect_orthogonal(const ProjectedCurve& curve, const Face& onto, double tolerance) {
    ASSERT_EQ(curve.original.points.size(), curve.projection.points.size());
    for (std::size_t i = 0; i < curve.projection.points.size(); ++i) {
        const SurfaceCurvePoint& p = curve.projection.points[i];
        const Vector3 original = curve.original.points[i].point;
        const std::optional<Vector2> foot = foot_point(onto.surface, original, {p.at.u, p.at.v});
        ASSERT_TRUE(foot.has_value());
        EXPECT_LE((onto.surface.value(foot->x(), foot->y()) - p.point).norm(), tolerance);
    }
    EXPECT_LE(curve.projection.error, tolerance);
}

TEST(Projection, OfASpaceCurveOntoASphereIsRadialOnBothSides) {
    const Model model = sphere_model(2.0);
    // A helix about a tilted axis that passes from inside to outside of the sphere: rho changes its sign (T 15).
    SpaceCurve helix;
    helix.range = {0.0, 3.0};
    helix.at = [](double t) {
        const double r = 1.2 + 0.5 * t;
        return std::pair<Vector3, Vector3>(
            {r * std::cos(t), r * std::sin(t), 0.3 * t},
            {0.5 * std::cos(t) - r * std::sin(t), 0.5 * std::sin(t) + r * std::cos(t), 0.3});
    };
    const ProjectedCurve curve = project_curve(helix, model.faces[0], {.spacing = 0.05});
    EXPECT_EQ(curve.projection.ended, CurveEnd::length);
    ASSERT_EQ(curve.projection.points.size(), 61u);
    for (int i = 0; i <= 60; ++i)
        EXPECT_LE((curve.projection.points[i].point - 2 * helix.at(0.05 * i).first.normalized()).norm(), 1e-7);
    EXPECT_LE(curve.projection.error, 1e-7);
    // Arc length of the projection against that of its chords.
    double chords = 0.0;
    for (int i = 1; i <= 60; ++i)
        chords += (curve.projection.points[i].point - curve.projection.points[i - 1].point).norm();
    EXPECT_NEAR(curve.projection.length, chords, 1e-3 * chords);
    EXPECT_GE(curve.projection.length, chords);
}

TEST(Projection, OfAPolylineTurnsAtItsCorners) {
    const Model plane = support::model_of(
        {NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1), {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}})});
    const SpaceCurve line = polyline({{0.1, 0.1, 1.0}, {0.5, 0.2, 0.3}, {0.4, 0.8, -0.5}});
    const ProjectedCurve curve = project_curve(line, plane.faces[0]);
    EXPECT_LE((curve.projection.points.back().point - Vector3(0.4, 0.8, 0)).norm(), 1e-12);
    EXPECT_NEAR(curve.projection.length, std::hypot(0.4, 0.1) + std::hypot(0.1, 0.6), 1e-12);
    EXPECT_FALSE(curve.left_target);
    EXPECT_THROW(polyline({{0, 0, 0}}), InvalidInput);
    EXPECT_THROW(polyline({{0, 0, 0}, {0, 0, 0}}), InvalidInput);
    EXPECT_THROW(polyline({{0, 0, 0}, {not_a_number, 0, 0}}), InvalidInput);
}

TEST(Projection, EndsAtTheBorderAndAtTheEvolute) {
    const Model plane = support::model_of(
        {NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1), {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}})});
    const ProjectedCurve out = project_curve(polyline({{0.5, 0.5, 1.0}, {1.5, 0.5, 1.0}}), plane.faces[0]);
    EXPECT_EQ(out.projection.ended, CurveEnd::boundary);
    EXPECT_TRUE(out.left_target);
    EXPECT_LE((out.projection.points.back().point - Vector3(1.0, 0.5, 0)).norm(), 1e-12);

    // The centres of curvature of a cylinder are its axis.
    Model cylinder = support::model_of({support::full_cone(2.0, 2.0, 4.0)});
    cylinder.faces[0].u_closed = cylinder.faces[0].u_periodic = true;
    const ProjectedCurve into = project_curve(polyline({{1.0, 0.0, 1.0}, {-1.0, 0.0, 2.0}}), cylinder.faces[0]);
    EXPECT_EQ(into.projection.ended, CurveEnd::evolute);
    EXPECT_FALSE(into.left_target);
    EXPECT_NEAR(into.projection.points.back().point.z(), 1.5, 1e-3);
    // Past the axis, a little beside it, the foot goes around.
    const ProjectedCurve beside = project_curve(polyline({{1.0, 0.1, 1.0}, {-1.0, 0.1, 2.0}}), cylinder.faces[0]);
    EXPECT_EQ(beside.projection.ended, CurveEnd::length);
    const Vector3 expected(2 * Vector3(-1.0, 0.1, 0).normalized() + Vector3(0, 0, 2));
    EXPECT_LE((beside.projection.points.back().point - expected).norm(), 1e-6);
    EXPECT_THROW(project_curve(polyline({{0, 0, 1}, {1, 0, 1}}), cylinder.faces[0], {.foot = Vector2(0.5, 0.25)}),
                 NumericFailure);
}

TEST(Projection, OfAGreatCircleIsAGreatCircleOfTheConcentricSphere) {
    const Model inner = sphere_model(2.0), outer = sphere_model(3.0);
    for (const auto& [from, onto] : {std::pair(&inner, &outer), std::pair(&outer, &inner)}) {
        const Face& face = from->faces[0];
        const Vector3 start = face.surface.value(0.4, 0.8);
        const Vector3 direction = start.cross(Vector3(0.3, 0.2, 1)).normalized();
        const ProjectedCurve curve =
            project_geodesic(face, {0.4, 0.8}, direction, 5.0, onto->faces[0], {.spacing = 0.1});
        EXPECT_EQ(curve.projection.ended, CurveEnd::length);
        const double ratio = onto->faces[0].surface.value(0.4, 0.8).norm() / start.norm();
        for (std::size_t i = 0; i < curve.original.points.size(); ++i) {
            EXPECT_LE((curve.projection.points[i].point - ratio * curve.original.points[i].point).norm(), 1e-6);
            EXPECT_NEAR(curve.projection.points[i].s, ratio * curve.original.points[i].s, 1e-6);
        }
        expect_orthogonal(curve, onto->faces[0], 1e-6);
    }
}

TEST(Projection, LinesOfCurvatureOfParallelSurfacesCorrespond) {
    // Tori of the same circle are parallel surfaces; so are cylinders and cones, and here one leaf is turned over.
    const auto torus = [](double minor) {
        Model model = support::model_of({support::full_torus(3.0, minor)});
        model.faces[0].u_closed = model.faces[0].v_closed = true;
        return model;
    };
    const Model thin = torus(0.7), thick = torus(1.1);
    for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum}) {
        const ProjectedCurve curve = project_line_of_curvature(thin.faces[0], {0.3, 0.6}, family, Vector3(0.2, 0.3, 1),
                                                               2.5, thick.faces[0], {.spacing = 0.05});
        EXPECT_EQ(curve.projection.ended, CurveEnd::length);
        expect_orthogonal(curve, thick.faces[0], 1e-6);
        for (std::size_t i = 0; i + 1 < curve.projection.points.size(); ++i) {
            const SurfaceCurvePoint& p = curve.projection.points[i];
            const Curvature c = curvature(thick.faces[0].surface, p.at.u, p.at.v);
            const Vector3 chord = (curve.projection.points[i + 1].point - p.point).normalized();
            const Vector3 across = family == CurvatureFamily::maximum ? c.direction_min : c.direction_max;
            EXPECT_LE(std::abs(chord.dot(across)), 1e-2);
        }
    }
}

TEST(Projection, OfThesisFigure31HasFourConsistentEquations) {
    const TwoPatches patches;
    const ProjectedCurve curve = project_line_of_curvature(patches.a(), {0.3, 0.3}, CurvatureFamily::maximum,
                                                           Vector3(1, 1, 0), 0.4, patches.b(), {.spacing = 0.02});
    EXPECT_GT(curve.original.length, 0.1);
    expect_orthogonal(curve, patches.b(), 1e-7);
    // A second method: the traced original, projected as a polyline.
    std::vector<Vector3> points;
    for (const SurfaceCurvePoint& p : curve.original.points) points.push_back(p.point);
    const ProjectedCurve by_points = project_curve(polyline(points), patches.b());
    EXPECT_LE((by_points.projection.points.back().point - curve.projection.points.back().point).norm(), 1e-6);
}

TEST(Projection, OfThesisFigure32ConvergesInAtMostFiveIterationsAndMeetsTheInitialValueProblem) {
    const TwoPatches patches;
    const ProjectedGeodesicBetween between =
        project_geodesic_between(patches.a(), {0.2, 0.3}, {0.8, 0.9}, patches.b(), {}, {.epsilon = 1e-5});
    ASSERT_TRUE(between.relaxation.converged);
    EXPECT_LE(between.relaxation.iterations, 5);
    EXPECT_EQ(between.relaxation.states.cols(), 33);
    EXPECT_FALSE(between.curve.left_target);

    const ProjectedGeodesicBetween fine = project_geodesic_between(patches.a(), {0.2, 0.3}, {0.8, 0.9}, patches.b(), {},
                                                                   {.epsilon = 1e-9, .tolerance = 1e-6});
    ASSERT_TRUE(fine.relaxation.converged);
    const Eigen::VectorXd y = fine.relaxation.states.col(0);
    const SurfaceDerivatives d = patches.a().surface.derivatives(y[0], y[1], 1);
    const ProjectedCurve shot = project_geodesic(patches.a(), {0.2, 0.3}, d.r_u() * y[2] + d.r_v() * y[3],
                                                 fine.curve.original.length, patches.b());
    EXPECT_LE((shot.original.points.back().point - fine.curve.original.points.back().point).norm(), 1e-5);
    EXPECT_LE((shot.projection.points.back().point - fine.curve.projection.points.back().point).norm(), 1e-5);
    EXPECT_NEAR(shot.projection.length, fine.curve.projection.length, 1e-5);
    expect_orthogonal(fine.curve, patches.b(), 1e-5);
}

TEST(Projection, GoesOnOverSmoothEdgesOfTheTarget) {
    const auto height = [](double x, double y) { return 0.3 * x * x - 0.2 * x * y * y; };
    const auto half = [&](double middle) {
        const NurbsSurface graph =
            support::graph_patch(2, 2, [&](double x, double y) { return height(middle + 0.5 * x, y); });
        std::vector<Vector3> poles;
        for (const Vector3& p : graph.poles()) poles.emplace_back(middle + 0.5 * p.x(), p.y(), p.z());
        return NurbsSurface(graph.u_knots(), graph.v_knots(), poles);
    };
    const Model whole = support::model_of({support::graph_patch(2, 2, height)});
    const Model two = support::model_of({half(-0.5), half(0.5).swapped()});
    const FaceAdjacency adjacency = face_adjacency(two);
    const SmoothJoins joins = smooth_joins(adjacency);
    const SpaceCurve line = polyline({{-0.6, -0.2, 0.4}, {0.7, 0.5, 0.6}});
    const ProjectedCurve expected = project_curve(line, whole.faces[0]);
    const ProjectedCurve joined = project_curve(line, two.faces[0], {.joins = &joins});
    EXPECT_EQ(joined.projection.ended, CurveEnd::length);
    EXPECT_EQ(joined.projection.points.back().at.face, 2);
    EXPECT_LE((joined.projection.points.back().point - expected.projection.points.back().point).norm(), 1e-7);
    EXPECT_TRUE(project_curve(line, two.faces[0]).left_target);
}

TEST(Projection, RefusesBadInput) {
    const TwoPatches patches;
    const Vector3 x = Vector3::UnitX();
    const CurvatureFamily family = CurvatureFamily::maximum;
    for (const double bad : {0.0, -1.0, not_a_number}) {
        EXPECT_THROW(project_geodesic(patches.a(), {0.5, 0.5}, x, bad, patches.b()), InvalidInput);
        EXPECT_THROW(project_line_of_curvature(patches.a(), {0.5, 0.5}, family, x, bad, patches.b()), InvalidInput);
        EXPECT_THROW(project_geodesic(patches.a(), {0.5, 0.5}, x, 0.1, patches.b(), {.tolerance = bad}), InvalidInput);
    }
    EXPECT_THROW(project_geodesic(patches.a(), {1.5, 0.5}, x, 0.1, patches.b()), InvalidInput);
    EXPECT_THROW(project_geodesic(patches.a(), {0.5, 0.5}, Vector3::Zero(), 0.1, patches.b()), InvalidInput);
    EXPECT_THROW(project_geodesic(patches.a(), {0.5, 0.5}, x, 0.1, patches.b(), {.foot = Vector2(0.1, 0.9)}),
                 InvalidInput);
    EXPECT_THROW(project_geodesic_between(patches.a(), {0.5, 0.5}, {0.5, 0.5}, patches.b()), InvalidInput);
    EXPECT_THROW(project_geodesic_between(patches.a(), {0.5, 0.5}, {0.5, not_a_number}, patches.b()), InvalidInput);
    EXPECT_THROW(project_curve(polyline({{5, 5, 0}, {6, 6, 0}}), patches.b()), InvalidInput);
    EXPECT_THROW(project_curve({}, patches.b()), InvalidInput);
    const Model sphere = sphere_model(1.0);  // umbilic everywhere
    EXPECT_THROW(project_line_of_curvature(sphere.faces[0], {0.5, 0.5}, family, x, 0.1, patches.b()), InvalidInput);
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(project_geodesic(patches.a(), {0.5, 0.5}, x, 0.2, patches.b(), {}, progress), Cancelled);
}

}  // namespace
}  // namespace umbilic
