// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <umbilic/matching/alignment.h>
#include <umbilic/similarity/verdict.h>

namespace umbilic {

/// What a pose says was done to the original to get the suspect, told apart within a length (mm of the original).
struct PoseChanges {
    bool mirrored = false, scaled = false, moved = false;

    int count() const { return mirrored + scaled + moved; }
};

/// Told apart within `tolerance`. `suspect` is the box of the suspect in its own frame.
PoseChanges pose_changes(const SimilarityTransform& pose, const BoundingBox& suspect, double tolerance);

/// The pose that changes least among those that fit equally well: a symmetric shape that stands where it stood is not
/// called moved or mirrored.
SimilarityTransform plainest_pose(const Alignment& alignment, const BoundingBox& suspect, double tolerance);

/// "scaled by 2.54 (the suspect is 2.54 times as large)".
std::string scaled_in_words(double scale);

/// The answer where no pose was found.
Answer no_pose(const Alignment& alignment);

/// What an ambiguous or compatible pose adds to an answer; empty if the pose is found.
std::string caveat(const Alignment& alignment);

}  // namespace umbilic
