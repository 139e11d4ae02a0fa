// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/points/bulk.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace umbilic {

namespace {

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

Bulk bulk_of(std::span<const Vector3> points) {
    Bulk bulk;
    if (points.empty()) return bulk;
    std::vector<double> values(points.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(points.begin(), points.end(), values.begin(), [&](const Vector3& p) { return p[axis]; });
        bulk.centre[axis] = median(values);
    }
    std::transform(points.begin(), points.end(), values.begin(),
                   [&](const Vector3& p) { return (p - bulk.centre).norm(); });
    bulk.reach = bulk_radii * median(values);
    return bulk;
}

}  // namespace umbilic
