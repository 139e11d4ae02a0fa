// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <support/invariance.h>

namespace umbilic::support {

/// Written as B-spline faces to a STEP (AP214) and to an IGES file, and read back. Faces keep their order but not
/// always their parameters (IGES knows no reversed faces), so `parameters` is empty and `normal_sign` holds for outward
/// normals only; faces leave their solids. `deviation` is what the writers' digits cost.
std::vector<Invariance> exchanges();

}  // namespace umbilic::support
