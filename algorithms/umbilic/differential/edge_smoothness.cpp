// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/differential/edge_smoothness.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

namespace {

/// Samples lie in the middle of equal parts of the first use's parameter range: ends may be singular.
constexpr int sample_count = 9;

/// One face at a point of the edge.
struct FaceAtEdge {
    Vector3 inward;  ///< unit tangent of the face, normal to the edge, into the face
    Vector3 normal;
    double curvature;  ///< normal curvature in that direction, -II / I
};

std::optional<FaceAtEdge> face_at(const Borders& borders, const BorderPoint& at, bool face_on_left) {
    const SurfaceDerivatives d = borders.face(at.face).surface.derivatives(at.parameters.x(), at.parameters.y(), 2);
    if (!regular(d) || !(at.tangent.norm() > 0.0)) return std::nullopt;
    FaceAtEdge side;
    side.normal = unit_normal(d);
    side.inward = (face_on_left ? 1.0 : -1.0) * side.normal.cross(at.tangent).normalized();
    // The direction as du : dv, from its scalar products with r_u and r_v.
    const auto [E, F, G] = first_form(d);
    const double a = side.inward.dot(d.r_u()), b = side.inward.dot(d.r_v());
    side.curvature = normal_curvature(d, G * a - F * b, E * b - F * a);
    return side;
}

}  // namespace

EdgeSmoothness edge_smoothness(const FaceAdjacency& adjacency, const Edge& edge) {
    EdgeSmoothness result;
    if (edge.uses.size() != 2) return result;
    const Borders& borders = adjacency.borders;
    const BorderPiece& piece = edge.uses[0].piece;
    const Face& face = borders.face(piece.face);
    for (int i = 0; i < sample_count; ++i) {
        const double t = piece.range.low + piece.range.length() * (i + 0.5) / sample_count;
        const BoundaryPoint b = boundary_point(face.surface, face.region, borders.curve(piece), t);
        const BorderPoint from{piece.face, piece.loop, piece.curve, t, b.parameters, b.r, b.r_t, 0.0};
        for (const EdgeCrossing& crossing : across(adjacency, from)) {
            const std::optional<FaceAtEdge> here = face_at(borders, crossing.from, crossing.from_on_left);
            const std::optional<FaceAtEdge> there = face_at(borders, crossing.to, crossing.to_on_left);
            if (!here || !there) continue;
            ++result.samples;
            const Vector3 onward = -there->inward;
            result.bend =
                std::max(result.bend, std::atan2(here->inward.cross(onward).norm(), here->inward.dot(onward)));
            const double sign = here->normal.dot(there->normal) >= 0.0 ? 1.0 : -1.0;
            result.curvature_jump =
                std::max(result.curvature_jump, std::abs(here->curvature - sign * there->curvature));
            result.curvature = std::max({result.curvature, std::abs(here->curvature), std::abs(there->curvature)});
        }
    }
    return result;
}

std::vector<EdgeSmoothness> edge_smoothness(const FaceAdjacency& adjacency, const Progress& progress) {
    std::vector<EdgeSmoothness> result(adjacency.edges.size());
    tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t i) {
        progress.check();
        result[i] = edge_smoothness(adjacency, adjacency.edges[i]);
    });
    return result;
}

}  // namespace umbilic
