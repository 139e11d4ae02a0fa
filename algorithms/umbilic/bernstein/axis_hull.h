// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>

#include <umbilic/bernstein/interval.h>

namespace umbilic {

/// Part of the axis y = 0 that lies in the convex hull of the vertical segments columns[i] at x = i / (n - 1), n the
/// number of columns, rounded outward to within [0, 1]; nothing if the hull misses the axis. With the range of the
/// control points of a Bernstein polynomial of degree n - 1 as columns, all its zeros lie there (thesis 3.8.2). A
/// single column that holds 0 gives [0, 1].
std::optional<Interval> axis_hull(std::span<const Interval> columns);

}  // namespace umbilic
