// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/model/model.h>
#include <umbilic/nurbs/trimming.h>

namespace umbilic {

/// Values of Gaussian and mean curvature to be found, K = gaussian (1/mm^2) and H = mean (1/mm, kappa = -II / I),
/// within tolerances that are both 0 or both positive.
struct CurvatureQuery {
    double gaussian = 0.0;
    double mean = 0.0;
    double gaussian_tolerance = 0.0;
    double mean_tolerance = 0.0;
};

struct CurvaturePointOptions {
    /// Also find H = -mean, as on a surface whose normal points to the other side.
    bool both_signs = true;
    /// Side of a box, relative to the domain's sides, below which a box counts as fine: tangencies are followed four
    /// decades further with a budget, curves of solutions are left.
    double resolution = 1e-3;
    /// Boxes a Bezier patch may use, all queries together, before what is left of it is returned unproved.
    int boxes_per_patch = 200000;
    /// See curvature_dependence(). 0: only what the equations themselves show.
    double recognition = 1e-6;
};

/// A place with the values of a query. Tolerances 0: a solution, or what could not be told from one. Otherwise one
/// connected part of the region within the tolerances.
struct CurvaturePoint {
    int query = 0;          ///< index into the queries
    bool opposite = false;  ///< H is minus the query's
    SurfacePoint at;
    Curvature curvature;  ///< there; a face's outward side applied
    /// The exact values are proved to be taken at one point, and at no other, of a box around `at`, and that within
    /// `radius` (relative to the domain's sides) of `at`. Not certified: the place in `extent` with the least misfit.
    bool certified = false;
    double radius = 0.0;
    int solutions = 0;    ///< proved exact solutions in `extent`
    ParameterBox extent;  ///< box of existence and uniqueness, or box around the connected part
    Containment containment = Containment::inside;
};

struct CurvaturePoints {
    int face = 0;
    /// Why there is no answer; see curvature_dependence(). None if there is one.
    std::optional<std::string> refused;
    std::vector<CurvaturePoint> points;  ///< ordered by query, sign, u, v
    int patches = 0;                     ///< Bezier patches searched
    long boxes = 0;                      ///< boxes visited
    bool exhausted = false;              ///< a budget ended; some extents may hold nothing
};

/// All points of a surface with given curvatures (thesis 4.6.2, (4.6)), many queries and both signs of H in one pass
/// over its patches. Throws InvalidInput for numbers out of their ranges, Cancelled.
CurvaturePoints find_curvature_points(const NurbsSurface& surface, std::span<const CurvatureQuery> queries,
                                      const CurvaturePointOptions& options = {}, const Progress& progress = {});

/// The same of a face: H and normals are those of its outward side, `containment` is told from its loops, and patches
/// that the loops do not touch are not searched.
CurvaturePoints find_curvature_points(const Face& face, std::span<const CurvatureQuery> queries,
                                      const CurvaturePointOptions& options = {}, const Progress& progress = {});

/// The same of all faces, in the model's order, faces in parallel.
std::vector<CurvaturePoints> find_curvature_points(const Model& model, std::span<const CurvatureQuery> queries,
                                                   const CurvaturePointOptions& options = {},
                                                   const Progress& progress = {});

}  // namespace umbilic
