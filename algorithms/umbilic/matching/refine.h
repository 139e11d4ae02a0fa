// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include <Eigen/Core>

#include <umbilic/core/progress.h>
#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/choices.h>
#include <umbilic/matching/ground_surface.h>

namespace umbilic {

using Matrix7 = Eigen::Matrix<double, 7, 7>;

/// A point of the suspect that shall come to lie on the original, mm.
struct WeightedPoint {
    Vector3 point = Vector3::Zero();
    double weight = 1.0;
};

struct RefineOptions {
    ScaleChoice scale;
    /// Points farther from the original than this part of the moved suspect's length are left out at the start;
    /// default: the basin from which refinement converges.
    double start_cutoff = 0.08;
    int maximum_steps = 60;
    /// A step below this part of the radius (see Refinement) ends the refinement; 0: one of the order of rounding.
    double sufficient_step = 0.0;
    /// So does one that moves the points by less than this part of the root mean square of their distances.
    double sufficient_part_of_rms = 0.0;
    /// Points that hang over a border are drawn back to it instead of being left out: for a suspect of which nothing
    /// is foreign, and that could otherwise slide off a border without resistance.
    bool hold_borders = false;
    /// The cut-off does not fall at once so far that motions are left undetermined by the points within it: for starts
    /// that are known to be off although much may fit already, such as the bases of a prism that is turned about its
    /// axis.
    bool hold_determined = false;
};

struct Refinement {
    SimilarityTransform original_suspect;
    double share = 0.0;      ///< weight of the points that took part in the last step, of all
    double rms = 0.0;        ///< of those, mm of the original
    double cutoff = 0.0;     ///< distance (mm of the original) beyond which points took no part in the last step
    bool converged = false;  ///< the last step was of the order of rounding
    int steps = 0;
    /// Mean of row^T row over the points that took part; rows are dr for unit motions in mm: rotation times radius,
    /// translation, log(scale) times radius, with radius = half the moved suspect's length, about the centroid of those
    /// points.
    Matrix7 normal_matrix = Matrix7::Zero();
    Vector3 centre = Vector3::Zero();  ///< that centroid, mm of the original
    double radius = 0.0;               ///< mm of the original
    double scale_deviation = 0.0;      ///< standard deviation of log(scale) from residuals and normal matrix; infinity
                                       ///< where the scale is not determined
};

/// Motions whose eigenvalue of the normal matrix is below this part of the greatest are not determined (sliding of a
/// plane, turning of a surface of revolution): the refinement leaves them alone. Square of the least relative
/// sensitivity, 1e-5.
inline constexpr double undetermined_motion = 1e-10;

/// Least squares of the distances of the suspect's points from the original's surface, all of a similarity free unless
/// the scale is known (thesis 4.2.4, (4.4), with the distance in the suspect's unit: sum (r / s)^2, row
/// [(x - o) x n, n, n . (x - o) - r]; minimised in the original's unit, noise makes every scale too small).
/// Gauss-Newton, damped where a step would raise the loss (Levenberg), with Tukey weights whose cut-off shrinks with
/// the lower quartile of the residuals, so that material foreign to the original loses its pull; points whose foot lies
/// on a border and that hang over it are left out. Exact copies end within rounding.
Refinement refine(const GroundSurface& original, std::span<const WeightedPoint> points,
                  const SimilarityTransform& start, const RefineOptions& options = {}, const Progress& progress = {});

}  // namespace umbilic
