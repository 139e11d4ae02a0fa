// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <bit>
#include <cstring>
#include <string>

#include <report/base64.h>

namespace umbilic {

/// Entries of numbers as little-endian 32-bit numbers in base64, for the pages' viewers.
template <typename Number, typename Range>
std::string packed(const Range& values) {
    static_assert(sizeof(Number) == 4 && std::endian::native == std::endian::little);
    std::string bytes;
    for (const auto& entry : values) {
        for (const auto& value : entry) {
            const auto number = static_cast<Number>(value);
            char raw[4];
            std::memcpy(raw, &number, 4);
            bytes.append(raw, 4);
        }
    }
    return base64(bytes);
}

}  // namespace umbilic
