// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/model/point_cloud.h>
#include <umbilic/nurbs/surface_derivatives.h>
#include <umbilic/points/neighbours.h>

namespace umbilic {

struct JetOptions {
    /// Radius of the neighbourhood, mm; none: default_jet_radius of the cloud's length.
    std::optional<double> radius;
    int fewest_neighbours = 40;  ///< the radius grows until it holds as many
    int most_neighbours = 400;   ///< of a denser cloud as many are taken, spread over the neighbourhood
};

/// Neighbourhood as a part of the cloud's length (twice the root mean square distance from the centroid).
inline constexpr double default_jet_radius = 0.15;
/// A point is interior if its neighbours leave no gap of more than this angle around it (radians).
inline constexpr double greatest_interior_gap = 1.2217304763960306;  // 70 degrees

/// The surface around one point of a cloud: a polynomial of degree 4 over the local tangent plane, fitted to the
/// neighbours by weighted least squares.
struct PointJet {
    int index = 0;       ///< of the point in the cloud
    bool valid = false;  ///< false where the neighbours do not determine a surface: nothing else holds then
    bool interior = false;
    SurfaceDerivatives derivatives;  ///< up to order 3 of the fitted surface, at its point on the point's normal
    /// Principal frame there. The normal points to the side of the cloud's normal or of the triangles' outside; without
    /// either its sign is arbitrary.
    Curvature frame;
    /// Standard deviations from the residuals: of the curvatures (1/mm) and of the angle of the principal directions
    /// (radians, at most pi/2). They do not contain what a polynomial of degree 4 misses of the shape.
    double kappa_max_error = 0.0, kappa_min_error = 0.0, direction_error = 0.0;
    double residual = 0.0;  ///< standard deviation of the neighbours' heights from the fit, mm: noise and misfit
    double radius = 0.0;    ///< mm
    int neighbours = 0;
};

/// Estimates curvatures at the given points of a cloud or mesh (thesis 4.6.2; jets of degree 4 after Cazals and Pouget,
/// Estimating differential quantities using polynomial fitting of osculating jets, 2005): Gaussian weights, the frame
/// of a first plane, then refitted in the frame of the fitted normal. Neighbours whose normals (if there are any) look
/// to the other side belong to another sheet and are left out. Deterministic. Throws InvalidInput if a radius is not
/// positive; Cancelled.
std::vector<PointJet> point_jets(const PointCloud& cloud, const Neighbours& neighbours, std::span<const int> indices,
                                 const JetOptions& options = {}, const Progress& progress = {});

/// Twice the root mean square distance of the points from their centroid, mm.
double cloud_length(std::span<const Vector3> points);

/// Noise of a cloud, mm: the median of the residuals of its interior jets; 0 if there are none.
double estimated_noise(std::span<const PointJet> jets);

}  // namespace umbilic
