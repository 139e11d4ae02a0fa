// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/alignment.h>

namespace umbilic {

/// A pose that one method proposes; nothing is said yet about how well it fits.
struct PoseHypothesis {
    SimilarityTransform original_suspect;
    MatchMethod method = MatchMethod::none;
};

/// What one method proposes.
struct Proposals {
    std::vector<PoseHypothesis> poses;  ///< most promising first
    bool open = false;  ///< some of many poses: the method leaves motions free
    /// Whatever poses there are, they are among these: no other method need be asked.
    bool conclusive = false;
    bool sampled = false;  ///< turns were sampled: poses are off by up to half a step, although much may fit
    std::string why;  ///< what was compared, or why nothing could be proposed; a clause without full stop
};

}  // namespace umbilic
