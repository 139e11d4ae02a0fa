// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/bernstein/interval.h>
#include <umbilic/core/progress.h>
#include <umbilic/curvature_points/by_projected_polyhedron.h>

namespace umbilic {

struct CurvatureSurfaceOptions {
    /// Points along u and along v at which K and H are taken; the thesis takes 100 x 100.
    int samples = 100;
    /// Levels of the approximation: 2^(levels - 1) pieces along u and along v; 9 give the thesis's 259 x 259 poles.
    int levels = 9;
};

/// K and H of a surface as bicubic splines over its parameter domain (thesis 4.8, Table 4.3): points with given
/// curvatures are then the solutions of two bicubic equations on each of their pieces, cheap and only as good as the
/// approximation. Made once for a surface; for comparison with find_curvature_points(), which needs no approximation.
class CurvatureSurfaces {
public:
    /// Throws InvalidInput if an option is out of range or the surface has no regular point; Cancelled.
    explicit CurvatureSurfaces(const NurbsSurface& surface, const CurvatureSurfaceOptions& options = {},
                               const Progress& progress = {});

    /// Greatest differences of the approximations from K (1/mm^2) and H (1/mm) seen between the samples, part of the
    /// thesis's delta_K and delta_H.
    double gaussian_error() const { return gaussian_error_; }
    double mean_error() const { return mean_error_; }

    /// Points of the approximations with given curvatures, both signs of H, ordered by sign, u, v. `radius`: how far
    /// the true point may be by the errors above and the slopes of K and H there; nothing is certified, and points may
    /// be missing where the curves of K and H nearly touch. Throws InvalidInput if the query has tolerances; Cancelled.
    std::vector<CurvaturePosition> find(const CurvatureQuery& query, const Progress& progress = {}) const;

private:
    /// One piece of both splines, Bernstein coefficients and their ranges.
    struct Piece {
        ParameterBox domain;
        std::vector<double> gaussian, mean;
        Interval gaussian_range, mean_range;
    };

    ParameterBox domain_;
    std::vector<Piece> pieces_;
    double gaussian_error_ = 0.0, mean_error_ = 0.0;
};

}  // namespace umbilic
