// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/ground_surface.h>

namespace umbilic::bench {

struct ClosestPointsOptions {
    bool free_scale = false;
    int maximum_steps = 200;
    /// Ends when the mean square distance changes by less than this part of itself.
    double convergence = 1e-6;
};

/// The Iterative Closest Point algorithm of Besl and McKay (A method for registration of 3-D shapes, 1992), the
/// thesis's baseline (4.1.5): every point is paired with its closest one, however far, and all pairs are laid on each
/// other by Horn's quaternion, until nothing changes.
SimilarityTransform iterative_closest_points(const GroundSurface& original, std::span<const Vector3> suspect,
                                             const SimilarityTransform& start,
                                             const ClosestPointsOptions& options = {});

}  // namespace umbilic::bench
