// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <umbilic/core/types.h>

namespace umbilic {

/// A point of the set near a query.
struct Neighbour {
    int index = 0;
    double squared_distance = 0.0;  ///< mm^2
};

/// kd-tree over points, which must stay where they are. Build once, query from any number of threads.
class Neighbours {
public:
    explicit Neighbours(std::span<const Vector3> points);
    ~Neighbours();
    Neighbours(Neighbours&&) noexcept;

    /// The `count` nearest points (fewer if there are no more), nearest first.
    std::vector<Neighbour> nearest(const Vector3& point, int count) const;
    /// All points within `radius` (mm), nearest first, equal distances by index.
    std::vector<Neighbour> within(const Vector3& point, double radius) const;

private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

}  // namespace umbilic
