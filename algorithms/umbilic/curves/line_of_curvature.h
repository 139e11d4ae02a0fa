// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/surface_curve.h>
#include <umbilic/model/model.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

struct LineOfCurvatureOptions {
    /// Arc length after which each of the two branches ends, mm; without it they go on to a border, an umbilic or the
    /// start, at most `longest` times sqrt(area of the face).
    std::optional<double> length;
    /// Error allowed in a step of the integration, relative to sqrt(area of the face).
    double tolerance = 1e-9;
    /// Distance along the curve between the points returned, mm; 0 for the integration's own steps.
    double spacing = 0.0;
    /// Only the branch along this vector, which need not be tangential; both if missing.
    std::optional<Vector3> direction;

    static constexpr double longest = 50.0;
};

/// The line of curvature of a family through a point of a face (thesis 2.1.2, 3.3, (2.12)-(2.13), (3.6)-(3.8)), in
/// arc length, in both directions until a border, a trimming loop, an umbilic or the start (a closed line) stops it.
/// The maximum family follows the greater normal curvature as seen from the face's outward side.
///
/// Principal directions come from an orthonormal frame, so that the choice between the thesis's two forms of the
/// equation is not needed; the sense is kept by the tangent in space. `error` is the sum of the estimated local errors
/// of the steps (Dormand and Prince's pair of orders 5 and 4).
///
/// Throws InvalidInput if the face's surface does not contain the start, the start lies outside of the trimming loops,
/// in an umbilic, an option is not finite or not positive, or the spacing asks for more than most_curve_points;
/// NumericFailure if the surface is too rough; Cancelled.
SurfaceCurve line_of_curvature(const Face& face, const Vector2& start, CurvatureFamily family,
                               const LineOfCurvatureOptions& options = {}, const Progress& progress = {});

/// Where a line of curvature that runs into an umbilic crosses a small circle around it.
struct SeparatrixStart {
    CurvatureFamily family = CurvatureFamily::maximum;
    Vector3 direction = Vector3::UnitX();  ///< unit tangent at the umbilic, away from it
    Vector2 parameters = Vector2::Zero();
};

/// The starts of all separatrices of a generic umbilic that lie on the face: where the principal direction is radial
/// on the circle of the given radius (mm). A line of curvature traced outwards from there nears the separatrix. Throws
/// InvalidInput for a non-generic umbilic.
std::vector<SeparatrixStart> separatrix_starts(const Face& face, const Umbilic& umbilic, double radius);

/// A line of curvature that runs into an umbilic, traced from there.
struct Separatrix {
    CurvatureFamily family = CurvatureFamily::maximum;
    Vector3 direction = Vector3::UnitX();  ///< unit tangent at the umbilic, away from it
    SurfaceCurve curve;                    ///< its first point is the umbilic
};

/// The lines of curvature that run into a generic umbilic: 6 half-lines from a star or monstar (2 for each direction,
/// which belong to opposite families), 2 from a lemon, in the order of Umbilic::directions (thesis 2.1.4, Figure 2-1).
/// They start a little away from the umbilic, at the point of a small circle around it where the principal direction
/// is radial. Options as above, `direction` is ignored. Throws as above, and InvalidInput for a non-generic umbilic
/// or one outside of the face.
std::vector<Separatrix> separatrices(const Face& face, const Umbilic& umbilic,
                                     const LineOfCurvatureOptions& options = {}, const Progress& progress = {});

}  // namespace umbilic
