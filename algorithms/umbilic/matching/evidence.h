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

/// Number of independent conditions, beyond those that design conventions set (directions parallel or square, axes in
/// line, equal radii, usual angles of cones), which the covered part of a model satisfies by lying on the other one: 1
/// for each plane (its offset), 2 for each axis, 3 for each sphere (centre), 1 for the place of a cone or torus on its
/// axis, 1 for each different radius, 4 for other developable surfaces together (pieces of one sweep are not told
/// apart), free_form_equations for any other. Coplanar planes and equal surfaces count once. Elementary surfaces are
/// told from the samples, planes by their places and others by their curvatures, whatever form their file gave them,
/// cones and tori from the model's analytic features. Samples count where the surfaces lie on each other over an area,
/// not along a line of crossing. Taken off are the turns that directions do not fix: 1 where all are parallel, 3 where
/// there are none. A pose with free scale uses up four more (translation and scale): what exceeds that is evidence; a
/// single plane, cylinder, cone, sphere or torus is none. `distances`: of the model's samples from the other model;
/// `tolerance`: in the same unit, mm of the other model, which is `scale` mm of the model itself.
int satisfied_equations(const PreparedModel& model, const std::vector<double>& distances, double tolerance,
                        double scale);

}  // namespace umbilic
