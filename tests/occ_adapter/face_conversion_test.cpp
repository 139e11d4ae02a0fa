// SPDX-License-Identifier: LGPL-2.1-or-later
// Faces against the kernel: points, trimming, areas; on real files and on surfaces of every kind.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Hyperbola.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <GeomConvert.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include <occ_adapter/occ_types.h>
#include <occ_adapter/shape_file.h>
#include <occ_adapter/shape_to_model.h>

#include "cad_files.h"

namespace umbilic {
namespace {

using support::cad;

class RealFile : public testing::TestWithParam<const char*> {};

std::string test_name(const testing::TestParamInfo<const char*>& info) {
    return std::filesystem::path(info.param).stem().string();
}

constexpr const char* real_files[] = {"freeform/kvlcc2m_tanker_hull.iges",
                                      "freeform/kcs_container_ship_hull.iges",
                                      "freeform/sphere_rational_periodic_poles.igs",
                                      "freeform/nacelle_quintic.stp",
                                      "mechanical/nist_mbe_pmi_2.stp",
                                      "mechanical/as1_assembly_inch_ap203.stp",
                                      "pairs/dtmb5415_bulbous_bow.iges",
                                      "pairs/iea15_blade_2023_mm.stp",
                                      "pairs/b777_openvsp.stp",
                                      "pairs/b777_onshape.step",
                                      "pairs/propeller_1045.step",
                                      "pairs/propeller_1045_mirrored_edited.step"};

/// Point of the file's own surface at native parameters.
Vector3 native_point(const TopoDS_Face& face, double u, double v) {
    TopLoc_Location location;
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, location);
    return to_vector(surface->Value(u, v).Transformed(location.Transformation()));
}

struct Pair {
    ShapeFile file;
    TopTools_IndexedMapOfShape faces;
    Model model;
};

Pair read(const std::string& path) {
    Pair pair{read_shape_file(path, describe_file(path), Progress()), {}, {}};
    TopExp::MapShapes(pair.file.shape, TopAbs_FACE, pair.faces);
    pair.model = shape_to_model(pair.file.shape);
    return pair;
}

TEST_P(RealFile, PointsAreThoseOfTheFilesOwnSurface) {
    UMBILIC_NEEDS_CAD_FILES();
    const Pair pair = read(cad(GetParam()));
    const int points = pair.model.faces.size() > 100 ? 500 : 10000;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (const Face& face : pair.model.faces) {
        const TopoDS_Face original = TopoDS::Face(pair.faces(face.number));
        const ParameterBox box = face.region.box();
        const double scale =
            std::max(pair.model.box.low.cwiseAbs().maxCoeff(), pair.model.box.high.cwiseAbs().maxCoeff());
        double worst = 0.0;
        for (int i = 0; i < points; ++i) {
            const double u = box.u.low + uniform(random) * box.u.length();
            const double v = box.v.low + uniform(random) * box.v.length();
            const Vector3 expected =
                native_point(original, face.region.u_map().native(u), face.region.v_map().native(v));
            worst = std::max(worst, (face.surface.value(u, v) - expected).norm());
        }
        EXPECT_LE(worst, 1e-12 * scale + face.conversion_error) << "face " << face.number;
    }
}

TEST_P(RealFile, TrimmingAgreesWithTheKernel) {
    UMBILIC_NEEDS_CAD_FILES();
    const Pair pair = read(cad(GetParam()));
    const int points = pair.model.faces.size() > 100 ? 10 : 100;
    // The kernel's classifier knows a boundary by its tolerances in space, so points near one are left out.
    constexpr double band = 1e-3;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-0.02, 1.02);
    int compared = 0, different = 0;
    for (const Face& face : pair.model.faces) {
        const TopoDS_Face original = TopoDS::Face(pair.faces(face.number));
        const ParameterBox domain = face.surface.domain(), box = face.region.box();
        for (int i = 0; i < points; ++i) {
            const double u = domain.u.clamp(box.u.low + uniform(random) * box.u.length());
            const double v = domain.v.clamp(box.v.low + uniform(random) * box.v.length());
            const Containment found = face.region.classify(u, v, band);
            if (found == Containment::boundary) continue;
            const BRepClass_FaceClassifier classifier(
                original, gp_Pnt2d(face.region.u_map().native(u), face.region.v_map().native(v)), 1e-9);
            if (classifier.State() == TopAbs_ON) continue;
            ++compared;
            if ((classifier.State() == TopAbs_IN) != (found == Containment::inside)) {
                ++different;
                ADD_FAILURE() << "face " << face.number << " at " << u << ", " << v << ": kernel "
                              << classifier.State();
            }
            if (different > 10) return;
        }
    }
    EXPECT_GT(compared, 0);
}

TEST_P(RealFile, BoxHoldsEveryPointAndIsNoLarger) {
    UMBILIC_NEEDS_CAD_FILES();
    const Pair pair = read(cad(GetParam()));
    const double margin = 5e-5 * pair.model.box.diagonal();
    BoundingBox seen;
    std::mt19937 random(13);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (const Face& face : pair.model.faces) {
        const ParameterBox box = face.region.box();
        for (int i = 0; i < 2000; ++i) {
            const double u = box.u.low + uniform(random) * box.u.length();
            const double v = box.v.low + uniform(random) * box.v.length();
            if (face.region.classify(u, v) != Containment::outside) seen.add(face.surface.value(u, v));
        }
    }
    EXPECT_TRUE((seen.low.array() >= pair.model.box.low.array() - margin).all());
    EXPECT_TRUE((seen.high.array() <= pair.model.box.high.array() + margin).all());
    // A few thousand random points do not reach the corners, but come near.
    EXPECT_GE(seen.diagonal(), 0.97 * pair.model.box.diagonal());
}

INSTANTIATE_TEST_SUITE_P(Files, RealFile, testing::ValuesIn(real_files), test_name);

/// Face of a surface over a rectangle of its parameters.
Face converted(const Handle(Geom_Surface) & surface, double u0, double u1, double v0, double v1,
               const gp_Trsf& placement = gp_Trsf()) {
    TopoDS_Shape shape = BRepBuilderAPI_MakeFace(surface, u0, u1, v0, v1, 1e-7).Shape();
    shape.Location(TopLoc_Location(placement), Standard_False);
    Model model = shape_to_model(shape);
    EXPECT_TRUE(model.repaired.empty());
    return model.faces.at(0);
}

void expect_same_points(const Face& face, const Handle(Geom_Surface) & surface, double tolerance,
                        const gp_Trsf& placement = gp_Trsf()) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const ParameterBox box = face.region.box();
    for (int i = 0; i < 1000; ++i) {
        const double u = box.u.low + uniform(random) * box.u.length();
        const double v = box.v.low + uniform(random) * box.v.length();
        const gp_Pnt expected = surface->Value(face.region.u_map().native(u), face.region.v_map().native(v));
        ASSERT_LE((face.surface.value(u, v) - to_vector(expected.Transformed(placement))).norm(), tolerance)
            << u << ", " << v;
    }
}

/// A frame in general position; left-handed ones occur in files.
gp_Ax3 frame(bool left_handed = false) {
    gp_Ax3 result(gp_Pnt(1, -2, 3), gp_Dir(1, 2, 3), gp_Dir(2, -1, 0.5));
    if (left_handed) result.YReverse();
    return result;
}

constexpr double exact = 1e-13 * 20;  // of coordinates up to 20

TEST(FaceConversion, ElementarySurfacesAreExact) {
    for (const bool left_handed : {false, true}) {
        const gp_Ax3 axes = frame(left_handed);
        const struct {
            Handle(Geom_Surface) surface;
            SurfaceKind kind;
            double u0, u1, v0, v1;
        } cases[] = {
            {new Geom_Plane(axes), SurfaceKind::plane, -2, 3, 1, 4},
            {new Geom_CylindricalSurface(axes, 2.5), SurfaceKind::cylinder, 0.3, 5.9, -1, 4},
            {new Geom_CylindricalSurface(axes, 2.5), SurfaceKind::cylinder, 0, 2 * std::numbers::pi, -1, 4},
            {new Geom_CylindricalSurface(axes, 2.5), SurfaceKind::cylinder, 5.0, 7.5, -1, 4},
            {new Geom_ConicalSurface(axes, 0.4, 2.5), SurfaceKind::cone, 1.0, 2.0, -1, 4},
            {new Geom_SphericalSurface(axes, 2.5), SurfaceKind::sphere, 0, 2 * std::numbers::pi, -std::numbers::pi / 2,
             std::numbers::pi / 2},
            {new Geom_SphericalSurface(axes, 2.5), SurfaceKind::sphere, 1, 2, -0.5, 1.2},
            {new Geom_ToroidalSurface(axes, 3.0, 1.0), SurfaceKind::torus, 0, 2 * std::numbers::pi, 0,
             2 * std::numbers::pi},
            {new Geom_ToroidalSurface(axes, 3.0, 1.0), SurfaceKind::torus, 3.0, 7.0, 5.0, 9.0},
        };
        for (const auto& [surface, kind, u0, u1, v0, v1] : cases) {
            const Face face = converted(surface, u0, u1, v0, v1);
            SCOPED_TRACE(name(kind));
            EXPECT_EQ(face.kind, kind);
            EXPECT_EQ(face.conversion_error, 0.0);
            EXPECT_TRUE(face.region.whole_domain());
            ASSERT_TRUE(face.elementary.has_value());
            expect_same_points(face, surface, exact);
        }
    }
}

TEST(FaceConversion, AreasHaveTheirClosedForms) {
    constexpr double pi = std::numbers::pi;
    const auto area = [](const Handle(Geom_Surface) & surface, double u0, double u1, double v0, double v1) {
        return converted(surface, u0, u1, v0, v1).area;
    };
    EXPECT_NEAR(area(new Geom_SphericalSurface(frame(), 2.0), 0, 2 * pi, -pi / 2, pi / 2), 16 * pi, 1e-6 * 16 * pi);
    EXPECT_NEAR(area(new Geom_ToroidalSurface(frame(), 3, 1), 0, 2 * pi, 0, 2 * pi), 12 * pi * pi, 1e-6 * 12 * pi * pi);
    EXPECT_NEAR(area(new Geom_CylindricalSurface(frame(), 2.0), 0, 1, 0, 3), 6.0, 1e-6 * 6);
}

TEST(FaceConversion, ElementaryParametersFollowThePlacement) {
    gp_Trsf placement, mirror;
    placement.SetRotation(gp_Ax1(gp_Pnt(1, 1, 1), gp_Dir(0, 1, 1)), 1.1);
    mirror.SetMirror(gp_Ax2(gp_Pnt(0, 1, 0), gp_Dir(1, 1, 0)));
    placement.Multiply(mirror);
    placement.SetScaleFactor(2.0 * placement.ScaleFactor());
    const Handle(Geom_Surface) cone = new Geom_ConicalSurface(frame(), 0.4, 2.5);
    const Face face = converted(cone, 0.5, 2.0, -1, 4, placement);
    expect_same_points(face, cone, 10 * exact, placement);
    const ElementarySurface& e = *face.elementary;
    EXPECT_NEAR(e.axis.dot(e.x_axis), 0.0, 1e-14);
    EXPECT_NEAR(e.radius, 5.0, 1e-14);
    const double slope = std::tan(e.semi_angle);
    for (const double u : {0.6, 1.0, 1.9})
        for (const double v : {-0.5, 3.0}) {
            const ParameterBox domain = face.surface.domain();
            const Vector3 p = face.surface.value(domain.u.clamp(u), domain.v.clamp(v)) - e.location;
            const double height = p.dot(e.axis);
            EXPECT_NEAR((p - height * e.axis).norm(), e.radius + slope * height, 1e-12);
        }
}

TEST(FaceConversion, SweptSurfacesOfConicsAndSplinesAreExact) {
    const gp_Ax2 plane(gp_Pnt(4, 1, 0), gp_Dir(0, 0, 1), gp_Dir(1, 1, 0));
    TColgp_Array1OfPnt poles(1, 4);
    for (int i = 1; i <= 4; ++i) poles(i) = gp_Pnt(3 + 0.3 * i * i, i % 2, i);  // not in a plane with the axis
    const Handle(Geom_Curve) ellipse = new Geom_Ellipse(plane, 2, 1), parabola = new Geom_Parabola(plane, 0.7),
                             bezier = new Geom_BezierCurve(poles);
    const gp_Ax1 axis(gp_Pnt(0, 0, 1), gp_Dir(0.1, 0, 1));
    const struct {
        Handle(Geom_Curve) curve;
        double low, high;
    } curves[] = {{ellipse, 0.2, 4.0}, {parabola, -1.0, 1.5}, {bezier, 0.0, 1.0}};
    for (const auto& [curve, low, high] : curves) {
        const Handle(Geom_Surface) turned = new Geom_SurfaceOfRevolution(curve, axis),
                                   pushed = new Geom_SurfaceOfLinearExtrusion(curve, gp_Dir(1, 0, 2));
        const Face revolution = converted(turned, 0.4, 3.9, low, high);
        EXPECT_EQ(revolution.kind, SurfaceKind::revolution);
        EXPECT_EQ(revolution.conversion_error, 0.0);
        expect_same_points(revolution, turned, exact);
        const Face extrusion = converted(pushed, low, high, -2, 5);
        EXPECT_EQ(extrusion.kind, SurfaceKind::extrusion);
        EXPECT_EQ(extrusion.conversion_error, 0.0);
        expect_same_points(extrusion, pushed, exact);
    }
}

TEST(FaceConversion, PeriodicSplinesAreUnrolledOverAnyRange) {
    const Handle(Geom_BSplineSurface) torus =
        GeomConvert::SurfaceToBSplineSurface(new Geom_ToroidalSurface(frame(), 3.0, 1.0));
    torus->SetUPeriodic();
    torus->SetVPeriodic();
    ASSERT_TRUE(torus->IsUPeriodic() && torus->IsVPeriodic());
    double u0, u1, v0, v1;
    torus->Bounds(u0, u1, v0, v1);
    const double period = u1 - u0;
    for (const auto& [low, high] :
         {std::pair(0.0, 1.0), std::pair(0.1, 0.3), std::pair(0.7, 1.4), std::pair(-0.3, 0.2)}) {
        const Face face =
            converted(torus, u0 + low * period, u0 + high * period, v0 + low * (v1 - v0), v0 + high * (v1 - v0));
        EXPECT_EQ(face.kind, SurfaceKind::bspline);
        EXPECT_EQ(face.conversion_error, 0.0);
        EXPECT_TRUE(face.u_periodic && face.v_periodic);
        expect_same_points(face, torus, exact);
    }
}

TEST(FaceConversion, WhatHasNoExactFormStatesItsDeviation) {
    TColgp_Array2OfPnt poles(1, 3, 1, 3);
    for (int i = 1; i <= 3; ++i)
        for (int j = 1; j <= 3; ++j) poles(i, j) = gp_Pnt(i, j, 0.3 * ((i * j) % 3));
    const Handle(Geom_Surface) base = new Geom_BezierSurface(poles);
    const Handle(Geom_Surface) offset = new Geom_OffsetSurface(base, 0.2);
    const Face face = converted(offset, 0, 1, 0, 1);
    EXPECT_EQ(face.kind, SurfaceKind::offset);
    EXPECT_GT(face.conversion_error, 0.0);
    EXPECT_LT(face.conversion_error, 1e-5);
    expect_same_points(face, offset, 1.5 * face.conversion_error);
    // Offsets of elementary surfaces are elementary.
    const Handle(Geom_Surface) cylinder = new Geom_OffsetSurface(new Geom_CylindricalSurface(frame(), 2.0), 0.5);
    const Face thick = converted(cylinder, 0.5, 2.0, 0, 1);
    EXPECT_EQ(thick.conversion_error, 0.0);
    expect_same_points(thick, cylinder, exact);
    const Handle(Geom_Surface) hyperbolic = new Geom_SurfaceOfRevolution(
        new Geom_Hyperbola(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 1, 0), gp_Dir(1, 0, 0)), 2, 1),
        gp_Ax1(gp_Pnt(), gp_Dir(0, 0, 1)));
    const Face waist = converted(hyperbolic, 0.3, 2.0, -1, 1);
    EXPECT_GT(waist.conversion_error, 0.0);
    EXPECT_LT(waist.conversion_error, 1e-5);
    expect_same_points(waist, hyperbolic, 1.5 * waist.conversion_error);
}

}  // namespace
}  // namespace umbilic
