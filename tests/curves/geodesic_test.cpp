// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/geodesic.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/curves/geodesic_path.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Model of one face that is closed in u and, for a torus, in v.
Model closed_model(NurbsSurface surface, bool v_closed = false) {
    Model model = support::model_of({std::move(surface)});
    model.faces[0].u_closed = model.faces[0].u_periodic = true;
    model.faces[0].v_closed = model.faces[0].v_periodic = v_closed;
    return model;
}

Vector3 tangent(const Face& face, const Vector2& at, double angle) {
    const SurfaceDerivatives d = face.surface.derivatives(at.x(), at.y(), 1);
    const Vector3 x = d.r_u().normalized();
    return std::cos(angle) * x + std::sin(angle) * unit_normal(d).cross(x);
}

/// Parameters of a point of a surface near the given ones.
Vector2 parameters_of(const NurbsSurface& surface, const Vector3& point, Vector2 at) {
    for (int i = 0; i < 50; ++i) {
        const SurfaceDerivatives d = surface.derivatives(at.x(), at.y(), 1);
        at += tangent_components(d, point - d.r());
    }
    EXPECT_LE((surface.value(at.x(), at.y()) - point).norm(), 1e-12);
    return at;
}

TEST(Geodesic, ChristoffelSymbolsHoldOnAnObliqueParametrisation) {
    // r_ij = Gamma_ij^k r_k + b_ij n, where F is far from 0 (T 3).
    const NurbsSurface graph =
        support::graph_patch(3, 3, [](double x, double y) { return 0.5 * x * y + 0.3 * x * x * y - 0.4 * y * y * y; });
    std::vector<Vector3> poles;
    for (const Vector3& p : graph.poles()) poles.emplace_back(p.x() + 0.8 * p.y(), p.y() + 0.3 * p.x(), p.z());
    const NurbsSurface oblique(graph.u_knots(), graph.v_knots(), poles);
    for (const double u : {0.1, 0.5, 0.8})
        for (const double v : {0.2, 0.6}) {
            const SurfaceDerivatives d = oblique.derivatives(u, v, 2);
            ASSERT_GT(std::abs(first_form(d).F), 0.1);
            const Christoffel c = christoffel(d);
            const SecondForm b = second_form(d);
            const Vector3 n = unit_normal(d);
            EXPECT_LE((c.u_uu * d.r_u() + c.v_uu * d.r_v() + b.L * n - d.r_uu()).norm(), 1e-13);
            EXPECT_LE((c.u_uv * d.r_u() + c.v_uv * d.r_v() + b.M * n - d.r_uv()).norm(), 1e-13);
            EXPECT_LE((c.u_vv * d.r_u() + c.v_vv * d.r_v() + b.N * n - d.r_vv()).norm(), 1e-13);
        }
}

TEST(Geodesic, ParallelsOfASphereHaveTheCurvatureOfTheirLatitude) {
    const NurbsSurface sphere = support::full_sphere(3.0);
    for (const double v : {0.3, 0.9, 1.4}) {
        const SurfaceDerivatives d = sphere.derivatives(0.37, v, 2);
        const double latitude = std::asin(d.r().z() / 3.0);
        // North of the equator a parallel run eastwards turns to the left.
        EXPECT_NEAR(geodesic_curvature(d, {1.0, 0.0}, {0.0, 0.0}), std::tan(latitude) / 3.0, 1e-12);
        EXPECT_NEAR(geodesic_curvature(d, {-2.0, 0.0}, {0.7, 0.0}), -std::tan(latitude) / 3.0, 1e-12);
        EXPECT_NEAR(geodesic_curvature(d, {0.0, 1.0}, {0.0, 0.4}), 0.0, 1e-12);
    }
}

TEST(Geodesic, IsAGreatCircleOnASphere) {
    const double radius = 3.0;
    const Model model = closed_model(support::full_sphere(radius));
    const Vector2 start(0.4, 0.8);
    for (const double angle : {0.0, 0.4, 1.1, 2.8, 4.0}) {
        const Vector3 direction = tangent(model.faces[0], start, angle);
        const double length = 2 * pi * radius;
        const SurfaceCurve curve = geodesic(model.faces[0], start, direction, length, {.spacing = 0.1});
        EXPECT_EQ(curve.ended, CurveEnd::length);
        EXPECT_NEAR(curve.length, length, 1e-12);
        const Vector3 from = curve.points.front().point / radius;
        for (const SurfaceCurvePoint& p : curve.points) {
            const double turn = p.s / radius;
            EXPECT_LE((p.point - radius * (std::cos(turn) * from + std::sin(turn) * direction)).norm(), 1e-7);
            EXPECT_LE((p.point - model.faces[0].surface.value(p.at.u, p.at.v)).norm(), 1e-12);
            EXPECT_TRUE(model.faces[0].surface.domain().contains(p.at.u, p.at.v));
        }
        EXPECT_GT(curve.points.size(), 100u);
    }
}

TEST(Geodesic, MeridianPassesThroughThePoles) {
    const Model model = closed_model(support::full_sphere(2.0));
    const SurfaceCurve curve =
        geodesic(model.faces[0], {0.6, 1.0}, tangent(model.faces[0], {0.6, 1.0}, pi / 2), 4 * pi, {.spacing = 0.05});
    EXPECT_EQ(curve.ended, CurveEnd::length);
    const Vector3 from = curve.points.front().point;
    for (const SurfaceCurvePoint& p : curve.points)
        EXPECT_LE((p.point - (std::cos(p.s / 2) * from + std::sin(p.s / 2) * Vector3(0, 0, 2))).norm(), 1e-6);
    // The apex of a cone is no smooth pole.
    const Model cone = closed_model(support::full_cone(1.0, 0.0, 1.0));
    const SurfaceCurve up = geodesic(cone.faces[0], {0.6, 0.5}, Vector3::UnitZ(), 10.0);
    EXPECT_EQ(up.ended, CurveEnd::boundary);
    EXPECT_NEAR(up.length, std::sqrt(0.5), 1e-9);
}

TEST(Geodesic, IsAStraightLineOnDevelopedCylindersAndCones) {
    const Model cylinder = closed_model(support::full_cone(2.0, 2.0, 9.0));
    const double angle = 0.3;
    const SurfaceCurve helix =
        geodesic(cylinder.faces[0], {0.0, 0.1}, tangent(cylinder.faces[0], {0.0, 0.1}, angle), 20.0, {.spacing = 0.2});
    EXPECT_EQ(helix.ended, CurveEnd::length);
    for (const SurfaceCurvePoint& p : helix.points) {
        const double turn = p.s * std::cos(angle) / 2;
        const Vector3 expected(2 * std::cos(turn), 2 * std::sin(turn), 0.9 + p.s * std::sin(angle));
        EXPECT_LE((p.point - expected).norm(), 1e-7);
    }
    EXPECT_EQ(geodesic(cylinder.faces[0], {0.0, 0.1}, -Vector3::UnitZ(), 5.0).ended, CurveEnd::boundary);

    // Developed, a cone's point lies at its distance from the apex under the longitude times the sine of the half
    // angle.
    const double height = 4.0, r0 = 3.0, slant = 5.0;
    const Model cone = closed_model(support::full_cone(r0, 0.3, height * 0.9));
    const auto developed = [&](const Vector3& p, double longitude) {
        const double distance = slant * std::hypot(p.x(), p.y()) / r0;
        return Vector2(distance * std::cos(longitude * r0 / slant), distance * std::sin(longitude * r0 / slant));
    };
    const SurfaceCurve line =
        geodesic(cone.faces[0], {0.0, 0.2}, tangent(cone.faces[0], {0.0, 0.2}, 1.2), 5.0, {.spacing = 0.1});
    EXPECT_EQ(line.ended, CurveEnd::length);
    double longitude = 0.0;
    std::vector<Vector2> flat;
    for (const SurfaceCurvePoint& p : line.points) {
        const double raw = std::atan2(p.point.y(), p.point.x());
        longitude = raw + 2 * pi * std::round((longitude - raw) / (2 * pi));
        flat.push_back(developed(p.point, longitude));
    }
    const Vector2 along = (flat[1] - flat[0]).normalized();
    for (std::size_t i = 0; i < flat.size(); ++i)
        EXPECT_LE((flat[i] - flat[0] - line.points[i].s * along).norm(), 1e-6);
}

TEST(Geodesic, KeepsClairautsRelationOnATorus) {
    const Model model = closed_model(support::full_torus(3.0, 1.0), true);
    const Face& face = model.faces[0];
    for (const double angle : {0.2, 0.7, 1.3}) {
        const SurfacePath path =
            geodesic_path(face, {0.3, 0.5}, tangent(face, {0.3, 0.5}, angle), 40.0, {.tolerance = 1e-10});
        EXPECT_EQ(path.ended, CurveEnd::length);
        double constant = 0.0;
        for (const PathStep& step : path.steps) {
            const GeodesicState state = geodesic_state(step, 1.0);
            const Vector3 around = Vector3::UnitZ().cross(state.point);
            const double clairaut = state.tangent.dot(around);
            if (constant == 0.0) constant = clairaut;
            EXPECT_NEAR(clairaut, constant, 1e-7);
            // Unit speed.
            const SurfaceDerivatives d = step.pieces[0].derivatives({step.end[0], step.end[1]}, 1);
            EXPECT_NEAR((d.r_u() * step.end[2] + d.r_v() * step.end[3]).norm(), 1.0, 1e-8);
        }
    }
}

TEST(Geodesic, KeepsJoachimsthalsInvariantOnAnEllipsoid) {
    // p d is constant on an ellipsoid: p the distance of the tangent plane, d the half diameter along the tangent.
    const Vector3 half(3, 2, 1);
    const Model model = support::model_of({support::ellipsoid_octant(3, 2, 1)});
    const Face& face = model.faces[0];
    const SurfacePath path =
        geodesic_path(face, {0.2, 0.3}, tangent(face, {0.2, 0.3}, 0.6), 10.0, {.tolerance = 1e-10});
    double constant = 0.0;
    for (const PathStep& step : path.steps) {
        const GeodesicState state = geodesic_state(step, 1.0);
        const double p = 1 / state.point.cwiseQuotient(half.cwiseProduct(half)).norm();
        const double d = 1 / state.tangent.cwiseQuotient(half).norm();
        if (constant == 0.0) constant = p * d;
        EXPECT_NEAR(p * d, constant, 1e-7);
    }
    EXPECT_GT(path.length, 1.0);
}

TEST(Geodesic, ErrorFallsWithTheToleranceAcrossKnots) {
    const Model model = support::model_of({support::smooth_bicubic(12, 5)});
    const Face& face = model.faces[0];
    const Vector2 start(0.1, 0.12);
    const Vector3 direction = tangent(face, start, 0.8);
    const auto end = [&](double tolerance) {
        const SurfacePath path = geodesic_path(face, start, direction, 1.0, {.tolerance = tolerance});
        EXPECT_EQ(path.ended, CurveEnd::length);
        return geodesic_state(path.steps.back(), 1.0).point;
    };
    const Vector3 exact = end(1e-13);
    EXPECT_LE((end(1e-6) - exact).norm(), 1e-4);
    EXPECT_LE((end(1e-10) - exact).norm(), 1e-8);
}

TEST(Geodesic, GoesOnOverSmoothEdges) {
    // Two halves of one graph, the right one with other parameters, against the whole.
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
    const Model two = support::model_of({half(-0.5), half(0.5).swapped().u_reversed()});
    const FaceAdjacency adjacency = face_adjacency(two);
    const SmoothJoins joins = smooth_joins(adjacency);
    const Vector2 start_whole = parameters_of(whole, Vector3(-0.6, -0.3, height(-0.6, -0.3)), {0.2, 0.3});
    const Vector2 start_half = parameters_of(two.faces[0].surface, Vector3(-0.6, -0.3, height(-0.6, -0.3)), {0.4, 0.3});
    const Vector3 direction(1, 0.4, 0);
    const SurfaceCurve expected = geodesic(one.faces[0], start_whole, direction, 1.4, {.spacing = 0.1});
    const SurfaceCurve joined = geodesic(two.faces[0], start_half, direction, 1.4, {.spacing = 0.1, .joins = &joins});
    EXPECT_EQ(joined.ended, CurveEnd::length);
    EXPECT_EQ(joined.points.back().at.face, 2);
    EXPECT_LE((joined.points.back().point - expected.points.back().point).norm(), 1e-8);
    EXPECT_EQ(joined.points.size(), expected.points.size() + 2);  // the edge, once on each face
    const SurfaceCurve alone = geodesic(two.faces[0], start_half, direction, 1.4);
    EXPECT_EQ(alone.ended, CurveEnd::boundary);
    EXPECT_NEAR(alone.points.back().point.x(), 0.0, 1e-12);
}

TEST(Geodesic, RefusesBadInput) {
    const Model model = support::model_of({support::smooth_bicubic(8, 1)});
    const Face& face = model.faces[0];
    const Vector3 x = Vector3::UnitX();
    EXPECT_THROW(geodesic(face, {1.5, 0.5}, x, 1.0), InvalidInput);
    EXPECT_THROW(geodesic(face, {not_a_number, 0.5}, x, 1.0), InvalidInput);
    EXPECT_THROW(geodesic(face, {0.5, 0.5}, Vector3::Zero(), 1.0), InvalidInput);
    EXPECT_THROW(geodesic(face, {0.5, 0.5}, Vector3(not_a_number, 0, 0), 1.0), InvalidInput);
    EXPECT_THROW(geodesic(face, {0.5, 0.5}, unit_normal(face.surface.derivatives(0.5, 0.5, 1)), 1.0), InvalidInput);
    for (const double bad : {0.0, -1.0, not_a_number, std::numeric_limits<double>::infinity()})
        EXPECT_THROW(geodesic(face, {0.5, 0.5}, x, bad), InvalidInput);
    EXPECT_THROW(geodesic(face, {0.5, 0.5}, x, 1.0, {.tolerance = 0.0}), InvalidInput);
    EXPECT_THROW(geodesic(face, {0.5, 0.5}, x, 1.0, {.spacing = -1.0}), InvalidInput);
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(geodesic(face, {0.5, 0.5}, x, 0.3, {}, progress), Cancelled);
}

}  // namespace
}  // namespace umbilic
