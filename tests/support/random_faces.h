// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/nurbs/nurbs_surface.h>

namespace umbilic::support {

struct RandomFace {
    NurbsSurface surface;
    std::string description;  ///< degrees, poles, kind of knots, weights
};

/// A face of degrees 2 to 7, polynomial or rational (weight ratio up to 10), with even, uneven, double, fully multiple
/// or unclamped knots, heights smooth or independent, control points off the grid in all directions, turned, moved and
/// scaled by 0.01 to 1000.
RandomFace random_face(unsigned seed);

/// Graph of degree (7, 7) over [-1, 1]^2 that has umbilics with horizontal tangent planes at the given places and is
/// random otherwise.
NurbsSurface with_planted_umbilics(const std::vector<Vector2>& places, unsigned seed);

}  // namespace umbilic::support
