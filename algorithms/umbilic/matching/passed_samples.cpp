// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/passed_samples.h>

#include <cmath>
#include <limits>

#include <oneapi/tbb/parallel_for.h>

#include <umbilic/matching/table_ground.h>

namespace umbilic {

namespace {

PassedSample by_jets(const TableGround& ground, const Curvature& at, const SimilarityTransform& original_suspect,
                     const SimilarityTransform& suspect_original) {
    const GroundFoot foot = *ground.foot(suspect_original.apply(at.point), std::numeric_limits<double>::infinity());
    PassedSample passed{.distance = original_suspect.scale * foot.distance, .past_border = foot.at_border};
    passed.signed_distance =
        std::copysign(passed.distance, (original_suspect.apply(foot.point) - at.point).dot(at.normal));
    return passed;
}

/// Height of the original's osculating paraboloid over its tangent plane: kappa = -II / I. A plane where it has none.
double paraboloid(const Curvature& at, const Vector3& offset) {
    if (!at.regular) return 0.0;
    const double x = offset.dot(at.direction_max), y = offset.dot(at.direction_min);
    return -0.5 * (at.kappa_max * x * x + at.kappa_min * y * y);
}

PassedSample by_triangles(const TriangleTree& triangles, const PointCloud& mesh, const Curvature& at,
                          const SimilarityTransform& original_suspect, const SimilarityTransform& suspect_original) {
    const TriangleFoot foot = triangles.closest(suspect_original.apply(at.point));
    const Vector3 nearest = original_suspect.apply(foot.point) - at.point;
    const Vector3 normal = at.regular || foot.distance == 0.0 ? at.normal : Vector3(nearest.normalized());
    PassedSample passed;
    double rise = 0.0;
    for (int k = 0; k < 3; ++k) {
        const Vector3 corner = original_suspect.apply(mesh.points[mesh.triangles[foot.triangle][k]]) - at.point;
        rise += foot.weights[k] * paraboloid(at, corner);
    }
    const double height = nearest.dot(normal) - rise;
    passed.chord = std::abs(rise);
    // Beyond the border the way along the surface counts too.
    const double beyond = foot.at_border ? (nearest - nearest.dot(normal) * normal).norm() : 0.0;
    passed.distance = std::hypot(height, beyond);
    passed.signed_distance = std::copysign(passed.distance, height);
    return passed;
}

}  // namespace

std::vector<PassedSample> passed_samples(const std::vector<AreaSample>& original, const PreparedPoints& suspect,
                                         const SimilarityTransform& original_suspect) {
    const TableGround ground(suspect.table);
    const SimilarityTransform suspect_original = original_suspect.inverse();
    std::vector<PassedSample> passed(original.size());
    tbb::parallel_for(std::size_t{0}, passed.size(), [&](std::size_t i) {
        const Curvature& at = original[i].curvature;
        passed[i] = suspect.triangles
                        ? by_triangles(*suspect.triangles, suspect.cloud, at, original_suspect, suspect_original)
                        : by_jets(ground, at, original_suspect, suspect_original);
    });
    return passed;
}

}  // namespace umbilic
