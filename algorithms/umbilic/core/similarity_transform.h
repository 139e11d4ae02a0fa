// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/core/types.h>

namespace umbilic {

/// Similarity p' = scale * rotation * M * p + translation, with M = diag(-1, 1, 1) if mirrored and the identity
/// otherwise. rotation is proper (det = +1), scale > 0. A value named `original_suspect` maps the suspect onto the
/// original.
struct SimilarityTransform {
    double scale = 1.0;
    Matrix3 rotation = Matrix3::Identity();
    Vector3 translation = Vector3::Zero();
    bool mirrored = false;

    /// Linear part divided by scale: orthogonal, det = -1 if mirrored.
    Matrix3 orthogonal() const;
    Vector3 apply(const Vector3& point) const;
    /// Maps a unit tangent or a direction, without scale or translation.
    Vector3 apply_direction(const Vector3& direction) const;
    SimilarityTransform inverse() const;
};

/// Transform that first applies `inner`, then `outer`.
SimilarityTransform compose(const SimilarityTransform& outer, const SimilarityTransform& inner);

/// Transform p' = scale * orthogonal * p + translation from any orthogonal matrix (det = +1 or -1).
SimilarityTransform similarity_from_orthogonal(double scale, const Matrix3& orthogonal, const Vector3& translation);

/// Angle in radians, in [0, pi], of the rotation that takes one proper rotation to the other.
double rotation_angle_between(const Matrix3& a, const Matrix3& b);

}  // namespace umbilic
