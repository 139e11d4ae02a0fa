// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <umbilic/core/types.h>

namespace umbilic {

/// A coarse grid over a set of points that tells at once how far a place is from all of them, at least. Most poses that
/// a search tries are wrong and put most points far from the surface: they need no look-up of the nearest sample.
class OccupiedGrid {
public:
    explicit OccupiedGrid(std::span<const Vector3> points);

    /// Not more than the distance (mm) from `point` to the nearest of the points; infinite if there are no points. Of a
    /// far point it is some six tenths of the distance at least.
    double distance_bound(const Vector3& point) const;
    /// Side of a cell, mm.
    double cell() const { return cell_; }

private:
    std::size_t index(const std::array<int, 3>& place) const {
        return (static_cast<std::size_t>(place[2]) * count_[1] + place[1]) * count_[0] + place[0];
    }

    BoundingBox box_;
    double cell_ = 0.0;
    std::array<int, 3> count_ = {0, 0, 0};
    /// Cells to the nearest occupied one, counted as a king walks.
    std::vector<std::uint8_t> cells_away_;
};

}  // namespace umbilic
