// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic::support {

/// What a search may answer, besides isolated umbilics.
enum class Expected {
    line,               ///< a line of umbilics, or the surface recognised
    region,             ///< a region
    resolved,           ///< isolated umbilics, each proved
    resolved_or_index,  ///< isolated umbilics or clusters, each with its index
    anything_bounded    ///< whatever is honest
};

struct WorstCase {
    std::string name;  ///< letters, digits and underscores
    NurbsSurface surface;
    Expected expected = Expected::anything_bounded;
    /// Boxes the search may visit.
    long boxes = 0;
    /// Relative to the domain: how well extended precision can tell the place of an umbilic.
    double place_accuracy = 1e-12;
};

/// Surfaces on which searches by subdivision explode or invent umbilics: planes, spheres, lines and regions of
/// umbilics, nearly umbilic and nearly double ones. Sizes are about 1.
std::vector<WorstCase> worst_cases();

}  // namespace umbilic::support
