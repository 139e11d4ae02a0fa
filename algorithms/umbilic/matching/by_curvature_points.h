// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/matching/choices.h>
#include <umbilic/matching/pose_hypothesis.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

/// A point of the suspect whose Gaussian and mean curvature are looked for on the original.
struct CurvatureSeed {
    SurfacePoint at;
    Curvature curvature;  ///< outward side applied
    /// How far (mm) the point of the same curvatures moves at most if both curvatures change by one unit of their size,
    /// rho^2 and rho = sqrt(kappa_max^2 + kappa_min^2).
    double sensitivity = 0.0;
    /// Share of the model's samples that look like it: K and H alike within a tenth of their size.
    double commonness = 0.0;
};

/// Seeds of a model (thesis 4.6.2, "points with different curvatures", chosen by hand there): well-conditioned
/// (sensitivity small), rare, with a principal frame, and spread over it; best first. Faces on which K and H depend on
/// each other have none.
std::vector<CurvatureSeed> choose_curvature_seeds(const PreparedModel& model, int count);

struct CurvaturePointMatching {
    int seeds = 8;
    ScaleChoice scale;
    ScaleSearch scale_search = ScaleSearch::golden_section;
    MirrorChoice mirror = MirrorChoice::automatic;
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
