// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/core/similarity_transform.h>

namespace umbilic {

/// Corresponding points of both models, mm.
struct PointPair {
    Vector3 original = Vector3::Zero();
    Vector3 suspect = Vector3::Zero();
    double weight = 1.0;  ///< > 0
};

struct PointFitOptions {
    bool free_scale = true;  ///< false: the scale is 1
    bool mirrored = false;   ///< fit the mirrored hypothesis: the suspect is reflected first
};

struct PointFit {
    SimilarityTransform original_suspect;
    std::vector<double> residuals;  ///< distance of each pair after the move, mm of the original
    double rms = 0.0;               ///< weighted root mean square of the residuals
    double max = 0.0;
};

/// Two point sets count as collinear if the second principal extent is smaller than this part of the first: below, the
/// turn about the line is decided by rounding (square root of the unit roundoff, as extents are square roots of
/// eigenvalues).
inline constexpr double collinear_extent = 1e-7;

/// Throws InvalidInput if there are fewer than three pairs, a number is not finite, a weight is not positive, or either
/// set is collinear.
void check_pairs(std::span<const PointPair> pairs);

/// Similarity that carries the suspect's points onto the original's with the least weighted squares (thesis 3.2,
/// (3.1)-(3.5)): centroids, the rotation about them as the unit quaternion that belongs to the greatest eigenvalue of
/// Horn's symmetric 4 x 4 matrix (Horn 1987, "Closed-form solution of absolute orientation using unit quaternions"),
/// translation c_o - s R c_s. The printed (3.3) with M = sum n m^T gives the inverse rotation; here M = sum m n^T, m of
/// the suspect. The rotation is proper for every input. The scale minimises the residuals in the suspect's unit,
/// sum |n / s - R m|^2: measured in the original's unit they shrink with s, and noise would make the fit too small.
/// Throws InvalidInput as check_pairs() does.
PointFit fit_points(std::span<const PointPair> pairs, const PointFitOptions& options = {});

}  // namespace umbilic
