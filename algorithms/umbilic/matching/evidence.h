// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/matching/prepared_model.h>

namespace umbilic {

/// Equations that a covered surface which is free in form (no plane, cylinder or sphere, not merely developable)
/// contributes: more than any pose has unknowns, because the pieces agree in a whole function.
inline constexpr int free_form_equations = 12;

/// A face counts as a plane, cylinder or sphere if it departs from one by less than this many tolerances.
inline constexpr double elementary_departure = 3.0;

/// Number of independent conditions, beyond directions that design conventions make parallel or square, which the
/// covered part of a model satisfies by lying on the other one: 1 for each plane (its offset), 3 for a cylinder (axis
/// and radius), 4 for a sphere (centre and radius), 4 for another developable surface, free_form_equations for any
/// other. Coplanar planes and equal cylinders and spheres count once. Elementary surfaces are told from the curvatures
/// of the samples, whatever form their file gave them. A pose with free scale uses up four (translation and scale):
/// what exceeds that is evidence; a single plane, cylinder or sphere is none. `distances`: of the model's samples from
/// the other model; `tolerance`: in the same unit, mm of the other model, which is `scale` mm of the model itself.
int satisfied_equations(const PreparedModel& model, const std::vector<double>& distances, double tolerance,
                        double scale);

}  // namespace umbilic
