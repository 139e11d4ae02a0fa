// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>

#include <occ_adapter/read_file.h>
#include <umbilic/matching/prepared_model.h>

#include <cli/session.h>
#include <report/json.h>

namespace umbilic {

/// Reads one file and tells of what was skipped on standard error.
ReadResult load(const Session& session, const std::string& path, const ReadOptions& options, const Progress& progress);

/// Two files, read and prepared side by side, with the seconds that took.
struct LoadedPair {
    ReadResult original_read, suspect_read;  ///< the prepared models refer to these
    std::unique_ptr<PreparedModel> original, suspect;
    Timing timing;
};

/// Errors name the file; if both fail, the original's is thrown.
std::unique_ptr<LoadedPair> load_pair(const Session& session, const std::string& original, const std::string& suspect,
                                      const ReadOptions& read, const FeatureOptions& features,
                                      const Progress& progress);

/// Prints stages and seconds on standard error if the user wants to know.
void print_timing(const Session& session, const Timing& timing);

}  // namespace umbilic
