// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Geometry>

#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <support/swept_surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/differential/elementary_fit.h>
#include <umbilic/differential/recognise.h>

namespace umbilic {
namespace {

constexpr double pi = std::numbers::pi;

struct Known {
    const char* title;
    SurfaceKind kind;
    NurbsSurface surface;
    ElementarySurface parameters;
};

ElementarySurface parameters(double radius, double minor_radius = 0.0, double semi_angle = 0.0) {
    ElementarySurface result;
    result.radius = radius;
    result.minor_radius = minor_radius;
    result.semi_angle = semi_angle;
    return result;
}

support::Profile vase() {
    return support::spline(3, {{1.0, 0.0}, {1.6, 0.5}, {1.3, 1.2}, {0.5, 1.9}, {0.6, 2.5}, {1.0, 3.0}});
}

support::Profile wave() {
    return support::spline(3, {{0.0, 0.0}, {1.0, 0.7}, {2.0, -0.4}, {3.0, 0.5}, {4.0, 0.1}});
}

std::vector<Known> known() {
    using support::arc;
    using support::extruded;
    using support::revolved;
    using support::segment;
    const double slope = std::atan2(0.5, 2.0);
    return {
        {"plane", SurfaceKind::plane, extruded(segment({0, 0}, {3, 1}), 2.0), parameters(0.0)},
        {"curved net in a plane", SurfaceKind::plane, support::random_surface(3, 2, 7, 6, 5, 0.0, 4.0),
         parameters(0.0)},
        {"whole sphere", SurfaceKind::sphere, revolved(arc({0, 0}, 2.0, -pi / 2, pi / 2), 2 * pi), parameters(2.0)},
        {"octant", SurfaceKind::sphere, support::ellipsoid_octant(2, 2, 2), parameters(2.0)},
        {"zone", SurfaceKind::sphere, revolved(arc({0, 0}, 2.0, 0.2, 0.5), 1.0), parameters(2.0)},
        {"whole cylinder", SurfaceKind::cylinder, extruded(arc({1, 2}, 1.5, 0, 2 * pi), 4.0), parameters(1.5)},
        {"strip of a cylinder", SurfaceKind::cylinder, extruded(arc({1, 2}, 1.5, 0.3, 0.7), 4.0), parameters(1.5)},
        {"whole cone", SurfaceKind::cone, revolved(segment({0, 0}, {0.5, 2}), 2 * pi), parameters(0, 0, slope)},
        {"frustum", SurfaceKind::cone, revolved(segment({1, 0}, {0.5, 2}), 2.0), parameters(0, 0, slope)},
        {"whole torus", SurfaceKind::torus, revolved(arc({3, 0}, 1.0, 0, 2 * pi), 2 * pi), parameters(3.0, 1.0)},
        {"inner side", SurfaceKind::torus, revolved(arc({3, 1}, 1.0, 2.5, 3.5), 1.5), parameters(3.0, 1.0)},
        {"vase", SurfaceKind::revolution, revolved(vase(), 2 * pi), parameters(0.0)},
        {"part of a vase", SurfaceKind::revolution, revolved(vase(), 1.0), parameters(0.0)},
        {"spindle", SurfaceKind::revolution, revolved(arc({-1, 0}, 2.0, -1.0, 1.0), pi), parameters(0.0)},
        {"wave", SurfaceKind::extrusion, extruded(wave(), 3.0), parameters(0.0)},
    };
}

using Change = std::function<NurbsSurface(const NurbsSurface&)>;

void expect_known(const Known& expected, const NurbsSurface& surface, const SimilarityTransform& placed) {
    const std::optional<RecognisedSurface> found = recognise(surface);
    ASSERT_TRUE(found);
    ASSERT_EQ(name(found->kind), std::string(name(expected.kind)));
    const BoundingBox box = surface.pole_box();
    const double size = box.diagonal(), coordinate = box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).maxCoeff();
    // Coordinates are rounded a few times on their way here.
    EXPECT_LE(found->deviation, 1e-14 * coordinate);
    EXPECT_LE(found->parameter_error, 1e-9 * size);
    const ElementarySurface& got = found->surface;
    EXPECT_NEAR(got.radius * (found->kind != SurfaceKind::cone), expected.parameters.radius * placed.scale,
                1e-10 * size);
    EXPECT_NEAR(got.minor_radius, expected.parameters.minor_radius * placed.scale, 1e-10 * size);
    EXPECT_NEAR(got.semi_angle, expected.parameters.semi_angle, 1e-10);
    EXPECT_NEAR(got.axis.norm(), 1.0, 1e-14);
    EXPECT_NEAR(got.x_axis.dot(got.axis), 0.0, 1e-14);
    if (expected.kind == SurfaceKind::sphere || expected.kind == SurfaceKind::plane) return;
    EXPECT_NEAR(got.axis.cross(placed.apply_direction(Vector3::UnitZ())).norm(), 0.0, 1e-10);
}

TEST(Recognise, ExactSurfacesHoweverTheyLieAndAreDescribed) {
    const std::vector<double> knots = {0.3, 0.3, 0.55};
    const std::vector<std::pair<const char*, Change>> changes = {
        {"as built", [](const NurbsSurface& s) { return s; }},
        {"exchanged", [](const NurbsSurface& s) { return support::exchanged(s).surface; }},
        {"degrees raised", [](const NurbsSurface& s) { return support::elevated(s, 2, 1).surface; }},
        {"knots inserted",
         [&](const NurbsSurface& s) {
             const ParameterBox d = s.domain();
             std::vector<double> u, v;
             for (const double k : knots) {
                 u.push_back(d.u.low + k * d.u.length());
                 v.push_back(d.v.low + k * d.v.length());
             }
             return support::with_knots(s, u, v).surface;
         }},
        {"Moebius", [](const NurbsSurface& s) { return support::moebius(s, 3.0, 0.4).surface; }},
    };
    for (const Known& expected : known())
        for (const auto& [title, change] : changes)
            for (const double scale : {1e-3, 1.0, 1e4}) {
                SCOPED_TRACE(std::string(expected.title) + ", " + title + ", " + std::to_string(scale));
                const SimilarityTransform placed = support::random_similarity(7, scale, scale > 1.0, 10.0 * scale);
                expect_known(expected, support::transformed(change(expected.surface), placed), placed);
            }
}

TEST(Recognise, PositionsOfAxesAndCentres) {
    const SimilarityTransform placed = support::random_similarity(3, 2.0, false);
    const auto found = [&](const NurbsSurface& surface) { return *recognise(support::transformed(surface, placed)); };
    const Vector3 centre = placed.apply(Vector3::Zero());
    EXPECT_NEAR((found(support::ellipsoid_octant(2, 2, 2)).surface.location - centre).norm(), 0.0, 1e-12);
    EXPECT_NEAR((found(support::torus_quarter(3, 1)).surface.location - centre).norm(), 0.0, 1e-12);
    for (const NurbsSurface& surface :
         {support::revolved(vase(), 1.0), support::revolved(support::segment({1, 0}, {2, 1}), 1.0),
          support::extruded(support::arc({0, 0}, 1, 0, 1), 1.0)}) {
        const ElementarySurface axis = found(surface).surface;
        EXPECT_NEAR((axis.location - centre).cross(axis.axis).norm(), 0.0, 1e-11);
    }
    // The radius of a cone is that at its location.
    const RecognisedSurface cone = found(support::revolved(support::segment({1, 0}, {2, 1}), 1.0));
    EXPECT_NEAR(elementary_distance(cone.kind, cone.surface, placed.apply(Vector3(1.5, 0, 0.5))).value, 0.0, 1e-12);
    EXPECT_NEAR(cone.surface.semi_angle, pi / 4, 1e-12);
}

TEST(Recognise, NearMissesAreRefusedOrToldWithTheirDeviation) {
    EXPECT_FALSE(recognise(support::ellipsoid_octant(2.0, 2.02, 1.98)));
    EXPECT_FALSE(recognise(support::smooth_bicubic(8, 1)));
    EXPECT_FALSE(recognise(support::table_3_1_patch()));
    EXPECT_FALSE(recognise(support::rough_bicubic(20, 3)));

    // One per cent off a sphere, but still one of revolution.
    const std::optional<RecognisedSurface> spheroid = recognise(support::ellipsoid_octant(2.0, 2.0, 1.98));
    ASSERT_TRUE(spheroid);
    EXPECT_EQ(spheroid->kind, SurfaceKind::revolution);

    // A half cylinder of length 4 whose axis is bent to an arc (a slice of a torus in effect), or to an S.
    const auto bent = [](double first, double second) {
        const NurbsSurface straight =
            support::elevated(support::extruded(support::arc({0, 0}, 1.0, 0, pi), 4.0), 0, 2).surface;
        std::vector<Vector3> poles = straight.poles();
        for (int i = 0; i < straight.u_pole_count(); ++i) {
            poles[i * 4 + 1].x() += first;
            poles[i * 4 + 2].x() += second;
        }
        return NurbsSurface(straight.u_knots(), straight.v_knots(), poles, straight.weights());
    };
    const double sagitta = 0.001;
    const std::optional<RecognisedSurface> arc = recognise(bent(4 * sagitta / 3, 4 * sagitta / 3));
    ASSERT_TRUE(arc);
    EXPECT_EQ(arc->kind, SurfaceKind::torus);
    EXPECT_NEAR(arc->surface.radius, 2.0 / sagitta, arc->parameter_error);

    EXPECT_FALSE(recognise(bent(3 * sagitta, -3 * sagitta)));
    RecognitionOptions loose;
    loose.tolerance = 1e-3;
    const std::optional<RecognisedSurface> nearly = recognise(bent(3 * sagitta, -3 * sagitta), loose);
    ASSERT_TRUE(nearly);
    EXPECT_EQ(nearly->kind, SurfaceKind::cylinder);
    // The tilted axis that is best by least squares leaves the S by 0.9 sagittas at the ends, if fitted everywhere.
    EXPECT_NEAR(nearly->deviation, 0.9 * sagitta, 0.1 * sagitta);
}

TEST(Recognise, ApproximationsAreToldWithTheirDeviation) {
    for (const double wanted : {1e-4, 1e-6, 1e-8}) {
        const auto sphere =
            support::reapproximated(support::revolved(support::arc({0, 0}, 2.0, 0.1, 1.2), 1.3), 3, wanted);
        const std::optional<RecognisedSurface> found = recognise(sphere.surface);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->kind, SurfaceKind::sphere);
        EXPECT_LE(found->deviation, 1.5 * sphere.deviation);
        EXPECT_GE(found->deviation, 0.01 * sphere.deviation);
        EXPECT_NEAR(found->surface.radius, 2.0, std::max(found->parameter_error, sphere.deviation));

        const auto revolution = support::reapproximated(support::revolved(vase(), 1.3), 3, wanted);
        const std::optional<RecognisedSurface> turned = recognise(revolution.surface);
        ASSERT_TRUE(turned);
        EXPECT_EQ(turned->kind, SurfaceKind::revolution);
        EXPECT_LE(turned->deviation, 3 * revolution.deviation);
        EXPECT_NEAR(turned->surface.axis.cross(Vector3::UnitZ()).norm(), 0.0, 100 * wanted);
    }
}

TEST(Recognise, SmallPiecesOfLargeSpheresAreNotGuessed) {
    // Exact down to where the sagitta is a few thousand roundings; then a plane if it is one within the tolerance.
    for (const double angle : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        const NurbsSurface piece =
            support::transformed(support::revolved(support::arc({0, 0}, 1.0, 0.3, 0.3 + angle), angle),
                                 support::random_similarity(2, 1.0, false, 0.5));
        const std::optional<RecognisedSurface> found = recognise(piece);
        if (!found) continue;
        const double size = piece.pole_box().diagonal();
        EXPECT_TRUE(found->kind == SurfaceKind::sphere || found->kind == SurfaceKind::plane) << name(found->kind);
        if (found->kind == SurfaceKind::sphere) {
            EXPECT_NEAR(found->surface.radius, 1.0, 2 * found->parameter_error) << angle;
            EXPECT_LE(found->parameter_error, 0.01);
        } else {
            EXPECT_LE(found->deviation, 1e-4 * size);
        }
        if (angle >= 1e-3) {
            EXPECT_EQ(found->kind, SurfaceKind::sphere) << angle;
        }
    }
}

TEST(Recognise, TinyFacesAndFacesFarAway) {
    const SimilarityTransform tiny = support::random_similarity(1, 1e-6, false, 0.0);
    const std::optional<RecognisedSurface> found =
        recognise(support::transformed(support::ellipsoid_octant(2, 2, 2), tiny));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind, SurfaceKind::sphere);
    EXPECT_NEAR(found->surface.radius, 2e-6, 1e-16);

    // At a distance at which the coordinates' rounding is above the tolerance nothing can be told.
    SimilarityTransform far = tiny;
    far.translation = Vector3(1e8, 2e8, 3e8);
    EXPECT_FALSE(recognise(support::transformed(support::ellipsoid_octant(2, 2, 2), far)));

    const std::vector<Vector3> point(4, Vector3(1, 2, 3));
    EXPECT_FALSE(recognise(NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1), point)));
    const std::vector<Vector3> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    EXPECT_FALSE(recognise(NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1), line)));
}

TEST(Recognise, SweptKindsOnlyIfWanted) {
    RecognitionOptions options;
    options.swept = false;
    EXPECT_FALSE(recognise(support::revolved(vase(), 1.0), options));
    EXPECT_TRUE(recognise(support::torus_quarter(3, 1), options));
}

TEST(Recognise, RefusesToleranceWithoutMeaning) {
    for (const double tolerance : {0.0, -1.0, std::nan(""), double(INFINITY)})
        EXPECT_THROW((void)recognise(support::torus_quarter(3, 1), {.tolerance = tolerance}), InvalidInput);
}

}  // namespace
}  // namespace umbilic
