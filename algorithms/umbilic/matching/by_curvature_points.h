// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/matching/choices.h>
#include <umbilic/matching/curvature_seeds.h>
#include <umbilic/matching/pose_hypothesis.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

struct CurvaturePointMatching {
    int seeds = 8;
    ScaleChoice scale;
    ScaleSearch scale_search = ScaleSearch::golden_section;
    MirrorChoice mirror = MirrorChoice::automatic;
    CurvatureSolver solver = CurvatureSolver::direct;
};

/// Poses from points with the same Gaussian and mean curvature, the KH method (thesis 4.6.2, 4.7.2). With the scale
/// known, one seed and one solution with their principal frames give a whole pose up to a half turn; the other seeds
/// vote: one of their solutions must be as far away as they are from the first seed ((4.8), with the absolute value
/// that its print lacks), and lie with its normal where the pose takes them. With the scale unknown, the same is done
/// at scales of a bracket (the user's, or all at which the suspect can be a part of the original): the objective, one
/// minus the soft share of the suspect that comes to lie on the original within a part of its own moved length, is
/// scanned and its lowest minima are searched by the golden section or Brent's method. Throws Cancelled.
Proposals poses_by_curvature_points(const PreparedModel& original, const PreparedModel& suspect,
                                    const CurvaturePointMatching& options, const Progress& progress = {});

/// The same at the given scales, each taken for known.
Proposals poses_by_curvature_points_at(const PreparedModel& original, const PreparedModel& suspect,
                                       std::span<const double> scales, const CurvaturePointMatching& options,
                                       const Progress& progress = {});

}  // namespace umbilic
