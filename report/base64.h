// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>

namespace umbilic {

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace umbilic
