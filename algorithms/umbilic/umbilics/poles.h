// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/umbilics/clusters.h>
#include <umbilic/umbilics/duplicates.h>
#include <umbilic/umbilics/patch_search.h>
#include <umbilic/umbilics/winding.h>

namespace umbilic {

/// A side of the searched part along which r_u or r_v vanishes: a single point in space, or an edge at which the
/// parametrisation stands still.
struct Pole {
    PatchEdge edge = PatchEdge::v_low;
    /// Parameter of the line around the pole, in the direction across the edge: no umbilic lies between it and the
    /// pole.
    double circle = 0.0;
    /// The surface closes around the pole, so that the pole is an inner point of it.
    bool full = false;
    /// Index of the pole if it can be told: of an inner point from the proved turning along `circle`; otherwise as if
    /// the sector were repeated around the pole.
    std::optional<double> index;
    /// The pole as an umbilic, if the surface has a tangent plane and equal curvatures there.
    std::optional<Umbilic> umbilic;
};

/// The poles of a surface (thesis 3.6 leaves them out; docs/numerics.md, "Poles"). `umbilics` and `open` are what the
/// search found; open boxes at a pole that turns out to be an umbilic are taken out of `open`, and the pole is then not
/// certified.
std::vector<Pole> find_poles(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                             const PatchRange& range, const std::vector<PatchUmbilics>& found,
                             const std::vector<SightedUmbilic>& umbilics, double generic_margin,
                             std::vector<OpenPart>& open);

}  // namespace umbilic
