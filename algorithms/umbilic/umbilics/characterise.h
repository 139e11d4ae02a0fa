// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include <umbilic/umbilics/common_zeros.h>
#include <umbilic/umbilics/equations.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// Everything about the umbilic that belongs to a proved zero of a patch: place, curvature, cubic form, type, radius.
/// None if the surface is singular there (a pole).
std::optional<Umbilic> characterise(const NurbsSurface& surface, const BezierPatch& patch, const IsolatedZero& zero,
                                    const InputRounding& input, double generic_margin);

}  // namespace umbilic
