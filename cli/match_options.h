// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <umbilic/similarity/compare.h>

namespace umbilic {

/// Options of `match` and `compare` as the command line gives them.
struct MatchWords {
    std::string original, suspect;
    CompareOptions options;  ///< of which `match` uses features, points and match
    std::string initial_path, pairs_path;
};

/// Adds the two files and every option that concerns the pose.
void add_match_options(CLI::App& subcommand, MatchWords& words);

/// Throws WrongUse, naming the suspect's file, if --method says nothing of a suspect that is measured points, or of one
/// that is not.
void check_method_of(const MatchWords& words, bool measured_suspect);

/// Shifts every sampling.
void set_seed(MatchWords& words, std::uint64_t seed);

/// Reads the files named by --initial and --pairs into the options. Throws InvalidInput, naming the file.
void read_given_poses(MatchWords& words);

}  // namespace umbilic
