// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/occupied_grid.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace umbilic {

namespace {

/// Cells along the longest side of the box. Finer ones bound better and cost more, with their third power.
constexpr int cells_along = 40;

}  // namespace

OccupiedGrid::OccupiedGrid(std::span<const Vector3> points) {
    for (const Vector3& point : points) box_.add(point);
    if (box_.empty()) return;
    const Vector3 sides = box_.high - box_.low;
    // Points that are all one need a cell of any size.
    cell_ = sides.maxCoeff() > 0.0 ? sides.maxCoeff() / cells_along : 1.0;
    for (int axis = 0; axis < 3; ++axis) count_[axis] = static_cast<int>(sides[axis] / cell_) + 1;
    constexpr std::uint8_t farthest = std::numeric_limits<std::uint8_t>::max();
    cells_away_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], farthest);
    for (const Vector3& point : points) {
        std::array<int, 3> place;
        for (int axis = 0; axis < 3; ++axis)
            place[axis] = std::min(static_cast<int>((point[axis] - box_.low[axis]) / cell_), count_[axis] - 1);
        cells_away_[index(place)] = 0;
    }
    // Distances as a king walks, by one pass forth and one back over the half of the neighbours already seen.
    const auto pass = [&](int direction) {
        const auto along = [&](int axis, int i) { return direction > 0 ? i : count_[axis] - 1 - i; };
        for (int k = 0; k < count_[2]; ++k)
            for (int j = 0; j < count_[1]; ++j)
                for (int i = 0; i < count_[0]; ++i) {
                    const std::array<int, 3> place = {along(0, i), along(1, j), along(2, k)};
                    int away = cells_away_[index(place)];
                    for (int n = 0; n < 13; ++n) {
                        const std::array<int, 3> other = {place[0] + direction * (n % 3 - 1),
                                                          place[1] + direction * (n / 3 % 3 - 1),
                                                          place[2] + direction * (n / 9 - 1)};
                        bool inside = true;
                        for (int axis = 0; axis < 3; ++axis)
                            inside = inside && other[axis] >= 0 && other[axis] < count_[axis];
                        if (inside) away = std::min(away, cells_away_[index(other)] + 1);
                    }
                    cells_away_[index(place)] = static_cast<std::uint8_t>(std::min<int>(away, farthest));
                }
    };
    pass(1);
    pass(-1);
}

double OccupiedGrid::distance_bound(const Vector3& point) const {
    if (box_.empty()) return std::numeric_limits<double>::infinity();
    const Vector3 in_box = point.cwiseMax(box_.low).cwiseMin(box_.high);
    std::array<int, 3> place;
    for (int axis = 0; axis < 3; ++axis)
        place[axis] = std::min(static_cast<int>((in_box[axis] - box_.low[axis]) / cell_), count_[axis] - 1);
    // The box is convex and holds all points: from the point of the box nearest to `point` none is farther.
    const double within = std::max(0, cells_away_[index(place)] - 1) * cell_;
    return std::hypot((point - in_box).norm(), within);
}

}  // namespace umbilic
