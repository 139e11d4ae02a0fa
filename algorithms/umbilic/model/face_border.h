// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/model/model.h>
#include <umbilic/nurbs/boundary_point.h>

namespace umbilic {

/// The loops that bound a face: those of its region or, where it has none, the four sides of its surface's domain as
/// one loop that runs counter-clockwise in the parameter plane.
std::vector<TrimmingLoop> border_loops(const Face& face);

/// A part of one curve of a face's border.
struct BorderPiece {
    int face = 0;   ///< Face::number
    int loop = 0;   ///< index into border_loops()
    int curve = 0;  ///< index into the loop
    /// Part of the curve's domain.
    ParameterInterval range;
    /// The face lies on the left of the curve, looking along its growing parameter with the parameter plane seen from
    /// above (u to the right, v upwards).
    bool face_on_left = true;
};

/// A point of a face's border.
struct BorderPoint {
    int face = 0;
    int loop = 0;
    int curve = 0;
    double t = 0.0;                        ///< parameter of the curve
    Vector2 parameters = Vector2::Zero();  ///< (u, v) of the face's surface
    Vector3 point = Vector3::Zero();       ///< mm
    Vector3 tangent = Vector3::Zero();     ///< derivative of `point` by t; zero on a degenerate curve
    double distance = 0.0;                 ///< from the point asked for (see the function)
};

/// Whether the face is on the left of its border curve, by a look at both sides of the middle of `range`; the rule that
/// a loop runs counter-clockwise around its face decides where that shows no difference.
bool face_on_left(const Face& face, const TrimmingCurve& curve, const ParameterInterval& range);

/// Point of a border curve nearest in space to `point`, among the parameters of `range`; `distance` in mm. `guess`
/// starts the search; where it does not lead within `good_enough` (mm), the whole range is sampled first.
BorderPoint nearest_in_space(const Face& face, const std::vector<TrimmingLoop>& loops, const BorderPiece& piece,
                             const Vector3& point, double guess, double good_enough);

/// Point of the whole border nearest to `parameters` in the parameter plane; `distance` relative to the sides of the
/// surface's domain.
BorderPoint nearest_in_parameters(const Face& face, const std::vector<TrimmingLoop>& loops, const Vector2& parameters);

}  // namespace umbilic
