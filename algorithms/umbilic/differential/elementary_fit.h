// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>

#include <umbilic/core/types.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Distance of a point from a surface, and its gradient: the unit normal at the foot.
struct SignedDistance {
    double value = 0.0;  ///< mm
    Vector3 gradient = Vector3::Zero();
};

/// Signed distance from a plane, cylinder, cone, sphere or torus: positive on the side a plane's normal points to, and
/// outside the others. A cone ends in no apex here: it is continued by its tangent planes. Throws InvalidInput for
/// kinds of surface that have no parameters.
SignedDistance elementary_distance(SurfaceKind kind, const ElementarySurface& surface, const Vector3& point);

struct ElementaryFit {
    ElementarySurface surface;
    double deviation = 0.0;  ///< mm, largest distance of a point
    /// By how much the parameters may change for a change of 1 mm (root mean square) of the distances: mm of positions
    /// and radii, and of angles times half the extent of the points. Large for small pieces of large surfaces.
    double condition = 0.0;
};

/// The plane, cylinder, cone, sphere or torus nearest to the points, sum of squared distances, by Gauss and Newton's
/// method from `start`. Needs more points than the kind has parameters; throws InvalidInput otherwise, and for kinds of
/// surface that have no parameters.
ElementaryFit fit_elementary(SurfaceKind kind, const ElementarySurface& start, std::span<const Vector3> points);

/// Starting values, by the algebraic fit: exact for points that lie exactly on such a surface, none if no such surface
/// passes near them (a plane instead of a sphere, say).
std::optional<ElementarySurface> plane_through(std::span<const Vector3> points);
std::optional<ElementarySurface> sphere_through(std::span<const Vector3> points);
/// Cylinder with this direction.
std::optional<ElementarySurface> cylinder_through(std::span<const Vector3> points, const Vector3& direction);
/// Cone or torus with this axis: `axis` has location and direction.
std::optional<ElementarySurface> cone_through(std::span<const Vector3> points, const ElementarySurface& axis);
std::optional<ElementarySurface> torus_through(std::span<const Vector3> points, const ElementarySurface& axis);

}  // namespace umbilic
