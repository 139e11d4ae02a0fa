// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/core/types.h>
#include <umbilic/curvature_points/curvature_points.h>

namespace umbilic {

enum class CurvatureSystem {
    /// Three equations in u, v and n = |r_u x r_v|: n^2 = t, q w^4 = K n^4, s w = -2 H n^3 (thesis (4.6),
    /// (B.1)-(B.13)).
    auxiliary,
    /// Two equations without it, for both signs of H at once: q w^4 = K t^2, s^2 w^2 = 4 H^2 t^3. The sign is read off
    /// afterwards.
    squared,
};

struct ProjectedPolyhedronCurvatureOptions {
    CurvatureSystem system = CurvatureSystem::auxiliary;
    /// Side of the smallest box, relative to a Bezier patch and to the range of n.
    double tolerance = 1e-8;
    long boxes_per_patch = 20000;
};

/// A point with the curvatures of the query, in the surface's parameters.
struct CurvaturePosition {
    bool opposite = false;  ///< H is minus the query's
    double u = 0.0;
    double v = 0.0;
    Vector2 radius = Vector2::Zero();  ///< bounds on the distances from the true point
    bool certified = false;            ///< existence proved, and uniqueness near it
};

struct ProjectedPolyhedronCurvaturePoints {
    std::vector<CurvaturePosition> points;  ///< ordered by sign, u, v
    std::vector<ParameterBox> undecided;
    long boxes = 0;
    bool exhausted = false;
};

/// Points of a surface with given curvatures, both signs of H, by the general solver of polynomial systems (thesis
/// 3.8.2, 4.6.2), patch by patch: an independent check of find_curvature_points, slower and without its treatment of
/// poles and of tolerances. Throws InvalidInput if an option is out of range or the query has tolerances; Cancelled.
ProjectedPolyhedronCurvaturePoints find_curvature_points_by_projected_polyhedron(
    const NurbsSurface& surface, const CurvatureQuery& query, const ProjectedPolyhedronCurvatureOptions& options = {},
    const Progress& progress = {});

}  // namespace umbilic
