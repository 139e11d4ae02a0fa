// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace umbilic {

/// What a result was computed with.
struct Versions {
    std::string umbilic;      ///< release, e.g. "0.1.0"
    std::string commit;       ///< of the source tree when it was configured; "unknown" outside git
    std::string opencascade;  ///< e.g. "7.6.3"
};

Versions versions();

}  // namespace umbilic
