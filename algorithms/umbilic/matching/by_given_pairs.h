// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include <umbilic/matching/alignment.h>
#include <umbilic/matching/consistent_pairs.h>
#include <umbilic/matching/match.h>

namespace umbilic {

/// Similarities of the corresponding points of MatchOptions::pairs (thesis 3.2; CGWOS, CGWS, CPWOS, CPWS of its Table
/// 4.1), wrong pairs left out: the proper one and, if mirror images are tried, that of the other hand. Empty without
/// pairs. Throws InvalidInput as fit_points does.
std::vector<ConsistentPointFit> fit_given_pairs(const MatchOptions& options);

/// How many pairs were given and which are wrong by the fit that leaves out fewest; a clause without full stop.
std::string described(std::span<const ConsistentPointFit> fits);

/// How the pairs lie under the fit that has the hand of the alignment.
std::vector<GivenPair> judged_pairs(std::span<const ConsistentPointFit> fits, bool mirrored);

}  // namespace umbilic
