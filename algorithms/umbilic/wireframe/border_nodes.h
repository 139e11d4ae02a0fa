// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/model/face_adjacency.h>

namespace umbilic {

/// What the stretch between two neighbours on a face's border is.
enum class BorderKind {
    border,  ///< of the face in space
    seam,    ///< where the parameter plane of a closed surface is cut
    pole     ///< a single point in space
};

/// A place on a border loop of a face, in the face's parameters.
struct BorderNode {
    Vector2 parameters = Vector2::Zero();
    Vector3 point = Vector3::Zero();
    /// Nodes of a face with the same number are the same point: on both sides of a seam, at a pole.
    int identity = 0;
    /// The stretch to the next node of the loop.
    BorderKind kind = BorderKind::border;
    double length = 0.0;           ///< of that stretch, mm
    std::vector<Vector3> between;  ///< points of it at equal distances, without its ends
    int edge = -1;                 ///< index into FaceAdjacency::edges
};

/// The border of one face.
struct FaceBorder {
    std::vector<std::vector<BorderNode>> loops;
    int identities = 0;
    /// By identity: the point lies on a border in space, not only on a seam.
    std::vector<bool> on_border;
};

struct BorderNodeOptions {
    double step = 0.0;  ///< mm, distance of neighbours at most `longest_stretch` times this
    /// By edge: how many times as many nodes as the step asks for.
    std::vector<int> multiples;
};

inline constexpr double longest_stretch = 1.137;
/// Points between neighbours, at equal distances.
inline constexpr int between_count = 3;

/// Nodes on the edges of a model, by arc length in equal parts, the same points for all faces at an edge: they depend
/// on the edge alone. The ends of edges are nodes; an edge that is a loop of its own has three at least, and two
/// neighbours differ in direction by 60 degrees at most.
std::vector<FaceBorder> border_nodes(const FaceAdjacency& adjacency, const BorderNodeOptions& options,
                                     const Progress& progress = {});

}  // namespace umbilic
