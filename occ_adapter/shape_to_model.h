// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <TopoDS_Shape.hxx>

#include <umbilic/core/progress.h>
#include <umbilic/model/display_mesh.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Converts every face of a shape, in the order of TopExp's map, whatever file or program the shape came from: exact
/// NURBS surfaces in model coordinates, trimming loops, orientation, areas, solids with mass properties, validity.
/// Faces that cannot be converted stand in `skipped`, loops that had to be healed in `repaired`. `source`, names,
/// colours and `declared_faces` are left to the caller. Throws InvalidInput if the shape is null, holds no face or
/// has no finite extent; Cancelled.
Model shape_to_model(const TopoDS_Shape& shape, const Progress& progress = {});

/// Triangulates the faces of `model`, which shape_to_model() made from this shape, with the given chordal deflection
/// (mm). A face the kernel cannot triangulate gets a mesh without triangles and a warning in the model.
std::vector<DisplayMesh> display_meshes(const TopoDS_Shape& shape, double deflection, Model& model);

}  // namespace umbilic
