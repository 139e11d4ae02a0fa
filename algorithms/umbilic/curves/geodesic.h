// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/surface_curve.h>
#include <umbilic/curves/surface_path.h>
#include <umbilic/model/model.h>
#include <umbilic/nurbs/trimming.h>

namespace umbilic {

/// Geodesic curvature (1/mm) of a curve with the given first and second derivative of its parameters (u, v) by any
/// parameter (thesis 2.1.3, (2.14), (2.16)); positive where the curve turns to the left, seen against r_u x r_v. Needs
/// derivatives of order 2 at a regular point and a velocity that is not zero.
double geodesic_curvature(const SurfaceDerivatives& d, const Vector2& velocity, const Vector2& acceleration);

struct GeodesicOptions {
    /// Error allowed in a step of the integration, relative to sqrt(area of the face).
    double tolerance = 1e-10;
    /// Distance along the curve between the points returned, mm; 0 for the integration's own steps.
    double spacing = 0.0;
    /// Edges over which the curve goes on to other faces; without, it stays on its face.
    const SmoothJoins* joins = nullptr;
};

/// The geodesic that leaves `start` along the tangential part of `direction`, over `length` mm or until a border or a
/// trimming loop ends it (thesis 2.1.3, 3.4, initial value problem (2.19)-(2.22)). It passes across seams of closed
/// surfaces and through smooth poles. `error` sums the estimated errors of the steps; positions farther along can be
/// off by more where geodesics diverge.
///
/// Throws InvalidInput if the start is outside of the face, the surface is singular there, the direction has no
/// tangential part, or a number is not finite or not positive.
SurfaceCurve geodesic(const Face& face, const Vector2& start, const Vector3& direction, double length,
                      const GeodesicOptions& options = {}, const Progress& progress = {});

struct GeodesicSearchOptions {
    double tolerance = 1e-10;            ///< as GeodesicOptions
    double spacing = 0.0;                ///< as GeodesicOptions
    const SmoothJoins* joins = nullptr;  ///< as GeodesicOptions
    /// Longest geodesic that is sought, mm; 0: twice the diagonal of the model's box.
    double longest = 0.0;
    /// At most so many are returned: there can be infinitely many (opposite points of a sphere).
    int most = 16;
};

/// The geodesics found, by increasing length: the first one is the shortest.
struct GeodesicSearch {
    std::vector<SurfaceCurve> curves;
    std::string why;  ///< if there are none
};

/// Geodesics between two points of a model (thesis 3.4, boundary value problem): there may be several or none.
/// Starting curves are the solution of the relaxation method from the straight line in the parameter plane, if both
/// points lie on one face, and a fan of geodesics from the first point that is dense enough for the second one to lie
/// between two of them; each is refined by Newton's method on its direction and length, with the Jacobi field as
/// derivative. A geodesic that touches a border on its way is none. The search is complete as far as the fan's
/// resolution goes, which is no proof.
///
/// Throws InvalidInput if a point is outside of its face or singular, both are the same, or an option is out of range.
GeodesicSearch geodesics_between(const Model& model, const SurfacePoint& from, const SurfacePoint& to,
                                 const GeodesicSearchOptions& options = {}, const Progress& progress = {});

/// A curve on a face, in its surface's parameters.
struct FaceCurve {
    int face = 0;
    NurbsCurve2 curve;
};

/// Geodesics from a point that meet a curve at a right angle, by increasing length: the distance to the curve is least,
/// greatest or stationary along them. None if the least distance is reached at an end of the curve only. Otherwise as
/// geodesics_between().
GeodesicSearch geodesics_to_curve(const Model& model, const SurfacePoint& from, const FaceCurve& to,
                                  const GeodesicSearchOptions& options = {}, const Progress& progress = {});

}  // namespace umbilic
