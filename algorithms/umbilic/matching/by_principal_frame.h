// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/matching/alignment.h>
#include <umbilic/matching/match.h>
#include <umbilic/matching/principal_frame_table.h>

namespace umbilic {

struct PrincipalFrameOptions {
    int seeds = 16;              ///< points of the suspect that propose poses
    int first_seed = 0;          ///< seeds before this one, in the order of their choice, are left out
    int probes = 64;             ///< points of the suspect that test a proposed pose
    int stride = 1;              ///< only every so many samples of the original are compared with a seed
    double angle_window = 0.12;  ///< |difference of the signatures' angles|, radians
    /// Third-order filter: ||c_s - c_o|| <= factor (||c_s|| + offset) on the scale-free cubics. It cuts the hypotheses
    /// some hundredfold; without it a match survives jumps of third derivatives at knots and re-approximation.
    bool third_order = true;
    double third_order_factor = 0.35;
    double third_order_offset = 0.15;
    int keep = 24;             ///< poses returned at most
    bool flip_normals = true;  ///< also try the suspect seen from behind; false where both models are oriented solids
    ScaleChoice scale;
    MirrorChoice mirror = MirrorChoice::automatic;
};

/// Poses proposed by single corresponding points: a point with its principal frame and curvatures fixes the whole
/// similarity, the ratio of curvatures its scale. Seeds of the suspect are looked up by their signature among the
/// original's samples; each pose is tested on probes with early rejection. Best first, near duplicates dropped, `score`
/// in [0, 1] the mean over the probes of 1 - (distance / tolerance)^2. Deterministic. Throws Cancelled.
///
/// Points with kappa_max = kappa_min (umbilics, spheres, planes) propose nothing; on surfaces of revolution and
/// extrusions the lookup has one-parameter families of answers, of which only some are near the truth.
std::vector<PoseCandidate> propose_by_principal_frame(const PrincipalFrameTable& original,
                                                      const PrincipalFrameTable& suspect,
                                                      const PrincipalFrameOptions& options = {},
                                                      const Progress& progress = {});

}  // namespace umbilic
