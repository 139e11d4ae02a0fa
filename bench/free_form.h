// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>

#include <umbilic/matching/prepared_model.h>
#include <umbilic/matching/score.h>

namespace umbilic::bench {

/// The surface of the largest face, of which pieces are cut.
inline const NurbsSurface& largest_surface(const Model& model) {
    return std::max_element(model.faces.begin(), model.faces.end(),
                            [](const Face& a, const Face& b) { return a.area < b.area; })
        ->surface;
}

/// Largest distance of the moved suspect's samples from the original / sqrt(area of the original), the thesis's
/// relative maximum error. Symmetric designs have several right poses, so that distances from the original say more
/// than displacements from the planted pose.
inline double relative_maximum_error(const PreparedModel& original, const PreparedModel& suspect,
                                     const SimilarityTransform& pose) {
    const double size = original.model.size();
    const std::vector<double> distances = sample_distances(Ground(original), suspect, pose, size);
    return *std::max_element(distances.begin(), distances.end()) / size;
}

}  // namespace umbilic::bench
