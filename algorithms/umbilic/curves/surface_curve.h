// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/types.h>

namespace umbilic {

/// The two families of lines of curvature: the lines that follow direction_max or direction_min (see Curvature).
enum class CurvatureFamily { maximum, minimum };

/// Why a curve ends where it does.
enum class CurveEnd {
    length,    ///< the length asked for is reached
    boundary,  ///< border of the surface, with no face to go on to
    trim,      ///< a trimming loop inside the surface, with no face to go on to
    umbilic,   ///< the direction of a line of curvature is lost
    closed,    ///< the curve came back to its start
    evolute,   ///< the projection of a curve is not defined: its foot is a centre of curvature
    point      ///< an end that was given, or where the curve was started
};

/// A point of a curve on a model's surface.
struct SurfaceCurvePoint {
    double s = 0.0;  ///< arc length from the first point, mm
    SurfacePoint at;
    Vector3 point = Vector3::Zero();
};

/// A curve on the faces of a model, as points in order of arc length. Where it passes from face to face the same point
/// in space stands twice, once for each face.
struct SurfaceCurve {
    std::vector<SurfaceCurvePoint> points;
    bool closed = false;  ///< the last point is the first again
    CurveEnd started = CurveEnd::point;
    CurveEnd ended = CurveEnd::length;
    double length = 0.0;  ///< mm
    double error = 0.0;   ///< estimated distance of the points from the true curve, mm
};

/// Points a curve may be asked for.
inline constexpr int most_curve_points = 1'000'000;

/// Into how many equal parts of about `spacing` (mm, above 0) a curve of that length is cut, at least one. Throws
/// InvalidInput if that were more than most_curve_points.
int parts_of(double length, double spacing);

/// Lower-case words of the JSON results.
const char* name(CurvatureFamily family);
const char* name(CurveEnd end);

}  // namespace umbilic
