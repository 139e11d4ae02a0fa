// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace umbilic::models {

/// Writes broken variants of the files in `models` into `models`/malformed and says what is wrong with each and
/// what a reader owes: an error, or at least a warning.
/// Throws std::runtime_error if a source file does not hold the text to be spoiled.
nlohmann::ordered_json write_malformed(const std::filesystem::path& models);

}  // namespace umbilic::models
