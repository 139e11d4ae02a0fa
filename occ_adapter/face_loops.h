// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Face.hxx>

#include <umbilic/nurbs/trimming.h>

namespace umbilic {

/// The wires of a face as loops in the native parameters of its surface.
struct FaceLoops {
    std::vector<TrimmingLoop> loops;
    /// Box of the loops; without loops the surface's own bounds, which may be infinite.
    ParameterBox range;
    /// Largest tolerance (mm) of the face, its edges and vertices.
    double tolerance = 0.0;
};

/// Reads the loops from the parameter curves of the edges; `edges` numbers the model's edges from 1. Throws
/// InvalidInput if an edge has no parameter curve.
FaceLoops face_loops(const TopoDS_Face& face, const TopTools_IndexedMapOfShape& edges);

/// The face with its wires healed (order, gaps, missing parameter curves, seams and degenerate edges) on the same
/// surface, as one or, if its wires enclose several pieces, more faces; empty if healing found nothing to do.
std::vector<TopoDS_Face> healed_faces(const TopoDS_Face& face);

}  // namespace umbilic
