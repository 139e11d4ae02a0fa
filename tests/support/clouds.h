// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/model/point_cloud.h>
#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic::support {

/// Cloud of `count` points (x, y, f(x, y)), uniform in [-1, 1]^2, each with Gaussian noise of standard deviation
/// `noise` in every coordinate.
PointCloud graph_cloud(int count, const std::function<double(double, double)>& f, double noise, unsigned seed);

/// Points uniform by area on a sphere about the origin, with Gaussian noise.
PointCloud sphere_cloud(int count, double radius, double noise, unsigned seed);

/// Points uniform by area on a torus about the z axis, with Gaussian noise.
PointCloud torus_cloud(int count, double major, double minor, double noise, unsigned seed);

struct ScanKind {
    int points = 2000;
    double coverage = 1.0;  ///< share of the points that is left: those nearest to a random one
    double noise = 0.0;     ///< standard deviation in every coordinate, mm of the model
};

/// Points uniform by area on a model with Gaussian noise, moved by the inverse of `model_scan`.
PointCloud scan_of(const Model& model, const ScanKind& kind, const SimilarityTransform& model_scan, unsigned seed);

/// Mesh of n x n vertices over the parameters of a surface.
PointCloud mesh_of(const NurbsSurface& surface, int n);

}  // namespace umbilic::support
