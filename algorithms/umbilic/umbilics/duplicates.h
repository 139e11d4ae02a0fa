// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <umbilic/umbilics/clusters.h>
#include <umbilic/umbilics/common_zeros.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// An umbilic as one patch sees it.
struct Candidate {
    Umbilic umbilic;
    IsolatedZero zero;      ///< in the patch's own parameters
    std::size_t patch = 0;  ///< index into BezierPatches::patches
};

/// Where a patch sees an umbilic.
struct Sighting {
    std::size_t patch = 0;         ///< index into BezierPatches::patches
    Vector2 at = Vector2::Zero();  ///< in the surface's parameters, not moved onto the patch
};

/// An umbilic and everywhere it was seen: more than once on an edge of patches and on a seam.
struct SightedUmbilic {
    Umbilic umbilic;
    std::vector<Sighting> sightings;
};

/// Umbilics on edges of patches are found by every patch that meets there, and on a seam by both of its sides: keeps
/// one of each. Where two patches disagree about the index (the third derivatives jump), neither side's proof holds for
/// the surface; the place goes to `open`.
std::vector<SightedUmbilic> merge_duplicates(const NurbsSurface& surface, const BezierPatches& patches,
                                             const InputRounding& input, std::vector<Candidate> candidates,
                                             std::vector<OpenPart>& open);

}  // namespace umbilic
