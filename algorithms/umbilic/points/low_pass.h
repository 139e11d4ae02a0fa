// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/model/point_cloud.h>

namespace umbilic {

/// The points after a low-pass filter, and what it changed.
struct LowPass {
    std::vector<Vector3> points;
    double width = 0.0;       ///< mm, as given
    double rms_change = 0.0;  ///< root mean square displacement, mm
    double max_change = 0.0;  ///< greatest displacement, mm
};

/// Gaussian low-pass filter (thesis 4.3 and 7.1): every point moves along the local normal to the Gaussian-weighted
/// mean height of its neighbours over their regression plane; `width` is the standard deviation of the weight, mm.
/// Points keep their place in the tangent plane, so that borders do not shrink. Structures much smaller than the width
/// go, structures much larger stay: a surface of curvature kappa moves by about kappa width^2 / 2.
/// Throws InvalidInput if the width is not positive; Cancelled.
LowPass low_pass(const PointCloud& cloud, double width, const Progress& progress = {});

}  // namespace umbilic
