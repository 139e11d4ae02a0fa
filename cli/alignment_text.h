// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <umbilic/matching/alignment.h>

namespace umbilic {

/// The pose in lines for facts().
std::vector<std::pair<std::string, std::string>> alignment_facts(const Alignment& alignment);

}  // namespace umbilic
