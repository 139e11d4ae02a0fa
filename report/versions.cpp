// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/versions.h>

#include <occ_adapter/read_file.h>

namespace umbilic {

Versions versions() {
    return {UMBILIC_VERSION, UMBILIC_COMMIT, opencascade_version()};
}

}  // namespace umbilic
