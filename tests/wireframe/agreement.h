// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/core/similarity_transform.h>
#include <umbilic/model/model.h>
#include <umbilic/wireframe/wireframe.h>

namespace umbilic::test {

/// Greatest distance, as a share of the step, at which two nodes are the same. The integration of each line is accurate
/// to 1e-7 of the step at each of its steps; crossings of lines in turn start new lines.
inline constexpr double same_node = 1e-2;

/// What the nodes of two wireframes of one face are to each other.
struct Agreement {
    int nodes = 0;          ///< of both
    int unmatched = 0;      ///< without a node of the other within `same_node`
    double farthest = 0.0;  ///< greatest distance of the others from their counterpart, relative to the step
};

/// Places and normals moved.
FaceWireframe moved(FaceWireframe wireframe, const SimilarityTransform& space);

/// Of nodes as they stand.
Agreement agreement(const FaceWireframe& one, const FaceWireframe& other, double step);

/// Of the nodes of `one`, moved by the symmetry of the face for which they agree best, and of `other`. A symmetry is an
/// isometry that carries the edges of `one`, points between nodes included, onto the face.
Agreement agreement_up_to_symmetry(const Face& face, const FaceWireframe& one, const FaceWireframe& other, double step);

}  // namespace umbilic::test
