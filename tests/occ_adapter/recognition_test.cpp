// SPDX-License-Identifier: LGPL-2.1-or-later
// Recognition of NURBS surfaces against what the file says of the same faces, and of surfaces as the kernel builds
// them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <Eigen/Geometry>

#include <occ_adapter/shape_file.h>
#include <occ_adapter/shape_to_model.h>
#include <umbilic/differential/recognise.h>

#include "cad_files.h"

namespace umbilic {
namespace {

using support::cad;

Model model_in(const std::string& path) {
    return shape_to_model(read_shape_file(path, describe_file(path), Progress()).shape);
}

void expect_parameters(SurfaceKind kind, const ElementarySurface& got, const ElementarySurface& wanted, double error) {
    EXPECT_NEAR(got.radius * (kind != SurfaceKind::cone), wanted.radius * (kind != SurfaceKind::cone), error);
    EXPECT_NEAR(got.minor_radius, wanted.minor_radius, error);
    const Vector3 apart = got.location - wanted.location;
    if (kind == SurfaceKind::sphere || kind == SurfaceKind::torus) {
        EXPECT_LE(apart.norm(), error);
    } else if (kind == SurfaceKind::plane) {
        EXPECT_LE(std::abs(apart.dot(wanted.axis)), error);
    } else {
        EXPECT_LE(apart.cross(wanted.axis).norm(), error);
    }
    if (kind != SurfaceKind::sphere) {
        EXPECT_LE(got.axis.cross(wanted.axis).norm(), 1e-7);
    }
    if (kind == SurfaceKind::cone) {
        EXPECT_NEAR(got.semi_angle, std::abs(wanted.semi_angle), 1e-7);
    }
}

class FilesWithElementaryFaces : public testing::TestWithParam<const char*> {};

TEST_P(FilesWithElementaryFaces, TheirNurbsFormsAreRecognised) {
    UMBILIC_NEEDS_CAD_FILES();
    const Model model = model_in(cad(GetParam()));
    int elementary_faces = 0;
    for (const Face& face : model.faces) {
        if (!elementary(face.kind) || !face.elementary) continue;
        ++elementary_faces;
        const std::optional<RecognisedSurface> found = recognise(face.surface);
        ASSERT_TRUE(found) << "face " << face.number << " is a " << name(face.kind);
        ASSERT_EQ(std::string(name(found->kind)), name(face.kind)) << "face " << face.number;
        SCOPED_TRACE("face " + std::to_string(face.number) + ", a " + name(face.kind));
        EXPECT_TRUE(found->exact) << found->deviation;
        // Far points of axes: the piece may be small beside its distance from there.
        const double error = 10 * found->parameter_error + 1e-9 * (1.0 + face.surface.pole_box().diagonal());
        expect_parameters(face.kind, found->surface, *face.elementary, error);
    }
    EXPECT_GT(elementary_faces, 10);
}

INSTANTIATE_TEST_SUITE_P(, FilesWithElementaryFaces,
                         testing::Values("mechanical/nist_mbe_pmi_2.stp", "mechanical/as1_assembly_inch_ap203.stp"),
                         [](const auto& info) { return std::filesystem::path(info.param).stem().string(); });

TEST(Recognition, SphereOfAnotherModeller) {
    UMBILIC_NEEDS_CAD_FILES();
    const Model model = model_in(cad("freeform/sphere_rational_periodic_poles.igs"));
    ASSERT_EQ(model.faces.size(), 1u);
    const std::optional<RecognisedSurface> found = recognise(model.faces[0].surface);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind, SurfaceKind::sphere);
    EXPECT_NEAR(found->surface.radius, 1.0, 1e-9);
    EXPECT_TRUE(found->exact) << found->deviation;
}

TEST(Recognition, FreeFormFacesAreNotTakenForElementaryOnes) {
    UMBILIC_NEEDS_CAD_FILES();
    for (const char* file : {"freeform/sunglasses_lens_inch.igs", "freeform/nacelle_quintic.stp"}) {
        for (const Face& face : model_in(cad(file)).faces) {
            const std::optional<RecognisedSurface> found = recognise(face.surface, {.tolerance = 1e-6});
            EXPECT_FALSE(found && elementary(found->kind)) << file << " face " << face.number;
        }
    }
}

TEST(Recognition, PrimitivesOfTheKernelConvertedToNurbs) {
    const auto faces = [](const TopoDS_Shape& shape) {
        return shape_to_model(BRepBuilderAPI_NurbsConvert(shape).Shape()).faces;
    };
    const auto count = [](const std::vector<Face>& faces, SurfaceKind kind, double radius) {
        int result = 0;
        for (const Face& face : faces) {
            EXPECT_EQ(face.kind, SurfaceKind::bspline);
            const std::optional<RecognisedSurface> found = recognise(face.surface);
            if (found && found->exact && found->kind == kind)
                result += kind == SurfaceKind::cone || std::abs(found->surface.radius - radius) <= 1e-10;
        }
        return result;
    };
    EXPECT_EQ(count(faces(BRepPrimAPI_MakeSphere(7.0).Shape()), SurfaceKind::sphere, 7.0), 1);
    const std::vector<Face> can = faces(BRepPrimAPI_MakeCylinder(3.0, 20.0).Shape());
    EXPECT_EQ(count(can, SurfaceKind::cylinder, 3.0), 1);
    EXPECT_EQ(count(can, SurfaceKind::plane, 0.0), 2);
    EXPECT_EQ(count(faces(BRepPrimAPI_MakeCone(3.0, 0.0, 5.0).Shape()), SurfaceKind::cone, 0.0), 1);
    EXPECT_EQ(count(faces(BRepPrimAPI_MakeTorus(9.0, 2.0).Shape()), SurfaceKind::torus, 9.0), 1);
}

}  // namespace
}  // namespace umbilic
