// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <utility>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

#include <occ_adapter/read_file.h>
#include <occ_adapter/shape_to_model.h>
#include <umbilic/differential/edge_smoothness.h>
#include <umbilic/model/face_adjacency.h>

#include "cad_files.h"

namespace umbilic {
namespace {

/// The model as if its file had no topology.
Model loose(const Model& model) {
    Model result = model;
    for (Face& face : result.faces) {
        std::vector<TrimmingLoop> loops = face.region.loops();
        for (TrimmingLoop& loop : loops)
            for (TrimmingCurve& curve : loop) curve.edge = 0;
        face.region = TrimmingRegion(face.region.domain(), std::move(loops), face.region.u_map(), face.region.v_map());
    }
    return result;
}

void expect_one_closed_shell(const Model& model, int vertices, int edges, int euler_characteristic) {
    const FaceAdjacency adjacency = face_adjacency(model);
    ASSERT_EQ(adjacency.shells.size(), 1u);
    const Shell& shell = adjacency.shells[0];
    EXPECT_TRUE(shell.closed);
    EXPECT_EQ(shell.vertices, vertices);
    EXPECT_EQ(shell.edges, edges);
    EXPECT_EQ(shell.euler_characteristic, euler_characteristic);
}

TEST(FaceAdjacency, SolidsOfTheKernelHaveTheirEulerCharacteristic) {
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(2.0, 3.0, 4.0).Shape();
    const TopoDS_Shape drill = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(1, 1.5, -1), gp_Dir(0, 0, 1)), 0.5, 9.0).Shape();
    struct Case {
        TopoDS_Shape shape;
        int vertices, edges, characteristic;
    };
    const Case cases[] = {
        {box, 8, 12, 2},
        {BRepPrimAPI_MakeCylinder(1.0, 2.0).Shape(), 2, 3, 2},
        {BRepPrimAPI_MakeSphere(1.0).Shape(), 2, 1, 2},
        {BRepPrimAPI_MakeTorus(2.0, 1.0).Shape(), 1, 2, 0},
        {BRepAlgoAPI_Cut(box, drill).Shape(), 10, 15, 0},
    };
    for (const Case& one : cases) {
        const Model model = shape_to_model(one.shape);
        expect_one_closed_shell(model, one.vertices, one.edges, one.characteristic);
        expect_one_closed_shell(loose(model), one.vertices, one.edges, one.characteristic);
    }
}

TEST(FaceAdjacency, BoxBendsByARightAngleAndTheTorusNowhere) {
    const Model box = shape_to_model(BRepPrimAPI_MakeBox(2.0, 3.0, 4.0).Shape());
    for (const EdgeSmoothness& edge : edge_smoothness(face_adjacency(box))) EXPECT_NEAR(edge.bend, M_PI / 2, 1e-12);
    const Model torus = shape_to_model(BRepPrimAPI_MakeTorus(2.0, 1.0).Shape());
    for (const EdgeSmoothness& edge : edge_smoothness(face_adjacency(torus))) {
        EXPECT_LE(edge.bend, 1e-12);
        EXPECT_LE(edge.curvature_jump, 1e-12);
    }
}

TEST(FaceAdjacency, TopologyOfTheBracketIsFoundByCoincidenceToo) {
    const Model model = read_file(UMBILIC_MODELS_DIR "/bracket.step").model;
    const FaceAdjacency stated = face_adjacency(model);
    const Model without = loose(model);
    const FaceAdjacency found = face_adjacency(without);
    ASSERT_EQ(stated.shells.size(), 1u);
    ASSERT_EQ(found.shells.size(), 1u);
    EXPECT_TRUE(stated.shells[0].closed && found.shells[0].closed);
    EXPECT_EQ(stated.edges.size(), found.edges.size());
    EXPECT_EQ(stated.shells[0].euler_characteristic, found.shells[0].euler_characteristic);
    EXPECT_EQ(stated.shells[0].vertices, found.shells[0].vertices);
}

TEST(FaceAdjacency, EllipsoidOfOneFaceIsClosedAlongItsSeam) {
    const Model model = read_file(UMBILIC_MODELS_DIR "/ellipsoid.step").model;
    const FaceAdjacency adjacency = face_adjacency(model);
    ASSERT_EQ(adjacency.edges.size(), 1u);
    ASSERT_EQ(adjacency.edges[0].uses.size(), 2u);
    EXPECT_EQ(adjacency.shells[0].euler_characteristic, 2);
    const ParameterBox domain = model.faces[0].surface.domain();
    const BorderPoint border = nearest_in_parameters(model.faces[0], adjacency.borders.loops_of(1),
                                                     Vector2(domain.u.low, domain.v.low + 0.3 * domain.v.length()));
    const std::vector<EdgeCrossing> crossings = across(adjacency, border);
    ASSERT_EQ(crossings.size(), 1u);
    EXPECT_NEAR(crossings[0].to.parameters.x(), domain.u.high, 1e-12);
    EXPECT_NEAR(crossings[0].to.parameters.y(), border.parameters.y(), 1e-9);
}

TEST(FaceAdjacency, LensOfNineLoosePatchesIsOneSmoothDisc) {
    UMBILIC_NEEDS_CAD_FILES();
    const Model model = read_file(support::cad("freeform/sunglasses_lens_inch.igs")).model;
    const FaceAdjacency adjacency = face_adjacency(model);
    ASSERT_EQ(adjacency.shells.size(), 1u);
    EXPECT_FALSE(adjacency.shells[0].closed);
    EXPECT_EQ(adjacency.shells[0].euler_characteristic, 1);
    const std::vector<EdgeSmoothness> smoothness = edge_smoothness(adjacency);
    for (std::size_t i = 0; i < smoothness.size(); ++i)
        if (adjacency.edges[i].uses.size() == 2) {
            EXPECT_TRUE(smoothness[i].smooth(default_largest_bend)) << "bend " << smoothness[i].bend;
        }
}

}  // namespace
}  // namespace umbilic
