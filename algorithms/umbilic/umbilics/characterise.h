// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include <umbilic/umbilics/common_zeros.h>
#include <umbilic/umbilics/equations.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// How well a surface is known, on top of the rounding of its numbers.
struct InputAccuracy {
    double displacement = 0.0;  ///< greatest distance (mm) of a control point from where it should be
    double cubic = 0.0;         ///< relative error of a cubic form
};

/// Everything about the umbilic that belongs to a proved zero of a patch: place, curvature, cubic form, type, radius,
/// with errors that follow from the radius, from rounding and from `accuracy`. Near a knot line across which third
/// derivatives jump the class covers all sides. None if the surface is singular there (a pole).
std::optional<Umbilic> characterise(const NurbsSurface& surface, const BezierPatch& patch, const IsolatedZero& zero,
                                    const InputRounding& input, const InputAccuracy& accuracy);

}  // namespace umbilic
