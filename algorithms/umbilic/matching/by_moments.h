// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/choices.h>
#include <umbilic/matching/pose_hypothesis.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

/// Moments of a model as a whole, of its volume or of its area.
struct ShapeMoments {
    int dimension = 3;                     ///< 3: volume of all solids together; 2: area of the samples
    double measure = 0.0;                  ///< mm^dimension
    Vector3 centroid = Vector3::Zero();    ///< mm
    Matrix3 covariance = Matrix3::Zero();  ///< mean of (x - centroid)(x - centroid)^T, mm^2
};

/// Moments of all solids of a model together, from volumes, centroids and inertia tensors (parallel axes).
ShapeMoments volume_moments(const Model& model);
/// Moments of the surface, from its area samples.
ShapeMoments area_moments(const Features& features);

/// Which principal moments are equal within their accuracy, so that principal axes are not defined.
enum class MomentSymmetry { none, two_smaller_equal, two_greater_equal, all_equal };

/// Two principal moments (eigenvalues of the covariance) are equal if they differ by less than this part of the
/// greatest one. Volume integrals of a kernel are good to about 1e-6 and near-equal moments turn the axes by the error
/// over the gap; moments of area come from a few thousand samples.
inline constexpr double equal_volume_moments = 1e-3;
inline constexpr double equal_area_moments = 2e-2;

/// Moments of two shapes that differ turn the axes apart by up to the difference over the gap between two of them: axes
/// within 15 degrees, from where refinement converges, need a gap of this many times the difference.
inline constexpr double gap_of_difference = 4.0;

/// `difference`: how far the moments are from those of the shape to compare with, as a part of the greatest one; gaps
/// below gap_of_difference times it count as none.
MomentSymmetry moment_symmetry(const ShapeMoments& moments, double difference = 0.0);

/// Poses that lay the principal axes of the two wholes onto each other (thesis 4.5): scale = cube root of the ratio of
/// the volumes (square root of that of the areas), centroid on centroid, four proper orientations and, if mirror images
/// are allowed, four more. Volumes are compared if both models have solids, areas otherwise. Where principal axes are
/// not defined (two or three moments equal within their accuracy, or nearer to each other than the two models' moments
/// are: cubes, bodies of revolution, n-fold prisms) the free angle or the whole rotation group is sampled, and `why`
/// says so; which of the poses is right is never guessed from the axes that rounding happens to give. Nothing is
/// proposed if the normalised moments differ: then the wholes are not copies of each other.
Proposals poses_by_moments(const PreparedModel& original, const PreparedModel& suspect, const ScaleChoice& scale,
                           MirrorChoice mirror);

}  // namespace umbilic
