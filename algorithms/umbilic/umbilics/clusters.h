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

/// Tells what the open boxes are: patches that are umbilic everywhere are regions, with the boxes beside them as their
/// border; of the others, those that touch are joined. Heaps that are long beside `options.resolution` are lines if
/// they can be traced as such; the rest are undecided clusters, whose index is told by the winding around them where
/// that can be evaluated. Appends to `result`, whose umbilics are complete.
void sort_open_parts(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                     const std::vector<OpenPart>& parts, const UmbilicOptions& options, FaceUmbilics& result);

}  // namespace umbilic
