// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic::support {

/// Planar NURBS curve that is swept: coordinates are (radius, height) for a revolution, (x, y) for an extrusion.
struct Profile {
    KnotVector knots;
    std::vector<Vector2> poles;
    std::vector<double> weights;  ///< one for each pole
};

/// Exact rational arc of a circle, angles in radians, `to` > `from`.
Profile arc(const Vector2& centre, double radius, double from, double to);
Profile segment(const Vector2& from, const Vector2& to);
/// Polynomial B-spline on uniform clamped knots.
Profile spline(int degree, std::vector<Vector2> poles);

/// Exact rational surface of revolution about the z axis: u around by `angle` (at most 2 pi) from the x axis, v along
/// the profile.
NurbsSurface revolved(const Profile& profile, double angle);
/// u along the profile in the plane z = 0, v along z by `height`.
NurbsSurface extruded(const Profile& profile, double height);

}  // namespace umbilic::support
