// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/bernstein/subdivision.h>
#include <umbilic/core/types.h>

namespace umbilic {

/// Bounds on the errors of single coefficients, in subdivision. Inside [0, 1] all steps of de Casteljau's algorithm are
/// convex combinations: bounds and magnitudes go the way of the coefficients, and what was bounded together stays as
/// local as they are.

/// Brings `errors`, one for each of `coefficients`, to the halves that halve_u (`along_u`) or halve_v makes of these:
/// `errors` becomes the upper half, `first` receives the lower one. To be called before the coefficients are halved.
void halve_errors(CoefficientShape shape, bool along_u, const double* coefficients, double* errors, double* first);

/// Brings `errors`, one for each of `whole`, to a part of [0, 1]^2. `part` are the coefficients on it, by restrict_u
/// and restrict_v of `whole`.
void restrict_errors(CoefficientShape shape, const double* whole, const double* part, const ParameterBox& box,
                     double* errors);

}  // namespace umbilic
