// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/matching/alignment.h>

namespace umbilic {

/// How many corresponding points were given, how well they agree, and which of them (numbered from 1) do not.
std::string given_pairs_text(const std::vector<GivenPair>& pairs);

}  // namespace umbilic
