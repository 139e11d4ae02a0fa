// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <umbilic/umbilics/duplicates.h>
#include <umbilic/umbilics/patch_search.h>
#include <umbilic/umbilics/poles.h>
#include <umbilic/umbilics/winding.h>

namespace umbilic {

/// Half the winding of (A, B) around what was searched: what the indices of its umbilics must sum to.
struct BorderWinding {
    std::optional<double> turns;
    std::string why;   ///< how it was evaluated, or why it could not be
    int left_out = 0;  ///< places on the border, without umbilics, at which it could not be and which it goes around
};

/// Parts of `range` on which the surface is twice continuously differentiable.
std::vector<PatchRange> smooth_blocks(const NurbsSurface& surface, const PatchRange& range);

/// Winding along the borders of all smooth blocks of `range`, by interval bounds (docs/numerics.md, "Certificate").
/// - An umbilic on a border counts as inside: the border makes a detour around it, where the polynomials continue. One
///   that is seen from several sides of a border (a seam, a knot of low continuity) counts once.
/// - A pole is a hole in the parameter plane: the border runs along its circle, and its own index is added if the
///   surface closes around it.
/// - `open`, the boxes on which the search proved nothing, are left out: the border runs around them too.
/// What is listed in the parts left out is added, so that the result is comparable with the sum of all indices.
BorderWinding border_winding(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                             const PatchRange& range, const std::vector<PatchUmbilics>& found,
                             const std::vector<SightedUmbilic>& umbilics, std::span<const Pole> poles,
                             std::span<const ParameterBox> open);

/// Compares the indices listed in `found` with the winding; undecided clusters are added to both with their index.
/// Without a verdict, and saying why, where no winding is at hand, the search was cut short, or a cluster has no index.
Certificate certify(const BorderWinding& winding, const FaceUmbilics& found);

}  // namespace umbilic
