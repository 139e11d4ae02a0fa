// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>

#include <occ_adapter/read_file.h>
#include <umbilic/matching/prepared_shape.h>

#include <cli/match_options.h>
#include <cli/session.h>
#include <report/json.h>

namespace umbilic {

/// Reads one file and tells of what was skipped on standard error.
ReadResult load(const Session& session, const std::string& path, const ReadOptions& options, const Progress& progress);

/// Reads a file of points, thins it out to `most_points`, and tells of its warnings on standard error.
PointCloud load_points(const Session& session, const std::string& path, std::size_t most_points,
                       const Progress& progress);

/// A file that holds a model or points, told by content, read and prepared.
struct LoadedShape {
    ReadResult file;   ///< of a model; the prepared one refers to it
    PointCloud cloud;  ///< of points; the prepared ones refer to it
    std::unique_ptr<PreparedModel> model;
    std::unique_ptr<PreparedPoints> points;

    PreparedShape prepared() const { return model ? PreparedShape(*model) : PreparedShape(*points); }
};

/// Two files, read and prepared side by side, with the seconds that took.
struct LoadedPair {
    LoadedShape original, suspect;
    Timing timing;
};

/// Errors name the file; if both fail, the original's is thrown. Throws WrongUse, before anything is computed, for a
/// --method that says nothing of the suspect.
std::unique_ptr<LoadedPair> load_pair(const Session& session, const MatchWords& words, const ReadOptions& read,
                                      const Progress& progress);

/// Prints stages and seconds on standard error if the user wants to know.
void print_timing(const Session& session, const Timing& timing);

}  // namespace umbilic
