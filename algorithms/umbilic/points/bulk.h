// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include <umbilic/core/types.h>

namespace umbilic {

/// Points farther from the median point than this many times the median distance from it are apart from the others: of
/// a sphere none is farther than 1, of a disc 1.4, of a rod 2.
inline constexpr double bulk_radii = 6.0;

/// Where most points of a cloud are. Less than half of the points, wherever they lie, hardly change it.
struct Bulk {
    Vector3 centre = Vector3::Zero();  ///< median of each coordinate
    double reach = 0.0;                ///< mm

    bool holds(const Vector3& point) const { return (point - centre).squaredNorm() <= reach * reach; }
};

/// Holds nothing but the origin if there are no points.
Bulk bulk_of(std::span<const Vector3> points);

}  // namespace umbilic
