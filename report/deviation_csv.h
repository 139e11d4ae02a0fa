// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <umbilic/similarity/compare.h>

namespace umbilic {

/// Every node of both models with its foot point and differences, as comma-separated values (RFC 4180, one header line
/// that names units). Points are in the frame of the original; u and v are those of the files' own surfaces; what is
/// not defined at a node is left empty, as are face, u and v on measured points.
std::string deviation_csv(const PreparedShape& original, const PreparedShape& suspect, const Assessment& assessment);

}  // namespace umbilic
