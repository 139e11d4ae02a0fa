// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <umbilic/core/types.h>

namespace umbilic {

/// Points x with |slope . x + offset| <= half_width; all points if half_width is infinite.
struct LinearBand {
    Vector2 slope = Vector2::Zero();
    double offset = 0.0;
    double half_width = 0.0;
};

/// A convex part of a box in the parameter plane, or the whole box.
struct BoxPart {
    ParameterBox box;
    std::vector<Vector2> corners;  ///< counter-clockwise; none: the whole box
};

/// The part of a box that lies in all bands, whose coordinates run from 0 to 1 over the box; none if nothing does.
std::optional<BoxPart> part_within(const ParameterBox& box, std::span<const LinearBand> bands);

/// The same part where parameters t are origin + scale t.
BoxPart mapped(const BoxPart& part, const Vector2& origin, const Vector2& scale);

/// Smallest box around the part.
ParameterBox extent(const BoxPart& part);
/// Points on the border of the part count, up to rounding.
bool contains(const BoxPart& part, double u, double v);
/// Where parts of neighbouring boxes may touch this one: the pieces it has of its box's sides, as boxes without width;
/// the box itself if that is the part.
std::vector<ParameterBox> contacts(const BoxPart& part);

}  // namespace umbilic
