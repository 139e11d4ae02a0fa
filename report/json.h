// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <umbilic/differential/recognise.h>
#include <umbilic/similarity/compare.h>
#include <umbilic/umbilics/shell_certificate.h>

namespace umbilic {

/// JSON value whose keys keep the order they were written in.
using Json = nlohmann::ordered_json;

/// Seconds spent in each stage, in the order they ran.
using Timing = std::vector<std::pair<std::string, double>>;

/// The number, or null if it is not finite: no result ever holds NaN.
Json number_json(double value);

/// The text of a JSON result, indented by two spaces. Bytes that are not UTF-8 (in names that come from a file) become
/// U+FFFD.
std::string text(const Json& json);

/// The model as an exhibit: file, checksum, unit, counts, mass properties, what was skipped or repaired.
Json input_json(const Model& model);

/// The same of measured points, with their number and layout; format "points". `noise` and the area are known of
/// prepared points only.
Json input_json(const PointCloud& cloud);
Json input_json(const PreparedShape& shape);

/// Schema "umbilic.info/1". `recognised` as recognise() gives it for this model.
Json info_json(const Model& model, const std::vector<std::optional<RecognisedSurface>>& recognised);

/// Schema "umbilic.umbilics/1". `umbilics` as find_umbilics() gives them for this model, or for some of its faces;
/// `shells` as shell_certificates() gives them, none where not all faces were searched. The parameters u and v are
/// those of the file's own surfaces.
Json umbilics_json(const Model& model, const std::vector<FaceUmbilics>& umbilics,
                   const std::vector<ShellCertificate>& shells = {});

/// The pose alone, part of both results below. What was not found is null.
Json alignment_json(const Alignment& alignment);

/// Schema "umbilic.match/1". Of the options those of features, points and match. `timing` in seconds, by stage.
Json match_json(const PreparedShape& original, const PreparedShape& suspect, const CompareOptions& options,
                const Alignment& alignment, const Timing& timing);

/// Schema "umbilic.compare/1". `timing` holds the stages before the comparison (reading, features); the comparison's
/// own follow.
Json compare_json(const PreparedShape& original, const PreparedShape& suspect, const CompareOptions& options,
                  const Comparison& comparison, const Timing& timing);

}  // namespace umbilic
