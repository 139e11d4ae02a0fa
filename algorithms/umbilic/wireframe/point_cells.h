// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include <umbilic/core/types.h>

namespace umbilic {

/// Entries at points in space, by cubic cells.
template <class Entry>
class PointCells {
public:
    explicit PointCells(double cell) : cell_(cell) {}

    void add(const Vector3& point, Entry entry) { cells_[key(index(point))].push_back(std::move(entry)); }

    /// Visits all entries within `radius` of a point, and others near it.
    template <class Visit>
    void near(const Vector3& point, double radius, const Visit& visit) const {
        const Vector3 reach = Vector3::Constant(radius);
        const Index low = index(point - reach), high = index(point + reach);
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    const auto found = cells_.find(key({x, y, z}));
                    if (found == cells_.end()) continue;
                    for (const Entry& entry : found->second) visit(entry);
                }
    }

private:
    using Index = std::array<std::int64_t, 3>;

    Index index(const Vector3& p) const {
        return {static_cast<std::int64_t>(std::floor(p.x() / cell_)),
                static_cast<std::int64_t>(std::floor(p.y() / cell_)),
                static_cast<std::int64_t>(std::floor(p.z() / cell_))};
    }
    /// Cells that share a key are only visited in vain.
    static std::uint64_t key(const Index& i) {
        return (static_cast<std::uint64_t>(i[0]) * 0x9e3779b97f4a7c15) ^
               (static_cast<std::uint64_t>(i[1]) * 0xbf58476d1ce4e5b9) ^
               (static_cast<std::uint64_t>(i[2]) * 0x94d049bb133111eb);
    }

    double cell_;
    std::unordered_map<std::uint64_t, std::vector<Entry>> cells_;
};

}  // namespace umbilic
