// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/matching/alignment.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

/// Share of a model's area that counts as all of it: samples on borders and in notches of re-approximated copies.
inline constexpr double whole_share = 0.95;

/// One pose for each place at which the model that lies in the other one as a whole does so: copies of the original in
/// an assembly, or places of the original where the suspect repeats. The pose of the alignment comes first. Poses at
/// one place (the centroid of the contained model moves by less than DifferentPose::moved of its length) are its
/// symmetries and count once. Just the alignment's pose if neither model lies in the other as a whole; empty if nothing
/// was found.
std::vector<SimilarityTransform> copies(const Alignment& alignment, const PreparedModel& original,
                                        const PreparedModel& suspect);

}  // namespace umbilic
