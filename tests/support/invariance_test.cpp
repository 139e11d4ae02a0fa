// SPDX-License-Identifier: LGPL-2.1-or-later
// The copies themselves: points, normals and areas are where their maps say.
#include <support/invariance.h>

#include <gtest/gtest.h>

#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/nurbs/area.h>

namespace umbilic::support {
namespace {

/// Knots of every continuity from C^0 on, in one direction also unclamped.
NurbsSurface uneven_surface(double weight_ratio) {
    const NurbsSurface net = random_surface(3, 2, 9, 6, 7, 0.3, weight_ratio);
    return NurbsSurface(KnotVector(3, {-0.3, -0.1, 0, 0.1, 0.3, 0.3, 0.5, 0.5, 0.5, 0.8, 1.1, 1.2, 1.4}),
                        KnotVector(2, {2, 2, 2, 2.5, 2.5, 3.2, 4, 4, 4}), net.poles(), net.weights());
}

Model models(int which) {
    switch (which) {
        case 0:
            return model_of({uneven_surface(1.0), smooth_bicubic(6, 3)});
        case 1:
            return model_of({uneven_surface(5.0), ellipsoid_octant(3, 2, 1)});
        default: {
            Model model = model_of({rough_bicubic(6, 1), torus_quarter(3, 1)});
            model.faces[0].region =
                TrimmingRegion(model.faces[0].surface.domain(),
                               {{{NurbsCurve2(KnotVector::bezier(2), {{0.2, 0.2}, {0.9, 0.1}, {0.7, 0.9}})},
                                 {NurbsCurve2(KnotVector::bezier(1), {{0.7, 0.9}, {0.2, 0.2}})}}},
                               {}, {});
            return model;
        }
    }
}

void expect_same_points(const Model& model, const ModelCopy& copy) {
    ASSERT_TRUE(copy.parameters);
    // Control points are rounded once more, and a point is evaluated from nearby ones on both sides.
    const double rounding =
        1e-13 * (copy.model.box.diagonal() + copy.model.box.center().norm() + copy.space.translation.norm());
    for (const Face& face : model.faces) {
        const ParameterBox domain = face.surface.domain();
        for (const double s : {0.0, 0.13, 0.4, 0.5, 0.77, 1.0})
            for (const double t : {0.0, 0.21, 0.55, 0.5, 0.83, 1.0}) {
                const SurfacePoint at{face.number, domain.u.low + s * domain.u.length(),
                                      domain.v.low + t * domain.v.length()};
                const std::vector<SurfacePoint> images = copy.parameters(at);
                if (!copy.part) {
                    EXPECT_FALSE(images.empty());
                }
                for (const SurfacePoint& image : images) {
                    const Face& other = copy.model.face(image.face);
                    const Vector3 expected = copy.space.apply(face.surface.value(at.u, at.v));
                    EXPECT_LE((other.surface.value(image.u, image.v) - expected).norm(), rounding + copy.deviation);
                    if (copy.deviation > 0.0 || s == 0.0 || t == 0.0 || s == 1.0 || t == 1.0) continue;
                    if (s == 0.4 || t == 0.5) continue;  // where the surfaces may have kinks
                    const Vector3 normal =
                        copy.space.apply_direction(unit_normal(face.surface.derivatives(at.u, at.v, 1)));
                    EXPECT_LE((unit_normal(other.surface.derivatives(image.u, image.v, 1)) - copy.normal_sign * normal)
                                  .norm(),
                              1e-10);
                    EXPECT_EQ(face.reversed == other.reversed, copy.normal_sign > 0);
                    if (face.region.classify(at.u, at.v, 1e-3) != Containment::boundary && !copy.part &&
                        images.size() == 1) {
                        EXPECT_EQ(face.region.classify(at.u, at.v), other.region.classify(image.u, image.v));
                    }
                }
            }
    }
    if (!copy.part && !copy.foreign && copy.deviation == 0.0) {
        const double expected = model.area * copy.space.scale * copy.space.scale;
        EXPECT_NEAR(copy.model.area, expected, 1e-7 * expected);
        for (const Face& face : copy.model.faces)
            if (face.region.whole_domain()) {
                EXPECT_NEAR(surface_area(face.surface), face.area, 1e-6 * face.area);
            }
    }
}

TEST(Invariances, PointsLieWhereTheCopySays) {
    for (int which = 0; which < 3; ++which) {
        const Model model = models(which);
        for (const Invariance& invariance : invariances(which + 1)) {
            SCOPED_TRACE(invariance.name + " of model " + std::to_string(which));
            expect_same_points(model, invariance.copy(model));
        }
    }
}

TEST(Invariances, ReapproximationStatesItsDeviation) {
    const Model model = model_of({smooth_bicubic(6, 3), ellipsoid_octant(3, 2, 1)});
    const ModelCopy copy = reapproximated_within(1e-4).copy(model);
    EXPECT_GT(copy.deviation, 0.0);
    EXPECT_LE(copy.deviation, 1e-4 * model.size());
    expect_same_points(model, copy);
    EXPECT_THROW(reapproximated(uneven_surface(1.0), 5, 1e-9), NumericFailure);
}

TEST(Invariances, PartsAndForeignMaterialAreToldAsSuch) {
    const Model model = models(0);
    EXPECT_TRUE(trimmed_to_part().copy(model).part);
    EXPECT_LT(trimmed_to_part().copy(model).model.area, 0.75 * model.area);
    const ModelCopy foreign = with_foreign_material().copy(model);
    EXPECT_TRUE(foreign.foreign);
    EXPECT_EQ(foreign.model.faces.size(), model.faces.size() + 1);
    EXPECT_EQ(split().copy(model).model.faces.size(), 4 * model.faces.size());
}

TEST(Reparametrisation, DegreesKnotsAndWeightsAreThoseAskedFor) {
    const NurbsSurface surface = smooth_bicubic(6, 3);
    const NurbsSurface raised = elevated(surface, 2, 1).surface;
    EXPECT_EQ(raised.u_degree(), 5);
    EXPECT_EQ(raised.v_degree(), 4);
    EXPECT_FALSE(raised.rational());
    // Two interior knots: each gains the two multiplicities, so continuity stays 2.
    EXPECT_EQ(raised.u_pole_count(), 6 + 2 * 3);
    for (int i = 1; i + 1 < static_cast<int>(raised.u_knots().breaks().size()); ++i)
        EXPECT_EQ(raised.u_knots().continuity(i), 2);
    const NurbsSurface bezier = in_bezier_form(surface).surface;
    for (int i = 1; i + 1 < static_cast<int>(bezier.v_knots().breaks().size()); ++i)
        EXPECT_EQ(bezier.v_knots().continuity(i), 0);
    const NurbsSurface rational = with_common_factor(surface, 1.5, 0.7).surface;
    EXPECT_TRUE(rational.rational());
    EXPECT_EQ(rational.u_degree(), 4);
    EXPECT_NEAR(rational.weights().back() / rational.weights().front(), 1.5 * 0.7, 1e-14);
    EXPECT_TRUE(moebius(surface, 1.7, 1.0).surface.rational());
    EXPECT_FALSE(moebius(surface, 1.0, 1.0).surface.rational());
}

}  // namespace
}  // namespace umbilic::support
