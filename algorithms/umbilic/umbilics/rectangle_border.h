// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/core/types.h>

namespace umbilic {

/// A directed straight piece of a border, parallel to an axis.
struct BorderSide {
    Vector2 from = Vector2::Zero();
    Vector2 to = Vector2::Zero();
};

/// Border of what the rectangles `kept` cover and the rectangles `removed` do not, with that on its left: outer borders
/// run counter-clockwise, those of holes clockwise. Rectangles may overlap; of a corner at which two pieces touch both
/// keep their own. The sides are in no order that closes them: they are for sums along the border.
std::vector<BorderSide> border_of_difference(std::span<const ParameterBox> kept, std::span<const ParameterBox> removed);

}  // namespace umbilic
