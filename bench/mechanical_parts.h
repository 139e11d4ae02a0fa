// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <TopoDS_Shape.hxx>

#include <umbilic/core/similarity_transform.h>

namespace umbilic::bench {

struct MechanicalPart {
    std::string name;
    TopoDS_Shape shape;
};

/// Bracket, flange with six holes, shaft, housing, prismatic blocks; two of them also with all faces as NURBS.
std::vector<MechanicalPart> made_parts();

/// A square plate with `count` round bosses on a grid, cylinders, cones and spheres by turns with random radii and
/// heights; some 5 faces for every three bosses, and the plate's top trimmed by all of them.
TopoDS_Shape plate_with_bosses(int count, unsigned seed);

/// Solids of a CAD file, those of different volume, at most `count`.
std::vector<MechanicalPart> parts_of_file(const std::string& path, const std::string& name, int count);

/// The parts of a shape's faces inside a ball: open faces, cut along it.
TopoDS_Shape inside_ball(const TopoDS_Shape& shape, const Vector3& centre, double radius);

int face_count(const TopoDS_Shape& shape);

/// The faces of a shape, then those of another one, scaled to the same area and set beside it.
TopoDS_Shape with_neighbour(const TopoDS_Shape& shape, const TopoDS_Shape& neighbour);

/// The shape moved, scaled and mirrored.
TopoDS_Shape moved(const TopoDS_Shape& shape, const SimilarityTransform& transform);

}  // namespace umbilic::bench
