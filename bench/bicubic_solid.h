// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/model/model.h>

namespace umbilic::bench {

/// Solids as in the thesis's example of moments (6.1.1): bounded by bicubic integral B-spline surfaces, of which two
/// have large nets.

/// A face of a solid: r_u x r_v points outwards unless reversed.
struct SolidFace {
    NurbsSurface surface;
    bool reversed = false;
};

/// The six faces of the body between a bicubic surface and one beside it, whose poles lie `thickness` (mm, positive)
/// against the normals; the four narrow faces are ruled, of degree 3 too.
std::vector<SolidFace> thickened(const NurbsSurface& outer, double thickness);

/// The model with its volume, centroid and inertia tensor by Gauss's theorem (thesis 4.5), the integrals over bicubic
/// integral pieces exact but for rounding.
Model solid_of(const std::vector<SolidFace>& faces);

/// The faces moved; a proper similarity.
std::vector<SolidFace> moved(std::vector<SolidFace> faces, const SimilarityTransform& move);

}  // namespace umbilic::bench
