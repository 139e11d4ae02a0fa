// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <report/fit_html.h>
#include <report/html.h>
#include <report/umbilics_html.h>

namespace umbilic {

/// Writes a file that appears whole or not at all: beside it first, then renamed. What is not a regular file (a pipe, a
/// terminal) is written to directly. Throws NumericFailure, naming the file, if it cannot be written.
void write_file(const std::string& path, const std::string& contents);

/// Throws NumericFailure, naming it, if something that is not a folder stands where a report shall go: told before
/// hours of work, not after.
void check_report_folder(const std::string& folder);

/// Makes the folder and writes report.html, result.json, deviation.csv and, if a pose was found, aligned.step (the
/// suspect in that pose; aligned.ply if it is measured points). They are assembled beside the folder and moved there at
/// the end: an error or a cancel leaves nothing. Other files in the folder are left alone. `result` is the JSON of
/// compare_json(). Throws NumericFailure, naming the file, if something cannot be written; Cancelled.
void write_report(const std::string& folder, const ReportInput& input, const Json& result,
                  const Progress& progress = {});

/// The same for the report on the umbilics of one model: report.html and umbilics.json. `result` is the JSON of
/// umbilics_json().
void write_umbilics_report(const std::string& folder, const UmbilicsReportInput& input, const Json& result,
                           const Progress& progress = {});

/// The same for the report on a fit: report.html and fit.json. `result` is the JSON of fit_json().
void write_fit_report(const std::string& folder, const FitReportInput& input, const Json& result,
                      const Progress& progress = {});

}  // namespace umbilic
