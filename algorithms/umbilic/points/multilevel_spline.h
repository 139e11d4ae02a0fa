// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/points/least_squares_surface.h>

namespace umbilic {

struct MultilevelOptions {
    int u_start = 1, v_start = 1;  ///< polynomial pieces along u and v on the coarsest level
    int levels = 6;                ///< each level halves the pieces of the last; at most 12
    double tolerance = 0.0;        ///< mm: no further level once the greatest distance is below it
};

struct MultilevelSpline {
    NurbsSurface surface;         ///< bicubic with uniform clamped knots on [0, 1]^2
    std::vector<double> rms;      ///< of the distances at the points' parameters after each level, mm
    std::vector<double> maximum;  ///< greatest such distance after each level, mm
};

/// Multilevel B-spline approximation of scattered points with parameters in [0, 1]^2 (S. Lee, G. Wolberg, S. Y. Shin,
/// Scattered data interpolation with multilevel B-splines, 1997: algorithms BA and MBA with refinement; thesis 4.8).
/// Local and without an equation system: the right tool for many points of uneven density, while least squares gives
/// smaller residuals for the same net. Throws InvalidInput if there is no point, a parameter lies outside [0, 1], or a
/// number is out of range; Cancelled.
MultilevelSpline multilevel_spline(std::span<const ParametrisedPoint> points, const MultilevelOptions& options = {},
                                   const Progress& progress = {});

}  // namespace umbilic
