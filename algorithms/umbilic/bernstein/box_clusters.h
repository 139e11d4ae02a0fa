// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/bernstein/interval.h>

namespace umbilic {

struct BoxClusters {
    std::vector<int> cluster;  ///< of each box; numbered from 0 in the order of their first boxes
    int count = 0;
};

/// Joins boxes of one dimension, `dimension` intervals each, box after box, that touch or are at most `gap` apart in
/// every direction.
BoxClusters cluster_boxes(std::span<const Interval> boxes, int dimension, double gap);

}  // namespace umbilic
