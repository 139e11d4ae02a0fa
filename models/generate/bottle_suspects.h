// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <TopoDS_Shape.hxx>

#include "bottle.h"

namespace umbilic::models {

/// Every face of the bottle reparametrised exactly: other degrees, more knots, u and v swapped,
/// other parameter ranges. The same point set.
TopoDS_Shape reparametrised_bottle(const Bottle& bottle);

struct Reapproximation {
    TopoDS_Shape shape;
    double largest_distance;  // mm, measured on a dense grid, between new and old faces
};

/// Every face interpolated by a quintic with other knots.
Reapproximation reapproximated_bottle(const Bottle& bottle);

struct Piece {
    TopoDS_Shape shape;
    double share_of_front;   // its area over the area of the front
    double share_of_bottle;  // its area over the area of the whole bottle
};

/// A cut-out of the front, trimmed by a closed egg-shaped curve.
Piece bottle_piece(const Bottle& bottle);

struct Redesign {
    TopoDS_Shape shape;
    double changed_share;   // area of the spans that may differ over the area of the bottle
    double largest_change;  // mm, of the points with equal parameters
};

/// The front bulged outwards in one region; everything else is the same point set.
Redesign redesigned_bottle(const Bottle& bottle);

}  // namespace umbilic::models
