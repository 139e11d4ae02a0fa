// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>

#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic::support {

/// The same surface, point for point, under another description. Control points are computed in extended precision and
/// rounded once, so that positions agree within a few ulps of the largest coordinate.
struct Reparametrised {
    NurbsSurface surface;
    /// Parameters on `surface` of the point that had the given parameters on the original.
    std::function<Vector2(const Vector2&)> parameters;
    /// `parameters` takes straight lines to straight lines, evenly.
    bool affine = true;
    /// u, on the original, of the line along which `parameters` bends.
    std::optional<double> bend = {};
};

/// u and v exchanged.
Reparametrised exchanged(const NurbsSurface& surface);
/// u replaced by low + high - u.
Reparametrised u_backwards(const NurbsSurface& surface);
/// v replaced by low + high - v.
Reparametrised v_backwards(const NurbsSurface& surface);

/// Degrees raised, the parameters kept.
Reparametrised elevated(const NurbsSurface& surface, int u_raise, int v_raise);

/// Every given parameter (inside the domain) inserted as a knot once more; those that reach the degree in multiplicity
/// stay there. The parameters are kept.
Reparametrised with_knots(const NurbsSurface& surface, std::span<const double> u, std::span<const double> v);

/// Knots of full multiplicity in the middle of both domains and at every interior knot: Bezier patches side by side.
Reparametrised in_bezier_form(const NurbsSurface& surface);

/// Numerator and denominator multiplied by a function that is linear in u and in v and whose values at the ends have
/// the given ratio (> 0): rational with unequal weights, one degree higher, the parameters kept.
Reparametrised with_common_factor(const NurbsSurface& surface, double u_ratio, double v_ratio);

/// Rational reparametrisation in each direction: x = s / (s + ratio (1 - s)) for the old x and the new s, both relative
/// to the domain; ratio > 0. Control points stay, weights change.
Reparametrised moebius(const NurbsSurface& surface, double u_ratio, double v_ratio);

/// Two pieces, cut at the share 0.4 of the u domain, joined again after the second was stretched to twice its length in
/// u: a knot across which the shape is as smooth as before and the parametrisation only continuous.
Reparametrised rejoined(const NurbsSurface& surface);

/// The part of the surface over a box within its domain, clamped; the parameters are kept.
NurbsSurface restricted(const NurbsSurface& surface, const ParameterBox& box);

/// A polynomial surface near the given one: interpolation on uniform knots of the given degree with the least number of
/// poles, doubled from twice the degree, that comes within `deviation`.
struct Reapproximated {
    NurbsSurface surface;
    /// Largest distance at equal parameters, measured on a grid of 5 points to a pole's distance.
    double deviation = 0.0;
};
/// Throws NumericFailure if 256 poles a side do not reach the deviation.
Reapproximated reapproximated(const NurbsSurface& surface, int degree, double deviation);

}  // namespace umbilic::support
