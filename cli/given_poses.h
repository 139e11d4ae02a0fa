// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <umbilic/core/similarity_transform.h>

namespace umbilic {

/// Reads a transform of the suspect onto the original from a JSON file: an object with `scale`, `rotation` (rows),
/// `translation` and optionally `mirrored`, as in a result's `alignment`; a whole result will do, too. Throws
/// InvalidInput, naming the file, if it is none: the scale must be positive, the rotation orthogonal with det = +1.
SimilarityTransform read_transform(const std::string& path);

/// Reads corresponding points, mm: six numbers a line, three on the original, three on the suspect, parted by commas,
/// semicolons or blanks. Empty lines, lines that start with # and one heading, which holds no number, are passed over.
/// Throws InvalidInput, naming file and line, if a line holds anything else, if there are fewer than three pairs, or if
/// the points of either side lie on a line.
std::vector<std::pair<Vector3, Vector3>> read_point_pairs(const std::string& path);

}  // namespace umbilic
