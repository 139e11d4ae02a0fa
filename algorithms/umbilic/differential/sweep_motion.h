// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>

#include <umbilic/core/types.h>
#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

/// A point of a surface with its unit normal.
struct OrientedPoint {
    Vector3 point = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();
    Vector2 at = Vector2::Zero();  ///< its parameters (u, v)
};

/// A rotation about an axis or a translation that moves a surface within itself.
struct SweepMotion {
    bool rotation = true;
    Vector3 location = Vector3::Zero();  ///< point on the axis of a rotation
    Vector3 axis = Vector3::UnitZ();     ///< unit direction of the axis or of the translation
    /// Root mean square of the sine between the velocity and the surface.
    double slope = 0.0;
    /// The same for the next best motion: where it is not much larger than `slope`, the motion is not determined.
    double next_slope = 0.0;
};

/// The motion whose velocity c' + c x p is most nearly tangent to the surface at all points: its normals lie in the
/// linear complex (c, c') (Pottmann & Wallner, Computational Line Geometry, chapters 3 and 4). None if that motion is a
/// helical one, or there are fewer than 7 points.
std::optional<SweepMotion> sweep_motion(std::span<const OrientedPoint> points);

/// Largest distance (mm) between the surface and itself after the motion: each of the points, moved to the place of
/// another one a good part of the sweep away, is held against the surface there. None if more than half of the points
/// meet no surface when moved, so that it says nothing. Points on the axis take no part.
std::optional<double> sweep_deviation(const NurbsSurface& surface, const SweepMotion& motion,
                                      std::span<const OrientedPoint> points);

}  // namespace umbilic
