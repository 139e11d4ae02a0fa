// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/core/progress.h>
#include <umbilic/matching/choices.h>
#include <umbilic/matching/pose_hypothesis.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

/// Poses that lay planes, cylinders, cones, spheres, tori, axes of revolution and directions of extrusion of the
/// suspect onto those of the original: all ways to assign a few features that fix a similarity (a basis), pruned by
/// angles, ratios of radii and the residual of the linear equations in scale and translation. Each pose is judged by
/// how much of the suspect's analytic area finds its feature on the original, and the same from the original's side
/// where the suspect is not explained. Both hands are tried to the end unless mirror images are not allowed. Where no
/// basis fixes the pose (one hole, one plane, coaxial cylinders), what is left open is filled in: some poses of many.
/// Best first. Conclusive if both models consist of elementary faces, or the suspect does and all of it is explained.
/// Throws Cancelled.
Proposals poses_by_analytic_faces(const PreparedModel& original, const PreparedModel& suspect, const ScaleChoice& scale,
                                  MirrorChoice mirror, const Progress& progress = {});

}  // namespace umbilic
