// SPDX-License-Identifier: LGPL-2.1-or-later
// Facts of the real CAD files, as FreeCAD measured them (faces by type, solids, units) and as their exporters state.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include <Eigen/Geometry>

#include <occ_adapter/read_file.h>
#include <umbilic/core/errors.h>

#include "cad_files.h"

namespace umbilic {
namespace {

using support::cad;

struct Facts {
    const char* file;
    const char* sha256;  ///< first digits
    const char* format;
    const char* unit;
    double unit_in_mm;
    std::map<std::string, int> faces;  ///< by kind, skipped ones included as "skipped"
    int solids;
    bool valid;
    double longest;   ///< largest side of the box of poles (mm) as FreeCAD gives it: an upper bound
    double shortest;  ///< true largest side is at least this part of it
};

/// Names the case where GoogleTest would print its bytes.
void PrintTo(const Facts& facts, std::ostream* out) {
    *out << facts.file;
}

class FileFacts : public testing::TestWithParam<Facts> {};

TEST_P(FileFacts, AreFound) {
    UMBILIC_NEEDS_CAD_FILES();
    const Facts& facts = GetParam();
    const Model model = read_file(cad(facts.file)).model;
    EXPECT_EQ(model.source.sha256.substr(0, 16), facts.sha256);
    EXPECT_EQ(model.source.sha256.size(), 64u);
    EXPECT_EQ(model.source.bytes, std::filesystem::file_size(cad(facts.file)));
    EXPECT_EQ(model.source.format, facts.format);
    EXPECT_EQ(model.source.unit, facts.unit);
    EXPECT_NEAR(model.source.unit_in_mm, facts.unit_in_mm, 1e-6 * facts.unit_in_mm);
    EXPECT_EQ(model.source.path, cad(facts.file));
    std::map<std::string, int> found;
    std::set<int> numbers;
    double area = 0.0;
    for (const Face& face : model.faces) {
        ++found[name(face.kind)];
        numbers.insert(face.number);
        area += face.area;
        EXPECT_EQ(face.conversion_error, 0.0) << "face " << face.number;
    }
    for (const Skipped& skipped : model.skipped) {
        ++found["skipped"];
        numbers.insert(skipped.face);
    }
    EXPECT_EQ(found, facts.faces);
    // Every number from 1 is a face or skipped, and none is both.
    EXPECT_EQ(numbers.size(), model.faces.size() + model.skipped.size());
    EXPECT_EQ(*numbers.begin(), 1);
    EXPECT_EQ(*numbers.rbegin(), static_cast<int>(numbers.size()));
    EXPECT_EQ(static_cast<int>(model.solids.size()), facts.solids);
    EXPECT_EQ(model.valid, facts.valid);
    const double longest = (model.box.high - model.box.low).maxCoeff();
    EXPECT_LE(longest, facts.longest * 1.0005);  // four digits are stated
    EXPECT_GE(longest, facts.longest * facts.shortest);
    EXPECT_NEAR(model.area, area, 1e-9 * area);
}

INSTANTIATE_TEST_SUITE_P(
    Files, FileFacts,
    testing::Values(
        Facts{"freeform/kvlcc2m_tanker_hull.iges",
              "15fed07a4dedcc70",
              "IGES",
              "metre",
              1000,
              {{"bspline", 14}},
              0,
              true,
              5977,
              0.9},
        Facts{"freeform/kcs_container_ship_hull.iges",
              "4d2c757beb6a3298",
              "IGES",
              "metre",
              1000,
              {{"bspline", 53}, {"revolution", 2}},
              0,
              true,
              7717,
              0.99},
        Facts{"freeform/ucrm9_wing_metres_flagged_inch.igs",
              "7462e9d14185c9d2",
              "IGES",
              "inch",
              25.4,
              {{"bspline", 11}},
              0,
              true,
              750,
              0.99},
        Facts{
            "freeform/nacelle_quintic.stp", "0b9aa3c21763bfde", "STEP", "mm", 1, {{"bspline", 6}}, 0, true, 2603, 0.99},
        Facts{"freeform/sunglasses_lens_inch.igs",
              "b118c35ae791e722",
              "IGES",
              "inch",
              25.4,
              {{"bspline", 9}},
              0,
              true,
              63.11,
              0.99},
        Facts{"freeform/sphere_rational_periodic_poles.igs",
              "2b346b905a2521ab",
              "IGES",
              "mm",
              1,
              {{"bspline", 1}},
              0,
              true,
              2,
              0.99},
        Facts{"mechanical/nist_mbe_pmi_2.stp",
              "d5717b2e09fe905f",
              "STEP",
              "mm",
              1,
              {{"bspline", 460}, {"plane", 137}},
              1,
              true,
              868.3,
              0.9},
        Facts{"mechanical/as1_assembly_inch_ap203.stp",
              "be1254354f6929a0",
              "STEP",
              "inch",
              25.4,
              {{"plane", 90}, {"cylinder", 70}},
              18,
              true,
              5080,
              0.99},
        Facts{"pairs/dtmb5415_hull.iges",
              "72ac139ad478fd93",
              "IGES",
              "metre",
              1000,
              {{"bspline", 3}},
              0,
              true,
              6119.1,
              0.99},
        Facts{"pairs/dtmb5415_hull_moved.iges",
              "797789cfed2d4cbf",
              "IGES",
              "metre",
              1000,
              {{"bspline", 3}},
              0,
              true,
              6117.5,
              0.99},
        Facts{"pairs/dtmb5415_bulbous_bow.iges",
              "8f4e90ccc1e1dd54",
              "IGES",
              "metre",
              1000,
              {{"bspline", 1}},
              0,
              true,
              1186,
              0.85},
        Facts{
            "pairs/iea15_blade_2022_mm.stp", "021d1ac818cf04f6", "STEP", "mm", 1, {{"bspline", 3}}, 0, true, 117, 0.99},
        Facts{
            "pairs/iea15_blade_2023_mm.stp", "2dada8507c566515", "STEP", "mm", 1, {{"bspline", 3}}, 0, true, 117, 0.99},
        Facts{"pairs/iea15_blade_2023_metres.igs",
              "e8adcdc895c91c70",
              "IGES",
              "metre",
              1000,
              {{"bspline", 3}},
              0,
              true,
              1.17e5,
              0.99},
        // 46 of the faces are collapsed to lines: both rows of control points of their bilinear surfaces coincide.
        Facts{"pairs/b777_openvsp.stp",
              "1696ba6598eea25f",
              "STEP",
              "foot",
              304.8,
              {{"bspline", 67}, {"skipped", 46}},
              0,
              false,
              6.44e4,
              0.99},
        Facts{"pairs/b777_onshape.step",
              "8d400513c016700f",
              "STEP",
              "metre",
              1000,
              {{"bspline", 41}, {"plane", 10}},
              6,
              true,
              6.44e4,
              0.99},
        Facts{"pairs/sculpted_surface_iges114_inch.igs",
              "4f4861df35acf8ce",
              "IGES",
              "inch",
              25.4,
              {{"bspline", 4}},
              0,
              true,
              96.86,
              0.95},
        Facts{"pairs/sculpted_surface_iges128_inch.igs",
              "49b06e55d1c377f1",
              "IGES",
              "inch",
              25.4,
              {{"bspline", 4}},
              0,
              true,
              102.1,
              0.9},
        Facts{"pairs/propeller_1045.step",
              "a2f97b63de2916ea",
              "STEP",
              "mm",
              1,
              {{"bspline", 12}, {"plane", 4}, {"cylinder", 2}, {"torus", 2}},
              1,
              true,
              260.3,
              0.99},
        Facts{"pairs/propeller_1045_mirrored_edited.step",
              "864a987598c9f0d2",
              "STEP",
              "mm",
              1,
              {{"bspline", 18}, {"plane", 6}, {"cylinder", 4}, {"torus", 4}},
              1,
              true,
              272.1,
              0.9}),
    [](const auto& info) {
        std::string name = std::filesystem::path(info.param.file).stem().string();
        return name;
    });

TEST(FileFacts, DeclaredFacesThatDidNotArriveAreAWarning) {
    UMBILIC_NEEDS_CAD_FILES();
    const Model model = read_file(cad("pairs/b777_onshape.step")).model;
    EXPECT_EQ(model.declared_faces, 52);
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_NE(model.warnings[0].find("declares 52 faces, but only 51"), std::string::npos) << model.warnings[0];
}

TEST(FileFacts, AssemblyInstancesAreFacesOfTheirOwnWithColours) {
    UMBILIC_NEEDS_CAD_FILES();
    const Model model = read_file(cad("mechanical/as1_assembly_inch_ap203.stp")).model;
    EXPECT_EQ(model.declared_faces, 53);  // each part once
    EXPECT_TRUE(model.oriented());
    for (const Face& face : model.faces) EXPECT_TRUE(face.color.has_value()) << face.number;
}

TEST(FileFacts, RealPairsDifferAsStated) {
    UMBILIC_NEEDS_CAD_FILES();
    const Model mm = read_file(cad("pairs/iea15_blade_2023_mm.stp")).model;
    const Model metres = read_file(cad("pairs/iea15_blade_2023_metres.igs")).model;
    EXPECT_NEAR(metres.area / mm.area, 1e6, 10.0);
    const Model hull = read_file(cad("pairs/dtmb5415_hull.iges")).model;
    const Model moved = read_file(cad("pairs/dtmb5415_hull_moved.iges")).model;
    EXPECT_NEAR(moved.area / hull.area, 1.0, 1e-5);
}

TEST(FileFacts, DisplayMeshesLieOnTheirFaces) {
    UMBILIC_NEEDS_CAD_FILES();
    ReadOptions options;
    options.display_meshes = true;
    const ReadResult result = read_file(cad("pairs/propeller_1045.step"), options);
    ASSERT_EQ(result.meshes.size(), result.model.faces.size());
    for (std::size_t i = 0; i < result.meshes.size(); ++i) {
        const DisplayMesh& mesh = result.meshes[i];
        const Face& face = result.model.faces[i];
        EXPECT_EQ(mesh.face, face.number);
        EXPECT_FALSE(mesh.triangles.empty());
        // Points on edges are those of the edge, which follows its curve in the parameter plane as loosely as the
        // file's author left it; what is asked of a picture is the deflection.
        const double tolerance = options.display_deflection * result.model.box.diagonal();
        for (std::size_t k = 0; k < mesh.points.size(); ++k) {
            const Vector3 on_surface = face.surface.value(mesh.parameters[k].x(), mesh.parameters[k].y());
            EXPECT_LE((on_surface - mesh.points[k]).norm(), tolerance) << "face " << face.number;
        }
        // Most triangles look outward, as far as the surface turns within them.
        Vector3 sum = Vector3::Zero(), normals = Vector3::Zero();
        for (const auto& [a, b, c] : mesh.triangles) {
            sum += (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
            const Vector2 uv = (mesh.parameters[a] + mesh.parameters[b] + mesh.parameters[c]) / 3.0;
            const SurfaceDerivatives d = face.surface.derivatives(uv.x(), uv.y(), 1);
            const Vector3 normal = d.r_u().cross(d.r_v()) * (face.reversed ? -1.0 : 1.0);
            const double area = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
            if (normal.norm() > 0.0) normals += area * normal.normalized();
        }
        if (normals.norm() > 0.1 * face.area) {
            EXPECT_GT(sum.dot(normals), 0.0) << "face " << face.number;
        }
    }
}

}  // namespace
}  // namespace umbilic
