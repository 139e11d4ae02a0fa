// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>

#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// Red, green and blue in [0, 1], sRGB.
using Color = std::array<float, 3>;

/// How deviations become colours: viridis from 0 to `range` for their size, blue-white-red from -range to range for
/// signed ones. Both keep their order for people who do not see all colours.
struct ColorScale {
    double range = 1.0;      ///< mm; what lies beyond takes the outermost colour
    double largest = 0.0;    ///< mm, largest deviation that occurs
    double tolerance = 0.0;  ///< mm, marked on the legend

    Color of_size(double deviation) const;
    Color of_signed(double deviation) const;
};

/// Scale for deviations up to `largest`: its range is a round number between a tenth of the tolerance, so that noise
/// does not look like a deviation, and five times the tolerance, so that what is foreign does not hide the rest.
ColorScale color_scale(double largest, double tolerance);

/// The legend as an SVG element: gradient, ticks with unit, tolerance mark. `id` names its gradient and must be unique
/// on a page.
std::string legend_svg(const ColorScale& scale, bool is_signed, const std::string& id);

/// Colour of an umbilic of this type in pictures.
Color color_of(UmbilicType type);

/// "#rrggbb".
std::string hex(const Color& color);

}  // namespace umbilic
