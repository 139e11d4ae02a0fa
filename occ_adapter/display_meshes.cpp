// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shape_to_model.h"

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include "occ_types.h"

namespace umbilic {

namespace {

/// Largest angle (radians) between neighbouring segments of the triangulated edges.
constexpr double angular_deflection = 0.35;

DisplayMesh mesh_of(const TopoDS_Face& shape, const Face& face) {
    DisplayMesh mesh;
    mesh.face = face.number;
    TopLoc_Location location;
    const Handle(Poly_Triangulation) triangulation = BRep_Tool::Triangulation(shape, location);
    if (triangulation.IsNull() || !triangulation->HasUVNodes()) return mesh;
    for (int i = 1; i <= triangulation->NbNodes(); ++i) {
        mesh.points.push_back(to_vector(triangulation->Node(i).Transformed(location.Transformation())));
        const gp_Pnt2d native = triangulation->UVNode(i);
        mesh.parameters.emplace_back(face.region.u_map().surface(native.X()), face.region.v_map().surface(native.Y()));
    }
    for (int i = 1; i <= triangulation->NbTriangles(); ++i) {
        int a = 0, b = 0, c = 0;
        triangulation->Triangle(i).Get(a, b, c);
        if (face.reversed) std::swap(b, c);
        mesh.triangles.push_back({a - 1, b - 1, c - 1});
    }
    return mesh;
}

}  // namespace

std::vector<DisplayMesh> display_meshes(const TopoDS_Shape& shape, double deflection, Model& model) {
    const BRepMesh_IncrementalMesh mesher(shape, deflection, Standard_False, angular_deflection, Standard_True);
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    std::vector<DisplayMesh> result;
    for (const Face& face : model.faces) {
        result.push_back(mesh_of(TopoDS::Face(faces(face.number)), face));
        if (result.back().triangles.empty())
            model.warnings.push_back("face " + std::to_string(face.number) + " could not be triangulated for display");
    }
    return result;
}

}  // namespace umbilic
