// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/matching/choices.h>
#include <umbilic/matching/pose_hypothesis.h>
#include <umbilic/matching/prepared_model.h>
#include <umbilic/matching/umbilic_marks.h>

namespace umbilic {

/// True if two umbilics agree in the scale-free invariants delta, zeta and bend within `tolerance` and their own
/// errors.
bool may_correspond(const UmbilicMark& original, const UmbilicMark& suspect, double tolerance);

/// Similarities that carry one suspect umbilic onto one of the original's: point, normal and scale are unique
/// (scale = sqrt(|C_suspect| / |C_original|)), and so is the rotation unless beta is small; then up to three differ
/// little in how well the cubics agree. Only those whose cubics differ by less than `misfit` of their norm.
std::vector<SimilarityTransform> poses_from_pair(const UmbilicMark& original, const UmbilicMark& suspect,
                                                 double misfit);

/// Least squares over corresponding umbilics (original, suspect), each with its point and the tip of its normal half a
/// `length` (mm of the suspect) above it, so that two suffice. A displacement of the surfaces moves an umbilic in
/// inverse proportion to its steadiness(): its weight is the square of that. `near` tells hand and scale of the tips.
/// Nothing if points and tips lie on a line.
std::optional<SimilarityTransform> pose_from_pairs(std::span<const std::pair<UmbilicMark, UmbilicMark>> pairs,
                                                   const SimilarityTransform& near, double length, bool free_scale);

/// Poses from the umbilics of both models (thesis 4.6.1, 4.7.1, steps 100-110; NUMERICS in docs/numerics.md): pairs
/// that may correspond, under each hypothesis of hand and orientation that holds for the whole model; one pair gives a
/// whole similarity, and those that carry most umbilics onto partners come first, improved by least squares over them.
/// Throws Cancelled.
Proposals poses_by_umbilics(const PreparedModel& original, const PreparedModel& suspect, const ScaleChoice& scale,
                            MirrorChoice mirror, double invariant_tolerance, const Progress& progress = {});

}  // namespace umbilic
