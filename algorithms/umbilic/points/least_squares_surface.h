// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

/// A point with the parameters at which a surface shall come close to it.
struct ParametrisedPoint {
    double u = 0.0;
    double v = 0.0;
    Vector3 point = Vector3::Zero();
};

/// Grid of points, point (i, j) at [i * columns + j], i along u.
struct PointGrid {
    int rows = 0;
    int columns = 0;
    std::vector<Vector3> points;
};

/// Clamped knots on [0, 1] for `poles` poles that lie in the middle of the parameters' runs, so that every span holds
/// parameters (The NURBS Book, (9.69)). `parameters` increase from 0 to 1. Throws InvalidInput if poles <= degree or
/// there are more poles than parameters.
KnotVector fitting_knots(int degree, int poles, std::span<const double> parameters);

/// Clamped knots on [0, 1] with spans of one length. Throws InvalidInput if poles <= degree.
KnotVector uniform_knots(int degree, int poles);

/// Chord-length parameters in [0, 1] of the rows (u) or columns (v) of a grid, averaged over the other direction
/// (thesis 4.3; The NURBS Book, A9.3). Throws InvalidInput if the grid is smaller than 2 x 2, its size does not fit, or
/// all points of a direction coincide.
std::vector<double> chord_length_u(const PointGrid& grid);
std::vector<double> chord_length_v(const PointGrid& grid);

/// Surface with the given knots that minimises the squared distances of a grid's points from their parameters' places
/// (thesis 4.3): one least-squares problem for the rows, one for the columns, each solved by SVD, so that what the
/// points leave open is 0 motion of the poles. Throws InvalidInput if the numbers of parameters do not fit the grid.
NurbsSurface fit_grid(const PointGrid& grid, std::span<const double> u, std::span<const double> v,
                      const KnotVector& u_knots, const KnotVector& v_knots);

/// Surface with the given knots that minimises the squared distances of scattered points from their parameters' places,
/// plus `fairness` (relative to the mean weight of a pole) times the squared second differences of the poles, which
/// carries the surface over places without points. Normal equations, sparse Cholesky factorisation. Throws InvalidInput
/// if there is no point or a parameter lies outside the knots' domain; NumericFailure if the poles are not determined.
NurbsSurface fit_scattered(std::span<const ParametrisedPoint> points, const KnotVector& u_knots,
                           const KnotVector& v_knots, double fairness);

}  // namespace umbilic
