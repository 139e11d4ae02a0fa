// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/matching/alignment.h>
#include <umbilic/matching/choices.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

struct MatchOptions {
    MethodChoice method = MethodChoice::automatic;
    ScaleChoice scale;
    /// Of the method kh, where the scale is not fixed.
    ScaleSearch scale_search = ScaleSearch::golden_section;
    /// Of the methods kh and umbilic_kh.
    CurvatureSolver curvature_solver = CurvatureSolver::direct;
    MirrorChoice mirror = MirrorChoice::automatic;
    ScopeChoice scope = ScopeChoice::automatic;
    /// Pose to start from (--initial): it is refined and takes part as a hypothesis.
    std::optional<SimilarityTransform> initial;
    /// Known corresponding points (--pairs): first on the original, second on the suspect, mm.
    std::vector<std::pair<Vector3, Vector3>> pairs;
    /// mm of the original within which a sample counts as lying on the other model; none: derived (see tolerances).
    std::optional<double> tolerance;
    /// Greatest difference of the scale-free invariants (delta, zeta) of two umbilics that may correspond, delta_omega
    /// of the thesis.
    double umbilic_invariant_tolerance = 0.15;
    /// Time after which no further pose is tried and the best one so far is judged; none: until a pose convinces. With
    /// a time limit results depend on the machine.
    std::optional<double> seconds;
};

/// Throws InvalidInput if a number is out of its range.
void check_options(const MatchOptions& options);

/// Finds how the suspect lies on the original when nothing is known of pose, scale or handedness: every method the
/// models allow proposes poses, all are scored by the same rule (share of area within tolerance, both ways), the best
/// are refined by point-to-surface least squares (thesis chapter 4). If no method applies, status is not_found and
/// `why` says so. Deterministic. Throws Cancelled.
Alignment match(const PreparedModel& original, const PreparedModel& suspect, const MatchOptions& options = {},
                const Progress& progress = {});

}  // namespace umbilic
