// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/model/model.h>
#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic {

struct RecognitionOptions {
    /// Largest deviation that is accepted, relative to the diagonal of the surface's control points. Polynomial
    /// approximations of spheres and the like stay below the default.
    double tolerance = 1e-4;
    /// Surfaces of revolution and extrusions that are none of the elementary kinds are recognised as well.
    bool swept = true;
};

/// What a NURBS surface is besides.
struct RecognisedSurface {
    /// plane, sphere, cylinder, cone, torus, revolution or extrusion.
    SurfaceKind kind = SurfaceKind::plane;
    /// Parameters as in Face::elementary, in model coordinates. For a revolution `location` and `axis` give its axis,
    /// for an extrusion `axis` gives its direction; the radii are 0. The sense of an axis is arbitrary but
    /// deterministic, except that a cone's radius grows along it; `x_axis` points to the surface's first corner where
    /// that is off the axis.
    ElementarySurface surface;
    /// Largest distance (mm) of the control points from a plane, which bounds that of the surface; of a sample of at
    /// least 2 degree + 1 points per polynomial piece and direction for the other elementary kinds; and between a swept
    /// surface and itself after its motion, at some hundred points.
    double deviation = 0.0;
    /// The deviation is within the rounding of coordinates.
    bool exact = false;
    /// Estimate of how far (mm; angles times the surface's size) the parameters may be off if the surface is known
    /// only to its deviation. Surfaces for which it exceeds `largest_parameter_error` are not recognised.
    double parameter_error = 0.0;

    /// Share of the larger one of the surface's size and its radius.
    static constexpr double largest_parameter_error = 0.01;
};

/// Recognises a surface that is, within the tolerance, a plane, sphere, cylinder, cone, torus, surface of revolution or
/// extrusion: candidates from the curvatures and normals at a few points (normals of a swept surface lie in a linear
/// complex: Pottmann & Wallner, Computational Line Geometry), least squares, then a check over the whole surface. The
/// simplest kind wins whose deviation is of the smallest order. None if nothing fits, if the piece is too small or too
/// flat for its parameters to be told, or if the surface has too few regular points or no size. The time for a surface
/// that is nothing of the kind is that of some hundred evaluations. Throws InvalidInput if the tolerance is not finite
/// and positive.
std::optional<RecognisedSurface> recognise(const NurbsSurface& surface, const RecognitionOptions& options = {});

/// The same for every face of a model, in the model's order: none for faces that are elementary by their own kind.
/// Throws Cancelled.
std::vector<std::optional<RecognisedSurface>> recognise(const Model& model, const RecognitionOptions& options = {},
                                                        const Progress& progress = {});

}  // namespace umbilic
