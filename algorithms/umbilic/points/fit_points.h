// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/model/point_cloud.h>
#include <umbilic/nurbs/nurbs_surface.h>
#include <umbilic/points/least_squares_surface.h>

namespace umbilic {

/// scattered: least squares after projection onto a base surface; multilevel: multilevel B-splines on the same
/// parameters; grid: the points stand in rows and columns.
enum class FitMethod { scattered, multilevel, grid };

struct FitOptions {
    FitMethod method = FitMethod::scattered;
    int degree = 3;
    /// Poles along u and v; none: grown until the residual is noise, or until it is within `tolerance`.
    std::optional<std::pair<int, int>> poles;
    /// Greatest distance (mm) of a point from the surface at which a net grows no more; none: the noise decides.
    std::optional<double> tolerance;
    /// Rows and columns of a grid, whose points follow each other row by row.
    std::optional<std::pair<int, int>> grid;
    /// Width (mm) of a Gaussian low-pass filter before the fit; none: no filter.
    std::optional<double> smooth;
    /// Foot points are taken anew and the net is fitted again as often as this, while the residual falls.
    int reprojections = 10;
    /// Most poles along either direction of a net that is grown.
    int most_poles = 64;
};

/// One net that was tried.
struct FitStep {
    int u_poles = 0, v_poles = 0;
    double rms = 0.0, maximum = 0.0;  ///< distances of the points from the surface, mm
};

struct FitResult {
    NurbsSurface surface;
    FitMethod method = FitMethod::scattered;
    std::vector<ParametrisedPoint> points;        ///< as given, with the parameters of their foot points on the surface
    std::vector<double> distances;                ///< from the surface, positive on the side of r_u x r_v, mm
    double rms = 0.0, mean = 0.0, maximum = 0.0;  ///< of the distances' sizes, mm
    double noise = 0.0;                           ///< standard deviation along the normal, from local jets, mm
    bool reached_noise = false;     ///< the rms is that of noise, given the number of poles: more poles would fit noise
    bool within_tolerance = false;  ///< no point is farther than FitOptions::tolerance, if there is one
    std::vector<FitStep> steps;     ///< nets that were tried, in order
    double filter_rms_change = 0.0, filter_max_change = 0.0;  ///< what the low-pass filter moved, mm
};

/// The rms of a fit is noise if it is within this factor of the noise the jets see.
inline constexpr double noise_reached = 1.1;
/// A larger net must lower the rms by this part to be worth its poles.
inline constexpr double worthwhile_fall = 0.05;

/// Fits a NURBS surface to points (thesis 4.3). Scattered points get parameters by projection onto a base surface, at
/// first their regression plane, then the last fit (W. Ma, J. P. Kruth, Parameterization of randomly measured points
/// for least squares fitting of B-spline curves and surfaces, 1995), so they must project one-to-one onto a plane: a
/// shell that closes on itself has to be cut first, or given as a grid. Throws InvalidInput (too few points, numbers
/// out of range, a grid that does not fit), Unsupported (points that fold over their plane), NumericFailure, Cancelled.
FitResult fit_points(const PointCloud& cloud, const FitOptions& options = {}, const Progress& progress = {});

const char* name(FitMethod method);

}  // namespace umbilic
