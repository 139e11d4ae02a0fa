// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/foot_point.h>
#include <umbilic/curves/relaxation.h>
#include <umbilic/curves/surface_curve.h>
#include <umbilic/curves/surface_path.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// A curve in space by any parameter.
struct SpaceCurve {
    /// Point (mm) and derivative by the parameter.
    std::function<std::pair<Vector3, Vector3>(double t)> at;
    ParameterInterval range;
    std::vector<double> breaks;  ///< where the derivative or the next two may jump, increasing
};

/// Polyline through at least two points, by its length. Throws InvalidInput for fewer, or points that are equal or not
/// finite.
SpaceCurve polyline(std::vector<Vector3> points);

struct ProjectionOptions {
    /// Error allowed in a step of the integration, relative to sqrt(area of the target).
    double tolerance = 1e-9;
    /// Distance along the original between the points returned, in its parameter; 0 for the integration's own steps.
    double spacing = 0.0;
    /// Foot of the curve's start on the target; the nearest of feet() if missing.
    std::optional<Vector2> foot;
    /// Edges over which the projection goes on to other faces, and the original of a geodesic.
    const SmoothJoins* joins = nullptr;
    const SmoothJoins* original_joins = nullptr;
};

/// A curve and its orthogonal projection, point by point.
struct ProjectedCurve {
    /// The original by its arc length (for a space curve without faces: empty).
    SurfaceCurve original;
    /// The projection by its own arc length. `ended` says why both end: CurveEnd::evolute where the original passes a
    /// centre of curvature of the target, so that its foot is not defined any more. `error` is measured: the largest
    /// distance of the points to the feet that Newton's method finds from them.
    SurfaceCurve projection;
    /// The target's border or trimming loop ended it, not the original's.
    bool left_target = false;
};

/// Orthogonal projection of a space curve onto a face, as the solution of the differential equations (3.29) with
/// matrix (3.32) and the signed distance rho = (gamma - Gamma).N (thesis 3.5.3). It ends where it leaves the target.
/// Throws InvalidInput if the foot of the start does not lie on the face or the curve is not finite; NumericFailure if
/// the start lies on the target's evolute.
ProjectedCurve project_curve(const SpaceCurve& curve, const Face& onto, const ProjectionOptions& options = {},
                             const Progress& progress = {});

/// A line of curvature of a face and its projection onto another, four coupled equations (thesis 3.5.4, (3.33)-(3.38)),
/// from `start` along the part of `direction` in its family; the families are those of the face's outward side. Throws
/// as project_curve() and line_of_curvature().
ProjectedCurve project_line_of_curvature(const Face& from, const Vector2& start, CurvatureFamily family,
                                         const Vector3& direction, double length, const Face& onto,
                                         const ProjectionOptions& options = {}, const Progress& progress = {});

/// A geodesic by its start and its projection, six equations (thesis 3.5.5, (3.39)-(3.43)). Throws as project_curve()
/// and geodesic().
ProjectedCurve project_geodesic(const Face& from, const Vector2& start, const Vector3& direction, double length,
                                const Face& onto, const ProjectionOptions& options = {}, const Progress& progress = {});

struct ProjectedGeodesicBetween {
    ProjectedCurve curve;
    Relaxation relaxation;  ///< states u_A, v_A, p, q, u_B, v_B by a parameter from 0 to 1
};

/// A geodesic between two points of one face and its projection as a boundary value problem with six boundary values,
/// by relaxation from the straight line (thesis 3.5.5, Figure 3-2). `relaxation.converged` tells whether the curves
/// are a solution; there may be others (geodesics_between()). Throws as project_curve().
ProjectedGeodesicBetween project_geodesic_between(const Face& from, const Vector2& start, const Vector2& end,
                                                  const Face& onto, const ProjectionOptions& options = {},
                                                  const RelaxationOptions& relaxation = {},
                                                  const Progress& progress = {});

}  // namespace umbilic
