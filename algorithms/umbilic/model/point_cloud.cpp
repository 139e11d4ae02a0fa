// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/model/point_cloud.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <Eigen/Geometry>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

constexpr int dropped = -1;

bool before(const Vector3& a, const Vector3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

void normalise_normals(PointCloud& cloud) {
    for (Vector3& normal : cloud.normals) {
        const double length = normal.norm();
        if (!(std::isfinite(length) && length > 0.0)) {
            cloud.warnings.emplace_back("the normals are left out: one of them is zero or not finite");
            cloud.normals.clear();
            return;
        }
        normal /= length;
    }
}

}  // namespace

BoundingBox PointCloud::box() const {
    BoundingBox box;
    for (const Vector3& point : points) box.add(point);
    return box;
}

double triangle_area(const PointCloud& cloud, const std::array<int, 3>& triangle) {
    const Vector3& a = cloud.points[triangle[0]];
    return 0.5 * (cloud.points[triangle[1]] - a).cross(cloud.points[triangle[2]] - a).norm();
}

std::vector<Vector3> outward_normals(const PointCloud& cloud) {
    if (!cloud.normals.empty() || !cloud.is_mesh()) return cloud.normals;
    std::vector<Vector3> normals(cloud.points.size(), Vector3::Zero());
    for (const auto& [a, b, c] : cloud.triangles) {
        const Vector3 normal = (cloud.points[b] - cloud.points[a]).cross(cloud.points[c] - cloud.points[a]);
        for (const int corner : {a, b, c}) normals[corner] += normal;
    }
    return normals;
}

void thin_out(PointCloud& cloud, std::size_t most, std::uint64_t seed) {
    const std::size_t count = cloud.points.size();
    if (count <= most) return;
    std::vector<Vector3> normals = outward_normals(cloud);
    std::vector<std::size_t> candidates;
    for (std::size_t i = 0; i < count; ++i)
        if (normals.empty() || !normals[i].isZero(0.0)) candidates.push_back(i);
    // The first steps of a shuffle.
    std::mt19937_64 random(seed);
    const std::size_t kept = std::min(most, candidates.size());
    for (std::size_t k = 0; k < kept; ++k) std::swap(candidates[k], candidates[k + random() % (candidates.size() - k)]);
    candidates.resize(kept);
    std::sort(candidates.begin(), candidates.end());
    for (std::size_t k = 0; k < kept; ++k) {
        cloud.points[k] = cloud.points[candidates[k]];
        if (!normals.empty()) normals[k] = normals[candidates[k]].normalized();
    }
    cloud.points.resize(kept);
    if (!normals.empty()) normals.resize(kept);
    cloud.warnings.push_back("of its " + std::to_string(count) + " points " + std::to_string(kept) +
                             ", chosen at random, are used" +
                             (cloud.is_mesh() ? ", with the normals of its triangles" : ""));
    cloud.normals = std::move(normals);
    cloud.triangles.clear();
    cloud.thinned_out += count - kept;
}

void clean(PointCloud& cloud) {
    const std::size_t count = cloud.points.size();
    if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw InvalidInput(cloud.source.path + ": holds more than 2^31 points; thin it out first");
    if (!cloud.normals.empty() && cloud.normals.size() != count)
        throw InvalidInput(cloud.source.path + ": holds " + std::to_string(count) + " points but " +
                           std::to_string(cloud.normals.size()) + " normals");
    for (const auto& triangle : cloud.triangles)
        for (const int corner : triangle)
            if (corner < 0 || corner >= static_cast<int>(count))
                throw InvalidInput(cloud.source.path + ": a triangle refers to point " + std::to_string(corner) +
                                   " of " + std::to_string(count) + " (from 0); the file is damaged");

    // Equal points stand beside each other in this order, the earliest of the file first.
    std::vector<int> order;
    order.reserve(count);
    std::vector<int> first(count, dropped);
    for (std::size_t i = 0; i < count; ++i)
        if (cloud.points[i].allFinite()) order.push_back(static_cast<int>(i));
    cloud.not_finite += count - order.size();
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return before(cloud.points[a], cloud.points[b]); });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool repeats = k > 0 && cloud.points[order[k]] == cloud.points[order[k - 1]];
        first[order[k]] = repeats ? first[order[k - 1]] : order[k];
        if (repeats) ++cloud.merged;
    }

    std::vector<int> place(count, dropped);
    int kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (first[i] != static_cast<int>(i)) continue;
        place[i] = kept;
        cloud.points[kept] = cloud.points[i];
        if (!cloud.normals.empty()) cloud.normals[kept] = cloud.normals[i];
        ++kept;
    }
    cloud.points.resize(kept);
    if (!cloud.normals.empty()) cloud.normals.resize(kept);

    std::size_t kept_triangles = 0;
    for (std::array<int, 3> triangle : cloud.triangles) {
        for (int& corner : triangle) corner = first[corner] == dropped ? dropped : place[first[corner]];
        const auto& [a, b, c] = triangle;
        if (a == dropped || b == dropped || c == dropped || a == b || b == c || c == a)
            ++cloud.degenerate_triangles;
        else
            cloud.triangles[kept_triangles++] = triangle;
    }
    cloud.triangles.resize(kept_triangles);
    normalise_normals(cloud);
}

}  // namespace umbilic
