// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <umbilic/model/model.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// The parameter domain of a face as an SVG element (thesis Fig. 3-4, 3-5, 3-6): trimming loops, knot lines, boxes,
/// lines and regions of umbilics, undecided clusters, isolated umbilics with the directions of their lines of
/// curvature; those outside of the loops are pale. The sides stand to each other as the mean lengths of the parameter
/// lines, within limits. Umbilics are numbered from `first_label` on if `labelled`.
std::string parameter_picture_svg(const Face& face, const FaceUmbilics& found, int first_label, bool labelled);

}  // namespace umbilic
