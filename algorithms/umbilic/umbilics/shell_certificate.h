// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/model/model.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// Completeness of the umbilics of a whole shell. The principal directions of a closed smooth surface are a field of
/// lines that is continuous but for the umbilics, so their indices sum to Euler's characteristic 2 - 2 genus (Poincaré
/// and Hopf), whatever the shape.
struct ShellCertificate {
    std::vector<int> faces;  ///< numbers, increasing
    bool closed = false;
    /// V - E + F of a closed shell, 2 - 2 genus.
    std::optional<int> euler_characteristic;
    /// Sum of the indices of the umbilics inside the faces' loops and on them: one on an edge, a vertex or a seam
    /// counts once, inner poles count, undecided places with their index. Meaningful only where `complete` has a value.
    double index_sum = 0.0;
    std::optional<bool> complete;  ///< no value: could not be evaluated
    std::string why;               ///< on what the verdict rests, or why there is none

    std::optional<int> genus() const;
};

/// The certificate of every shell of a model, as face_adjacency() finds the shells. `found`: what find_umbilics() gives
/// for this model, all faces in its order. There is no verdict
/// - for open shells and those with umbilic lines or regions, or places of unknown index, inside the loops,
/// - where the surface is not smooth: sharp edges, tips, edges and knot lines across which the principal directions
///   jump (differential/edge_smoothness.h; this is seen at samples, while the umbilics are proved),
/// - where an umbilic lies nearer to an edge than the two faces agree.
/// Throws InvalidInput if `found` does not fit the model, and Cancelled.
std::vector<ShellCertificate> shell_certificates(const Model& model, const std::vector<FaceUmbilics>& found,
                                                 const Progress& progress = {});

}  // namespace umbilic
