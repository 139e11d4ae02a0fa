// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <TopoDS_Shape.hxx>

#include "surfaces.h"

namespace umbilic::models {

/// The faces of a bottle in the order in which they are stored: front, back, front and back of the neck.
/// Front and back are bicubic with 8 x 8 poles and meet with a common tangent plane; the neck is
/// ruled. Bottom and mouth are open.
struct Bottle {
    BSpline front, back, neck_front, neck_back;

    std::vector<BSpline> faces() const { return {front, back, neck_front, neck_back}; }
};

/// A shampoo bottle, 83 x 54 x 204 mm, without symmetry; its front has three star umbilics.
Bottle bottle();

/// Another design: slimmer, taller, pear-shaped.
Bottle other_bottle();

/// Sewn into an open shell.
TopoDS_Shape shell_of(const Bottle& bottle);

}  // namespace umbilic::models
