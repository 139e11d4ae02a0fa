// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/copies.h>

#include <algorithm>

#include <umbilic/matching/pose_distance.h>

namespace umbilic {

std::vector<SimilarityTransform> copies(const Alignment& alignment, const PreparedModel& original,
                                        const PreparedModel& suspect) {
    if (!alignment.found()) return {};
    std::vector<SimilarityTransform> result = {alignment.original_suspect};
    const bool original_inside = alignment.original_coverage >= whole_share;
    const bool suspect_inside = alignment.suspect_coverage >= whole_share;
    if (original_inside == suspect_inside) return result;

    const ShapeSize size = shape_size(original_inside ? original.features : suspect.features);
    // Where a pose puts the contained model, in the other one's space, and how long it is there.
    const auto place = [&](const SimilarityTransform& pose) {
        return (original_inside ? pose.inverse() : pose).apply(size.centroid);
    };
    const auto length = [&](const SimilarityTransform& pose) {
        return size.length * (original_inside ? 1.0 / pose.scale : pose.scale);
    };
    for (const SimilarityTransform& pose : alignment.symmetries) {
        const bool elsewhere = std::all_of(result.begin(), result.end(), [&](const SimilarityTransform& known) {
            return (place(pose) - place(known)).norm() > DifferentPose::moved * length(known);
        });
        if (elsewhere) result.push_back(pose);
    }
    return result;
}

}  // namespace umbilic
