// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <umbilic/core/progress.h>
#include <umbilic/model/point_cloud.h>

namespace umbilic {

/// True if the content of a file is one of the point formats that read_points() knows. Throws InvalidInput if it
/// cannot be opened.
bool holds_points(const std::string& path);

/// Reads a table of points (.xyz .asc .csv: x y z, also with normals), PLY (text and both binary orders), STL (text and
/// binary) or OBJ, told by content, and cleans it (see clean()). Numbers are taken for millimetres. Polygons become
/// triangles. Memory stays in proportion to the file's size, whatever its header says. Throws InvalidInput in one line
/// that names the file, the line or byte, and what to do: missing, of no known format, damaged, cut off, or without a
/// finite point.
PointCloud read_points(const std::string& path, const Progress& progress = {});

}  // namespace umbilic
