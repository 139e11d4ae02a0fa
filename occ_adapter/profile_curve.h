// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <Geom_Curve.hxx>

#include <umbilic/nurbs/knot_vector.h>
#include <umbilic/nurbs/parameter_map.h>

namespace umbilic {

/// Exact NURBS form of a space curve, from which surfaces are swept.
struct ProfileCurve {
    KnotVector knots;
    std::vector<Vector3> poles;
    std::vector<double> weights;  ///< one a pole
    ParameterMap map;             ///< native parameter of the NURBS parameter
};

/// Arc of the unit circle in the xy plane over the given angles (radians, low < high), as rational quadratic whose
/// spans are a quarter of a turn or less. Angles may exceed a turn.
ProfileCurve unit_arc(const ParameterInterval& angles);

/// Exact NURBS form of a line, circle, ellipse, parabola, Bezier or B-spline curve over `range`, in the curve's own
/// parameter up to `map`; B-splines that are not periodic keep their whole domain. Nothing for any other curve.
std::optional<ProfileCurve> profile_curve(const Handle(Geom_Curve) & curve, const ParameterInterval& range);

/// Flat knots and pole numbers (from 0, modulo the number of poles) that cover `range` of a periodic B-spline, with
/// no arithmetic on the poles. `knots`: one period of distinct knots, both ends included; `multiplicities` likewise.
struct UnrolledKnots {
    std::vector<double> knots;
    std::vector<int> poles;
};
UnrolledKnots unroll_periodic(int degree, const std::vector<double>& knots, const std::vector<int>& multiplicities,
                              const ParameterInterval& range);

}  // namespace umbilic
