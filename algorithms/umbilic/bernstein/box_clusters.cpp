// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/box_clusters.h>

#include <algorithm>
#include <numeric>

#include <umbilic/core/disjoint_sets.h>

namespace umbilic {

BoxClusters cluster_boxes(std::span<const Interval> boxes, int dimension, double gap) {
    const int count = static_cast<int>(boxes.size()) / dimension;
    const auto side = [&](int box, int k) { return boxes[box * dimension + k]; };

    // Sweep along the direction in which fewest neighbours overlap: the one with the least mean side to its extent.
    int along = 0;
    double least = 2.0;
    for (int k = 0; k < dimension && count > 0; ++k) {
        Interval extent = side(0, k);
        double sides = 0.0;
        for (int box = 0; box < count; ++box) {
            extent = hull(extent, side(box, k));
            sides += side(box, k).high - side(box, k).low;
        }
        const double length = extent.high - extent.low;
        const double share = length > 0.0 ? sides / count / length : 1.0;
        if (share < least) {
            least = share;
            along = k;
        }
    }
    std::vector<int> order(count);
    DisjointSets sets(count);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        return side(a, along).low != side(b, along).low ? side(a, along).low < side(b, along).low : a < b;
    });
    std::vector<int> active;
    for (const int box : order) {
        std::erase_if(active, [&](int other) { return side(other, along).high + gap < side(box, along).low; });
        for (const int other : active) {
            bool touch = true;
            for (int k = 0; k < dimension && touch; ++k)
                touch = side(other, k).low <= side(box, k).high + gap && side(box, k).low <= side(other, k).high + gap;
            if (touch) sets.unite(other, box);
        }
        active.push_back(box);
    }

    BoxClusters result;
    std::vector<int> number(count, -1);
    for (int box = 0; box < count; ++box) {
        int& of_root = number[sets.find(box)];
        if (of_root < 0) of_root = result.count++;
        result.cluster.push_back(of_root);
    }
    return result;
}

}  // namespace umbilic
