// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/differential/area_samples.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// A plane, cylinder, cone, sphere, torus, surface of revolution or extrusion on which faces of a model lie, whatever
/// form their file gave them. Lengths in mm.
struct AnalyticFeature {
    SurfaceKind kind = SurfaceKind::plane;
    /// Unit: outward normal of a plane, axis (of a cone towards its wider end), direction of an extrusion; zero for a
    /// sphere.
    Vector3 direction = Vector3::Zero();
    /// Apex of a cone, centre of a sphere or torus; on a plane or an axis the point nearest to `middle`.
    Vector3 point = Vector3::Zero();
    double radius = 0.0;        ///< of a cylinder or sphere, major of a torus
    double minor_radius = 0.0;  ///< of a torus
    double semi_angle = 0.0;    ///< of a cone, in (0, pi/2)
    /// Outward is away from axis or centre (1: shaft, ball) or towards it (-1: hole); 0 for the others. Where the model
    /// is not made of solids, sides and normals of planes are what its file says and may mean nothing.
    int side = 0;
    double error = 0.0;                ///< mm; how far the parameters may be off near `middle`
    Vector3 middle = Vector3::Zero();  ///< centroid of its faces
    double extent = 0.0;               ///< root mean square distance of its faces from there
    double area = 0.0;                 ///< of its faces, mm^2
    std::vector<int> faces;            ///< numbers, in the model's order

    bool has_direction() const { return kind != SurfaceKind::sphere; }
    /// Cones, spheres and tori: `point` is a point of the shape and not any one of many.
    bool has_centre() const {
        return kind == SurfaceKind::cone || kind == SurfaceKind::sphere || kind == SurfaceKind::torus;
    }
    /// Cylinders, cones, tori and revolutions.
    bool has_axis() const {
        return kind == SurfaceKind::cylinder || kind == SurfaceKind::cone || kind == SurfaceKind::torus ||
               kind == SurfaceKind::revolution;
    }
    bool has_radius() const { return radius > 0.0; }
};

/// The features of a model, largest area first: what its file says of elementary faces, what recognise() says of the
/// others. Faces on the same surface with the same outward side are one feature. `samples`: of the model, see
/// area_samples(). Throws Cancelled.
std::vector<AnalyticFeature> analytic_features(const Model& model, const std::vector<AreaSample>& samples,
                                               const Progress& progress = {});

}  // namespace umbilic
