// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/model/model.h>
#include <umbilic/similarity/assessment.h>

namespace umbilic {

/// How the suspect's free-form surfaces are written down, compared with those of the original they lie on.
enum class ControlNets { none, same, different };

/// same: every free-form face (bezier, bspline) of the suspect that lies wholly on one free-form face of the original
/// has its degrees and control points, moved, in whatever order, within `tolerance` (mm of the original); none: there
/// is no such face. The shape does not depend on it, but equal nets are evidence that a file, and not only a shape, was
/// copied.
ControlNets compare_control_nets(const Model& original, const Model& suspect,
                                 const SimilarityTransform& original_suspect, std::span<const FaceCoverage> faces,
                                 double tolerance);

}  // namespace umbilic
