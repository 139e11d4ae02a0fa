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

/// A difference of principal curvatures below this share of the curvatures themselves is rounding: it has no
/// direction.
constexpr double least_anisotropy = 1e-9;

/// One face at a point of the edge.
struct FaceAtEdge {
    Vector3 inward;  ///< unit tangent of the face, normal to the edge, into the face
    Vector3 normal;
    double curvature;  ///< normal curvature in that direction, -II / I
    double along;      ///< normal curvature along the edge
    double twist;      ///< -II(inward, along): the mixed part
};

/// `inward_on_left` of the direction `along`, seen from the normal's side.
std::optional<FaceAtEdge> face_at(const SurfaceDerivatives& d, const Vector3& along, bool inward_on_left) {
    if (!regular(d) || !(along.norm() > 0.0)) return std::nullopt;
    FaceAtEdge side;
    side.normal = unit_normal(d);
    const Vector3 tangent = (along - along.dot(side.normal) * side.normal).normalized();
    side.inward = (inward_on_left ? 1.0 : -1.0) * side.normal.cross(tangent);
    const auto [E, F, G] = first_form(d);
    const auto [L, M, N] = second_form(d);
    // A tangent vector as du : dv, from its scalar products with r_u and r_v.
    const auto parameters = [&](const Vector3& w) {
        const double a = w.dot(d.r_u()), b = w.dot(d.r_v());
        return Vector2(Vector2(G * a - F * b, E * b - F * a) / (E * G - F * F));
    };
    const Vector2 p = parameters(side.inward), q = parameters(tangent);
    const auto bent = [&](const Vector2& a, const Vector2& b) {
        return -(L * a.x() * b.x() + M * (a.x() * b.y() + a.y() * b.x()) + N * a.y() * b.y());
    };
    side.curvature = bent(p, p);
    side.along = bent(q, q);
    side.twist = bent(p, q);
    return side;
}

/// Adds a point at which both faces are known; `there` goes along the edge in the same direction as `here` where
/// `same_direction`.
void compare(const FaceAtEdge& here, const FaceAtEdge& there, bool same_direction, EdgeSmoothness& result) {
    ++result.samples;
    const Vector3 onward = -there.inward;
    result.bend = std::max(result.bend, std::atan2(here.inward.cross(onward).norm(), here.inward.dot(onward)));
    const double sign = here.normal.dot(there.normal) >= 0.0 ? 1.0 : -1.0;
    result.curvature_jump = std::max(result.curvature_jump, std::abs(here.curvature - sign * there.curvature));
    result.curvature = std::max({result.curvature, std::abs(here.curvature), std::abs(there.curvature)});
    // Twice the angle of the direction of greatest curvature in the frame of `here`.
    const Vector2 from(here.curvature - here.along, 2 * here.twist);
    const Vector2 to = sign * Vector2(there.curvature - there.along, (same_direction ? -2 : 2) * there.twist);
    const auto told = [](const Vector2& difference, const FaceAtEdge& side) {
        return difference.norm() > least_anisotropy * (std::abs(side.curvature) + std::abs(side.along));
    };
    if (!told(from, here) || !told(to, there)) return;
    const double turn = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
    result.direction_jump = std::max(result.direction_jump, 0.5 * std::abs(turn));
}

std::optional<FaceAtEdge> face_at(const Borders& borders, const BorderPoint& at, bool face_on_left) {
    return face_at(borders.face(at.face).surface.derivatives(at.parameters.x(), at.parameters.y(), 2), at.tangent,
                   face_on_left);
}

/// Breaks across which the parametrisation is less than twice continuously differentiable.
std::vector<int> low_breaks(const KnotVector& knots) {
    std::vector<int> result;
    for (int k = 1; k + 1 < static_cast<int>(knots.breaks().size()); ++k)
        if (knots.continuity(k) < 2) result.push_back(k);
    return result;
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
            compare(*here, *there, crossing.same_direction, result);
        }
    }
    return result;
}

EdgeSmoothness knot_smoothness(const Face& face) {
    EdgeSmoothness result;
    const NurbsSurface& surface = face.surface;
    const auto follow = [&](bool across_u) {
        const KnotVector &knots = across_u ? surface.u_knots() : surface.v_knots(),
                         &others = across_u ? surface.v_knots() : surface.u_knots();
        for (const int k : low_breaks(knots))
            for (std::size_t piece = 0; piece + 1 < others.breaks().size(); ++piece)
                for (int i = 0; i < sample_count; ++i) {
                    const double low = others.breaks()[piece], high = others.breaks()[piece + 1];
                    const double at = low + (high - low) * (i + 0.5) / sample_count, knot = knots.breaks()[k];
                    const double u = across_u ? knot : at, v = across_u ? at : knot;
                    if (!face.region.whole_domain() && face.region.classify(u, v) != Containment::inside) continue;
                    const auto side = [&](Side which) {
                        const SurfaceDerivatives d = surface.derivatives(u, v, 2, across_u ? which : Side::right,
                                                                         across_u ? Side::right : which);
                        // Smaller u lies on the left of growing v, smaller v on the right of growing u.
                        return face_at(d, across_u ? d.r_v() : d.r_u(), across_u == (which == Side::left));
                    };
                    const std::optional<FaceAtEdge> before = side(Side::left), after = side(Side::right);
                    if (before && after) compare(*before, *after, true, result);
                }
    };
    follow(true);
    follow(false);
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
