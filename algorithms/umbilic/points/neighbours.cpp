// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/points/neighbours.h>

#include <algorithm>
#include <utility>

#include <nanoflann.hpp>

namespace umbilic {

namespace {

/// The point set as nanoflann asks for it.
struct Positions {
    std::span<const Vector3> points;

    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][axis]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Positions>, Positions, 3>;

bool nearer(const Neighbour& a, const Neighbour& b) {
    return a.squared_distance < b.squared_distance || (a.squared_distance == b.squared_distance && a.index < b.index);
}

}  // namespace

struct Neighbours::Tree {
    explicit Tree(std::span<const Vector3> points) : positions{points}, index(3, positions, {10}) {}

    Positions positions;
    Index index;
};

Neighbours::Neighbours(std::span<const Vector3> points) : tree_(std::make_unique<const Tree>(points)) {}
Neighbours::~Neighbours() = default;
Neighbours::Neighbours(Neighbours&&) noexcept = default;

std::vector<Neighbour> Neighbours::nearest(const Vector3& point, int count) const {
    std::vector<unsigned> indices(count);
    std::vector<double> squared(count);
    nanoflann::KNNResultSet<double, unsigned> found(count);
    found.init(indices.data(), squared.data());
    tree_->index.findNeighbors(found, point.data(), {});
    std::vector<Neighbour> result(found.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = {static_cast<int>(indices[i]), squared[i]};
    std::sort(result.begin(), result.end(), nearer);
    return result;
}

std::vector<Neighbour> Neighbours::within(const Vector3& point, double radius) const {
    std::vector<std::pair<unsigned, double>> found;
    tree_->index.radiusSearch(point.data(), radius * radius, found, nanoflann::SearchParams(32, 0.0f, false));
    std::vector<Neighbour> result;
    result.reserve(found.size());
    for (const auto& [index, squared] : found) result.push_back({static_cast<int>(index), squared});
    std::sort(result.begin(), result.end(), nearer);
    return result;
}

}  // namespace umbilic
