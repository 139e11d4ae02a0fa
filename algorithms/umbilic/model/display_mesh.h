// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <umbilic/core/types.h>

namespace umbilic {

/// Triangulation of one trimmed face, for pictures only: nothing is measured on it.
struct DisplayMesh {
    int face = 0;                               ///< number of the face
    std::vector<Vector3> points;                ///< mm
    std::vector<Vector2> parameters;            ///< of the face's NURBS surface, one per point
    std::vector<std::array<int, 3>> triangles;  ///< indices into `points`, counter-clockwise seen from the outward side
};

}  // namespace umbilic
