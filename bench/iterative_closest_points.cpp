// SPDX-License-Identifier: LGPL-2.1-or-later
#include "iterative_closest_points.h"

#include <cmath>
#include <limits>
#include <vector>

#include <umbilic/core/errors.h>
#include <umbilic/matching/horn.h>

namespace umbilic::bench {

SimilarityTransform iterative_closest_points(const GroundSurface& original, std::span<const Vector3> suspect,
                                             const SimilarityTransform& start, const ClosestPointsOptions& options) {
    SimilarityTransform pose = start;
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < options.maximum_steps; ++step) {
        std::vector<PointPair> pairs;
        double square = 0.0;
        for (const Vector3& p : suspect) {
            const auto foot = original.foot(pose.apply(p), std::numeric_limits<double>::infinity());
            if (!foot) continue;
            pairs.push_back({foot->point, p});
            square += foot->distance * foot->distance;
        }
        if (pairs.size() < 3 || !(std::abs(last - square) > options.convergence * square)) break;
        last = square;
        try {
            pose = fit_points(pairs, {.free_scale = options.free_scale}).original_suspect;
        } catch (const InvalidInput&) {
            break;  // from afar all points may be closest to one corner of the original
        }
    }
    return pose;
}

}  // namespace umbilic::bench
