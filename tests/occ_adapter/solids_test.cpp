// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <numbers>

#include <Eigen/Geometry>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <BinTools_ShapeSet.hxx>
#include <TopoDS_Compound.hxx>

#include <occ_adapter/shape_file.h>
#include <occ_adapter/shape_to_model.h>
#include <umbilic/core/errors.h>

#include "cad_files.h"

namespace umbilic {
namespace {

/// Sum over the faces of the flux of x / 3 through them, from our own surfaces, trimming and sides: the volume.
double volume_by_flux(const Model& model) {
    constexpr int cells = 400;
    double volume = 0.0;
    for (const Face& face : model.faces) {
        const ParameterBox box = face.region.box();
        const double du = box.u.length() / cells, dv = box.v.length() / cells;
        for (int i = 0; i < cells; ++i)
            for (int j = 0; j < cells; ++j) {
                const double u = box.u.low + (i + 0.5) * du, v = box.v.low + (j + 0.5) * dv;
                if (face.region.classify(u, v) == Containment::outside) continue;
                const SurfaceDerivatives d = face.surface.derivatives(u, v, 1);
                volume += d.r().dot(d.r_u().cross(d.r_v())) / 3 * du * dv * (face.reversed ? -1.0 : 1.0);
            }
    }
    return volume;
}

TEST(Solids, BoxHasItsClosedForms) {
    const Model model = shape_to_model(BRepPrimAPI_MakeBox(gp_Pnt(10, 20, 30), 2.0, 3.0, 4.0).Shape());
    ASSERT_EQ(model.faces.size(), 6u);
    ASSERT_EQ(model.solids.size(), 1u);
    const Solid& solid = model.solids[0];
    EXPECT_NEAR(solid.volume, 24.0, 1e-12);
    EXPECT_NEAR(solid.area, 52.0, 1e-12);
    EXPECT_NEAR(model.area, 52.0, 1e-12);
    EXPECT_LE((solid.centroid - Vector3(11, 21.5, 32)).norm(), 1e-12);
    // m / 12 (b^2 + c^2) about the centroid.
    const Matrix3 inertia = Vector3(2 * (9 + 16), 2 * (4 + 16), 2 * (4 + 9)).asDiagonal();
    EXPECT_LE((solid.inertia - inertia).norm(), 1e-9);
    EXPECT_LE((model.box.low - Vector3(10, 20, 30)).norm(), 1e-12);
    EXPECT_LE((model.box.high - Vector3(12, 23, 34)).norm(), 1e-12);
    EXPECT_TRUE(model.oriented() && model.valid);
    EXPECT_EQ(model.shells, 1);
    EXPECT_NEAR(volume_by_flux(model), 24.0, 1e-9);
}

TEST(Solids, SidesOfFacesEncloseTheVolume) {
    const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(-2, -2, -2), 4.0, 4.0, 4.0).Shape();
    const TopoDS_Shape drilled = BRepAlgoAPI_Cut(
        block, BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0.3, 0.2, -3), gp_Dir(0, 0, 1)), 0.8, 9.0).Shape());
    const double expected = 64 - std::numbers::pi * 0.64 * 4;
    gp_Trsf mirror;
    mirror.SetMirror(gp_Ax2(gp_Pnt(5, 0, 0), gp_Dir(1, 0.3, 0)));
    const TopoDS_Shape copied = BRepBuilderAPI_Transform(drilled, mirror, Standard_True).Shape();
    TopoDS_Shape placed = drilled;
    placed.Move(TopLoc_Location(mirror), Standard_False);
    for (const TopoDS_Shape& shape : {drilled, copied, placed, TopoDS_Shape(drilled.Reversed())}) {
        const Model model = shape_to_model(shape);
        EXPECT_NEAR(model.volume, expected, 1e-5 * expected);
        EXPECT_NEAR(volume_by_flux(model), expected, 5e-3 * expected);  // cells that the hole's edge crosses
    }
    EXPECT_EQ(shape_to_model(drilled.Reversed()).repaired.size(), 1u);
}

TEST(Solids, InstancesOfOnePartAreDifferentFaces) {
    const TopoDS_Shape part = BRepPrimAPI_MakeSphere(1.0).Shape();
    gp_Trsf move;
    move.SetTranslation(gp_Vec(5, 0, 0));
    TopoDS_Compound both;
    const BRep_Builder builder;
    builder.MakeCompound(both);
    builder.Add(both, part);
    builder.Add(both, part.Moved(TopLoc_Location(move)));
    const Model model = shape_to_model(both);
    ASSERT_EQ(model.faces.size(), 2u);
    EXPECT_EQ(model.solids.size(), 2u);
    EXPECT_EQ(model.faces[1].solid, 1);
    EXPECT_NEAR(model.faces[1].elementary->location.x(), 5.0, 1e-14);
    EXPECT_NEAR(model.box.high.x(), 6.0, 1e-4);
}

TEST(Solids, EmptyAndVoidShapesAreErrors) {
    EXPECT_THROW(shape_to_model(TopoDS_Shape()), InvalidInput);
    TopoDS_Compound empty;
    BRep_Builder().MakeCompound(empty);
    EXPECT_THROW(shape_to_model(empty), InvalidInput);
}

TEST(Solids, EveryKindOfBrepFileIsRead) {
    const support::TemporaryFolder folder;
    gp_Trsf move;
    move.SetTranslation(gp_Vec(1, 2, 3));
    const TopoDS_Shape shape = BRepPrimAPI_MakeBox(2.0, 3.0, 4.0).Shape().Moved(TopLoc_Location(move));
    BRepTools::Write(shape, folder.file("text.brep").c_str());
    BinTools::Write(shape, folder.file("binary.bin").c_str());
    {
        std::ofstream out(folder.file("framed.bin"), std::ios::binary);
        BinTools_ShapeSet set;
        const int number = set.Add(shape), location = set.Locations().Index(shape.Location());
        set.Write(out);
        BinTools::PutInteger(out, number);
        BinTools::PutInteger(out, location);
        BinTools::PutInteger(out, shape.Orientation());
    }
    for (const auto& [name, format] :
         {std::pair("text.brep", "BREP"), std::pair("binary.bin", "BREP"), std::pair("framed.bin", "shape")}) {
        const std::string path = folder.file(name);
        const ShapeFile file = read_shape_file(path, describe_file(path), Progress());
        EXPECT_EQ(file.format, format);
        const Model model = shape_to_model(file.shape);
        EXPECT_NEAR(model.volume, 24.0, 1e-9) << name;
        EXPECT_NEAR(model.solids.at(0).centroid.z(), 5.0, 1e-9) << name;
    }
}

}  // namespace
}  // namespace umbilic
