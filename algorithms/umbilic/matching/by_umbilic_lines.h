// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/matching/by_curvature_points.h>
#include <umbilic/matching/choices.h>
#include <umbilic/matching/pose_hypothesis.h>
#include <umbilic/matching/prepared_model.h>
#include <umbilic/matching/umbilic_marks.h>

namespace umbilic {

/// Two umbilics that may correspond by the thesis's rules.
struct OmegaPair {
    int original = 0;  ///< index into the marks
    int suspect = 0;
    double distance = 0.0;  ///< of their omega
    double scale = 1.0;     ///< sigma = kappa_suspect / kappa_original
};

/// Pairs of generic umbilics of the same type whose omega differ by less than `tolerance`, nearest first (thesis 4.6.1,
/// (4.5); omega up to cube roots of unity, of which (2.30) has three), with the scale from their normal curvatures
/// (4.7.1, step 104). Umbilics without omega (alpha = 0, all those of quadrics), non-generic and flat ones, and pairs
/// whose curvatures differ in sign have no part in it.
std::vector<OmegaPair> pairs_by_omega(const std::vector<UmbilicMark>& original, const std::vector<UmbilicMark>& suspect,
                                      double tolerance);

/// Method 1 of the thesis (4.7.1, steps 100-112, figure 4-3), for comparison with poses_by_umbilics(): pairs by type
/// and omega; the scale from the normal curvatures at a pair; three pairs whose scales and distances agree give a pose
/// by Horn's method; if there are none, single pairs do: point on point, normal on normal, and one line of curvature of
/// the original's umbilic on each of the suspect's, in both senses. Of both hands and orientations, which the thesis
/// leaves out. Nothing is weighted or voted on, as there. Throws Cancelled.
Proposals poses_by_umbilic_lines(const PreparedModel& original, const PreparedModel& suspect, const ScaleChoice& scale,
                                 MirrorChoice mirror, double omega_tolerance, const Progress& progress = {});

/// Method 2 of the thesis (4.7.1): the same scales, and at each of the most promising ones the KH method. Throws
/// Cancelled.
Proposals poses_by_umbilic_scale(const PreparedModel& original, const PreparedModel& suspect,
                                 const CurvaturePointMatching& options, double omega_tolerance,
                                 const Progress& progress = {});

}  // namespace umbilic
