// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/model/model.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// One sentence for each line and region of umbilics, by faces; empty if there are none.
std::string lines_and_regions_text(const Model& model, const std::vector<FaceUmbilics>& all);

}  // namespace umbilic
