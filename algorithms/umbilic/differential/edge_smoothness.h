// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/model/face_adjacency.h>

namespace umbilic {

/// How two faces continue each other across a shared edge, at samples along it.
struct EdgeSmoothness {
    int samples = 0;  ///< regular ones; nothing is known about the edge if 0
    /// Largest angle (radians) between the directions in which one face runs into the edge and the other out of it: 0
    /// for a common tangent plane (G1), pi where the surface folds back.
    double bend = 0.0;
    /// Largest difference (1/mm) of the normal curvatures across the edge, and the largest of these curvatures. Along
    /// a G1 edge the other parts of the second fundamental form agree by themselves, so 0 means G2.
    double curvature_jump = 0.0;
    double curvature = 0.0;
    /// Largest angle (radians, up to pi / 2) between the directions of greatest curvature on both sides, where both
    /// sides have one beyond rounding. Small on a G2 edge; where it is, the principal directions of one face go on into
    /// the other even if the curvature jumps.
    double direction_jump = 0.0;

    bool smooth(double largest_bend) const { return samples > 0 && bend <= largest_bend; }
};

/// Bend (radians) up to which an edge counts as smooth unless the caller chooses: 0.5 degrees, the tolerance for
/// tangency usual in exchange between CAD systems.
inline constexpr double default_largest_bend = 8.7e-3;

/// Direction jump (radians) up to which the principal directions count as continuous across an edge: 10 degrees. Around
/// a vertex of any usual number of edges such jumps sum to less than the half turn of an umbilic.
inline constexpr double default_largest_direction_jump = 0.1745;

/// Smoothness of an edge between its first two uses; without samples if it has not exactly two.
EdgeSmoothness edge_smoothness(const FaceAdjacency& adjacency, const Edge& edge);

/// The same for all edges, in parallel, in their order.
std::vector<EdgeSmoothness> edge_smoothness(const FaceAdjacency& adjacency, const Progress& progress = {});

/// Smoothness across the knot lines of a face's surface, inside its loops, at which the surface is less than twice
/// continuously differentiable in its parameters; without samples if there are none. It may well be smoother as a
/// shape: circles as rational curves have such knots.
EdgeSmoothness knot_smoothness(const Face& face);

}  // namespace umbilic
