// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include <Geom_Surface.hxx>
#include <gp_Trsf.hxx>

#include <umbilic/model/model.h>

namespace umbilic {

/// A surface of a CAD file as NURBS surface in model coordinates.
struct ConvertedSurface {
    SurfaceKind kind = SurfaceKind::other;
    std::optional<ElementarySurface> elementary;
    NurbsSurface surface;
    /// From the NURBS surface's parameters to those of the file's surface.
    ParameterMap u_map, v_map;
    bool u_closed = false, v_closed = false;
    bool u_periodic = false, v_periodic = false;
    /// Largest distance found (mm) between the two surfaces at equal native parameters; 0 if only rounding separates
    /// them.
    double error = 0.0;
};

/// What kind of surface this is, rectangular trimming apart.
SurfaceKind surface_kind(const Handle(Geom_Surface) & surface);

/// Converts a surface over the native parameters `range` (finite). Planes, cylinders, cones, spheres, tori, surfaces
/// of revolution and extrusion of lines, conics and splines, Bezier and B-spline surfaces are converted exactly;
/// everything else (offsets, hyperbolic profiles) is approximated and the deviation measured. B-spline surfaces that
/// are not periodic keep their whole domain. `placement` is applied to the control points and may scale and mirror.
/// Throws InvalidInput or Unsupported where the surface cannot be converted.
ConvertedSurface convert_surface(const Handle(Geom_Surface) & surface, const ParameterBox& range,
                                 const gp_Trsf& placement);

}  // namespace umbilic
