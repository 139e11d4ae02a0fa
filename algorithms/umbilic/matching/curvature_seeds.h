// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

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

}  // namespace umbilic
