// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/core/types.h>
#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

struct QuadtreeOptions {
    /// delta_umb: boxes are quartered until both sides, relative to the surface's domain, are below this.
    double tolerance = 0.005;
    /// Boxes a Bezier patch may use before what is left of it is returned as it is.
    long boxes_per_patch = 100000;
};

/// A box that may hold umbilics.
struct QuadtreeLeaf {
    ParameterBox box;
    int cluster = 0;    ///< boxes that touch bear the same number, from 0; seams are not joined
    bool zero = false;  ///< umbilic everywhere within the input's rounding; not quartered further
};

struct QuadtreeUmbilics {
    std::vector<QuadtreeLeaf> leaves;  ///< patch by patch, in the order of the surface's patches
    int clusters = 0;
    int patches = 0;
    long boxes = 0;          ///< boxes looked at
    bool exhausted = false;  ///< a patch spent its budget
};

/// Boxes that hold every umbilic of a surface by the thesis's own method (3.6): the discriminant P_N of the equation of
/// principal directions of each Bezier patch in Bernstein form, quartered at mid-parameters; a box whose coefficients
/// are all positive, by more than the bound on their error, is dropped. Second and independent method beside
/// find_umbilics: it proves absence only, and cannot tell how many umbilics a box holds, but leaves lines and regions
/// visible as they are. Along a collapsed edge P_N vanishes whatever the surface; boxes remain there. Throws
/// InvalidInput if an option is out of range, Unsupported if P_N has too high a degree (polynomial surfaces above
/// degree 21, rational ones above 13); Cancelled.
QuadtreeUmbilics find_umbilics_by_quadtree(const NurbsSurface& surface, const QuadtreeOptions& options = {},
                                           const Progress& progress = {});

}  // namespace umbilic
