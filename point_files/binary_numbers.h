// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace umbilic {

/// The number whose bytes begin at `at`, in the given order.
template <class Number>
Number binary_number(const char* at, std::endian order) {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), at, sizeof(Number));
    if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
}

}  // namespace umbilic
