// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>

#include <umbilic/model/point_cloud.h>

namespace umbilic {

/// Where a point comes to lie on a mesh.
struct TriangleFoot {
    int triangle = 0;               ///< index into PointCloud::triangles
    std::array<double, 3> weights;  ///< barycentric coordinates in it, at least 0, sum 1
    Vector3 point = Vector3::Zero();
    double distance = 0.0;   ///< mm
    bool at_border = false;  ///< on an edge that belongs to one triangle only, or at an end of such an edge
};

/// Bounding-volume tree over the triangles of a mesh, which must stay where it is. Build once, query from any number of
/// threads.
class TriangleTree {
public:
    /// Throws InvalidInput if the cloud has no triangles.
    explicit TriangleTree(const PointCloud& mesh);
    ~TriangleTree();
    TriangleTree(TriangleTree&&) noexcept;

    /// Closest point of all triangles; of triangles equally near the first.
    TriangleFoot closest(const Vector3& point) const;

private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

}  // namespace umbilic
