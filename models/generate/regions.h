// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <TopoDS_Shape.hxx>

namespace umbilic::models {

/// Measures of dome_plate(), from which its areas follow in closed form.
struct DomePlate {
    double length = 120, width = 100;  // mm; the plate lies in z = 0, centred at the origin
    double dome_x = 9, dome_y = -6;    // mm; axis of the dome
    double radius = 30;                // mm; sphere
    double fillet = 8;                 // mm; radius of the rounding between dome and plate
    double centre_height = -10;        // mm; z of the sphere's centre

    double foot_radius() const;    // where the rounding meets the plate
    double opening_angle() const;  // polar angle at which the dome ends
    double dome_area() const;
    double fillet_area() const;
    double plate_area() const;
};

/// A plate with a spherical dome, joined by a rounding with continuous tangent planes; all three
/// faces stored as exact B-splines. The dome and the plate are regions of umbilics.
TopoDS_Shape dome_plate(const DomePlate& measures);

/// One bicubic face of 10 x 8 poles over [0, 90] x [0, 70] mm that is exactly flat where
/// u <= 4/7 and v <= 3/5, and bends upwards beyond.
TopoDS_Shape planar_block();

}  // namespace umbilic::models
