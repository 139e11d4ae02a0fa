// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/model/display_mesh.h>
#include <umbilic/similarity/compare.h>

#include <report/json.h>

namespace umbilic {

/// Everything a report tells of one comparison. References must outlive the call they are given to.
struct ReportInput {
    PreparedShape original;
    PreparedShape suspect;
    const std::vector<DisplayMesh>& original_meshes;  ///< of models; none of points
    const std::vector<DisplayMesh>& suspect_meshes;
    const CompareOptions& options;
    const Comparison& comparison;
    const Timing& timing;      ///< as for compare_json()
    std::string command_line;  ///< that computes the same again
    std::string suspect_file;  ///< where the suspect's bytes can be read; empty: at its source's path
};

/// The report as one HTML page that needs no other file and no network: answer, verdict with its evidence, exhibits,
/// pictures (in space and printed), tables, tolerances, limits. Strings that come from files are escaped. Throws
/// Cancelled.
std::string report_html(const ReportInput& input, const Progress& progress = {});

}  // namespace umbilic
