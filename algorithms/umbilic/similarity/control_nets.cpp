// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/control_nets.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <umbilic/similarity/thresholds.h>

namespace umbilic {

namespace {

bool free_form(const Face& face) {
    return face.kind == SurfaceKind::bezier || face.kind == SurfaceKind::bspline;
}

bool by_x(const Vector3& a, const Vector3& b) {
    return a.x() < b.x();
}

/// True if every point has one of `sorted` (by x) within the tolerance.
bool all_near(const std::vector<Vector3>& points, const std::vector<Vector3>& sorted, double tolerance) {
    return std::ranges::all_of(points, [&](const Vector3& p) {
        const Vector3 low = p - Vector3::Constant(tolerance);
        for (auto at = std::ranges::lower_bound(sorted, low, by_x); at != sorted.end() && at->x() <= p.x() + tolerance;
             ++at)
            if ((*at - p).norm() <= tolerance) return true;
        return false;
    });
}

bool same_net(const NurbsSurface& a, const NurbsSurface& b, const SimilarityTransform& a_b, double tolerance) {
    if (std::minmax(a.u_degree(), a.v_degree()) != std::minmax(b.u_degree(), b.v_degree())) return false;
    if (std::minmax(a.u_pole_count(), a.v_pole_count()) != std::minmax(b.u_pole_count(), b.v_pole_count()))
        return false;
    std::vector<Vector3> poles = a.poles();
    std::vector<Vector3> moved;
    for (const Vector3& pole : b.poles()) moved.push_back(a_b.apply(pole));
    std::ranges::sort(poles, by_x);
    std::ranges::sort(moved, by_x);
    return all_near(moved, poles, tolerance) && all_near(poles, moved, tolerance);
}

}  // namespace

ControlNets compare_control_nets(const Model& original, const Model& suspect,
                                 const SimilarityTransform& original_suspect, std::span<const FaceCoverage> faces,
                                 double tolerance) {
    ControlNets result = ControlNets::none;
    for (const FaceCoverage& coverage : faces) {
        if (coverage.original_face == 0 || coverage.fraction < whole_share) continue;
        const Face& b = suspect.face(coverage.suspect_face);
        const Face& a = original.face(coverage.original_face);
        if (!free_form(a) || !free_form(b)) continue;
        if (!same_net(a.surface, b.surface, original_suspect, tolerance)) return ControlNets::different;
        result = ControlNets::same;
    }
    return result;
}

}  // namespace umbilic
