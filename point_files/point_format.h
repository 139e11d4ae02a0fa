// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace umbilic {

enum class PointFormat { table, ply, stl_text, stl_binary, obj };

/// The format that the beginning of a file and its size in bytes tell; none if it holds no points. A text that is a CAD
/// file (STEP, IGES, BREP) is none.
std::optional<PointFormat> point_format(std::string_view beginning, std::uint64_t bytes);

/// Bytes of a file's beginning that point_format() wants to see.
inline constexpr std::size_t format_beginning = 65536;

}  // namespace umbilic
