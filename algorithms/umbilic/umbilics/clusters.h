// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/umbilics/equations.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {

/// A box the search left open, in the surface's parameters.
struct OpenPart {
    ParameterBox box;
    bool zero = false;  ///< umbilic everywhere within the input's rounding
};

/// Joins open boxes that touch and tells what each heap is: a region (some box is umbilic everywhere), a line (long
/// beside `options.resolution`) or an undecided cluster, whose index is told by the winding around it where that can be
/// evaluated. Appends to `result`, whose umbilics are complete.
void sort_open_parts(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                     const std::vector<OpenPart>& parts, const UmbilicOptions& options, FaceUmbilics& result);

/// Region of the given boxes: its area on the untrimmed surface, and its kind from the curvatures in the boxes.
UmbilicRegion make_region(const NurbsSurface& surface, const std::vector<ParameterBox>& boxes);

}  // namespace umbilic
