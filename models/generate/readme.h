// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace umbilic::models {

/// Renews the tables of the README from the ground truth. A table stands between the lines
/// `<!-- table NAME -->` and `<!-- end -->`, NAME one of models, umbilics, pairs, malformed; everything else is
/// kept. Does nothing where there is no README; throws std::runtime_error where a mark is missing.
void update_readme(const std::filesystem::path& readme, const nlohmann::ordered_json& truth);

}  // namespace umbilic::models
