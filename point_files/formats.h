// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string_view>

#include <umbilic/core/progress.h>
#include <umbilic/model/point_cloud.h>

namespace umbilic {

// Each fills points, normals, triangles and layout of a cloud, whose source names the file, from the file's bytes.
// Throws InvalidInput, naming file and line or byte; Cancelled.
void read_table(std::string_view bytes, PointCloud& cloud, const Progress& progress);
void read_ply(std::string_view bytes, PointCloud& cloud, const Progress& progress);
void read_stl_text(std::string_view bytes, PointCloud& cloud, const Progress& progress);
void read_stl_binary(std::string_view bytes, PointCloud& cloud, const Progress& progress);
void read_obj(std::string_view bytes, PointCloud& cloud, const Progress& progress);

/// Lines or entries between two looks at Progress.
inline constexpr std::size_t progress_interval = 65536;

/// Throws InvalidInput, naming file and byte, if the file ends before `wanted` bytes from `at` on.
void need_bytes(const PointCloud& cloud, std::string_view bytes, std::size_t at, std::size_t wanted);

}  // namespace umbilic
