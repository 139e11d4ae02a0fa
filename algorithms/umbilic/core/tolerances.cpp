// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/core/tolerances.h>

namespace umbilic {

const char* name(ToleranceOrigin origin) {
    switch (origin) {
        case ToleranceOrigin::fixed_default:
            return "default";
        case ToleranceOrigin::derived:
            return "derived";
        case ToleranceOrigin::user:
            return "user";
    }
    return "default";
}

}  // namespace umbilic
