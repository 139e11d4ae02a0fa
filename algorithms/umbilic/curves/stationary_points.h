// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/core/types.h>
#include <umbilic/curves/closest_point.h>
#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

struct StationaryPointsOptions {
    /// Side, relative to a Bezier patch, below which a box is not split; boxes undecided then are returned as such.
    double tolerance = 1e-8;
    /// Boxes a Bezier patch, or a piece of an edge, may use before what is left of it is returned undecided.
    long boxes_per_patch = 20000;
};

/// What the distance does around a stationary point: over the surface for interior points, along the edge for points of
/// edges. `undetermined`: at corners, and where the second derivative is not told from singular (the point lies on the
/// evolute).
enum class StationaryType { minimum, saddle, maximum, undetermined };

/// A point of the surface at which the distance from a given point is stationary.
struct StationaryPoint {
    SurfacePoint at;
    Vector3 point = Vector3::Zero();
    double distance = 0.0;  ///< mm
    /// interior: p lies on the surface's normal there; edge: in the plane normal to the edge; corner: a corner of the
    /// domain, or the single point of a collapsed edge.
    FootKind kind = FootKind::interior;
    StationaryType type = StationaryType::undetermined;
    Vector2 radius = Vector2::Zero();  ///< bounds on the distances of (u, v) from the true ones, in parameter units
    /// Existence was proved, and that there is no other one near. Of corners nothing has to be proved. False for a
    /// collapsed edge that is stationary within rounding: reported as interior.
    bool certified = false;
};

/// Boxes that may hold stationary points and touch: a curve or region of them, as from the centre of a sphere or
/// from the axis of a surface of revolution, or a point of the evolute. Boxes on an edge have no width across it.
struct StationaryCluster {
    std::vector<ParameterBox> boxes;
};

struct StationaryPoints {
    std::vector<StationaryPoint> points;  ///< by distance, nearest first
    std::vector<StationaryCluster> undecided;
    int patches = 0;         ///< Bezier patches searched
    long boxes = 0;          ///< boxes examined
    bool exhausted = false;  ///< a budget was spent
};

/// All stationary points of the distance from `point` to a surface on its whole domain (thesis 4.2.3 and 3.5.6): in the
/// interior, where (r - p).r_u = (r - p).r_v = 0, on the edges and at the corners, by the Interval Projected
/// Polyhedron method on every Bezier patch (docs/algorithms/stationary_points.md). Every one is in the result or lies
/// in an undecided box. Lines inside the domain at which the tangent plane breaks count as edges, and ends that meet
/// smoothly (a seam) do not. Throws InvalidInput if the point is not finite or an option is out of range; Cancelled.
StationaryPoints find_stationary_points(const NurbsSurface& surface, const Vector3& point,
                                        const StationaryPointsOptions& options = {}, const Progress& progress = {});

}  // namespace umbilic
