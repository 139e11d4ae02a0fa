// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Which part of a face carries the closest point (thesis 4.2.3: interior, edges, corners).
enum class FootKind { interior, edge, corner };

struct ClosestPoint {
    SurfacePoint at;
    Vector3 point = Vector3::Zero();
    double distance = std::numeric_limits<double>::infinity();
    FootKind kind = FootKind::interior;
    /// Bounds prove that no point is closer than `distance` minus rounding. False if the search ran out of its budget
    /// of halvings: that happens where a whole curve of points is equally close and lies across the parameter lines, as
    /// from the axis of a surface that was not parametrised as one of revolution. The bounds of trimming loops that are
    /// neither parameter lines nor on planes rest on sampled second derivatives with a margin of 2.
    bool certified = false;
};

/// Bounding-volume tree over the Bezier patches and trimming loops of all faces of a model, for global closest points.
/// Build once, query from any number of threads.
class ClosestPointTree {
public:
    explicit ClosestPointTree(const Model& model);
    explicit ClosestPointTree(const NurbsSurface& surface);
    ~ClosestPointTree();
    ClosestPointTree(ClosestPointTree&&) noexcept;
    ClosestPointTree& operator=(ClosestPointTree&&) noexcept;

    /// Point of the trimmed faces that is closest to `point`, over all faces: the global minimum of the distance
    /// (thesis (4.3)). Nothing if every point is farther than `limit` (mm). `without`: number of a face that is left
    /// out, 0 for none.
    std::optional<ClosestPoint> closest(const Vector3& point, double limit = std::numeric_limits<double>::infinity(),
                                        int without = 0) const;

    /// The same for many points, in parallel; entries with distance infinity found nothing within `limit`.
    std::vector<ClosestPoint> closest(std::span<const Vector3> points,
                                      double limit = std::numeric_limits<double>::infinity()) const;

private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

}  // namespace umbilic
