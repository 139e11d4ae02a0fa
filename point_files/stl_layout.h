// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

namespace umbilic {

// Binary STL: 80 bytes of text, the number of triangles, then for each its normal and corners (12 floats) and 2 bytes.
inline constexpr std::uint64_t stl_count_at = 80, stl_header_bytes = 84, stl_triangle_bytes = 50;

}  // namespace umbilic
