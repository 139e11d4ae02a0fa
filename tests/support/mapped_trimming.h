// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>

#include <umbilic/nurbs/trimming.h>

namespace umbilic::support {

using PointMap = std::function<Vector2(const Vector2&)>;

/// The region in the parameters, over `domain`, to which `map` takes the surface parameters of `region`. An affine map
/// keeps curves that are given in surface parameters; others become straight or cubic pieces, accurate to 1e-11 of the
/// domain. `bend` is the u of a line along which the map is only continuous.
TrimmingRegion mapped(const TrimmingRegion& region, const ParameterBox& domain, const PointMap& map, bool affine,
                      std::optional<double> bend = {});

}  // namespace umbilic::support
