// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/core/types.h>
#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

enum class UmbilicSystem {
    simple,  ///< A = B = 0: simple zeros at generic umbilics
    thesis,  ///< P_N = 0 and both derivatives of P_N = 0, three equations (thesis (2.25)): existence cannot be proved
};

struct ProjectedPolyhedronUmbilicOptions {
    UmbilicSystem system = UmbilicSystem::simple;
    /// Side of the smallest box, relative to a Bezier patch.
    double tolerance = 1e-8;
    long boxes_per_patch = 20000;
};

/// An isolated umbilic in the surface's parameters.
struct UmbilicPosition {
    double u = 0.0;
    double v = 0.0;
    Vector2 radius = Vector2::Zero();  ///< bounds on the distances from the true umbilic
    bool certified = false;            ///< existence proved, and uniqueness near it
    double index = 0.0;                ///< -0.5 or +0.5; 0 if not told
};

struct ProjectedPolyhedronUmbilics {
    std::vector<UmbilicPosition> umbilics;  ///< ordered by u, then v
    std::vector<ParameterBox> undecided;
    long boxes = 0;
    bool exhausted = false;
};

/// Isolated umbilics of a surface by the general solver of polynomial systems (thesis 3.6, 6.1.2), patch by patch: an
/// independent check of find_umbilics, slower and without its treatment of poles, lines and regions, which end as
/// undecided boxes. Bounds hold for every surface that rounds to the given one. Throws InvalidInput if an option is out
/// of range, Unsupported if P_N has too high a degree; Cancelled.
ProjectedPolyhedronUmbilics find_umbilics_by_projected_polyhedron(const NurbsSurface& surface,
                                                                  const ProjectedPolyhedronUmbilicOptions& options = {},
                                                                  const Progress& progress = {});

}  // namespace umbilic
