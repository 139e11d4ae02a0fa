// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include <umbilic/core/progress.h>

#include <report/json.h>

namespace umbilic {

/// What every subcommand shares: common options, progress, and the ways out.
struct Session {
    std::string json;  ///< file for the JSON result, "-" for standard output, empty for none
    int threads = 0;   ///< 0: as many as there are processors
    std::uint64_t seed = 0;
    bool quiet = false;
    bool verbose = false;
    std::string command_line;  ///< that runs the same again
    Progress progress;

    bool json_on_output() const { return json == "-"; }
};

/// Adds --json, --threads, --seed, --quiet and --verbose to a subcommand.
void add_common_options(CLI::App& subcommand, Session& session);

/// Writes the JSON result where the user wants it, if anywhere.
void write_json(const Session& session, const Json& json);

/// Prints text for people on standard output, unless JSON goes there or the user wants quiet. Throws NumericFailure if
/// standard output does not take it.
void print(const Session& session, const std::string& text);

/// Writes to standard output and makes sure that it arrived.
void write_output(const std::string& text);

}  // namespace umbilic
