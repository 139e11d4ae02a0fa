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

/// How far a moved suspect is from an original.
struct FitError {
    double mean = 0.0;  ///< of the samples' distances from the original, mm: the thesis's objective (4.4)
    /// Largest of them / sqrt(area of the original): the thesis's relative maximum error. Symmetric designs have
    /// several right poses, so that distances from the original say more than displacements from the planted pose.
    double relative_max = 0.0;
};

inline FitError fit_error(const PreparedModel& original, const PreparedModel& suspect,
                          const SimilarityTransform& pose) {
    const double size = original.model.size();
    FitError error;
    double weight = 0.0;
    const std::vector<double> distances = sample_distances(Ground(original), suspect, pose, size);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const double distance = std::min(distances[i], size);
        error.mean += suspect.features.samples[i].weight * distance;
        weight += suspect.features.samples[i].weight;
        error.relative_max = std::max(error.relative_max, distance / size);
    }
    error.mean /= weight;
    return error;
}

}  // namespace umbilic::bench
