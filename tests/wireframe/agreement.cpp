// SPDX-License-Identifier: LGPL-2.1-or-later
#include <wireframe/agreement.h>

#include <algorithm>
#include <limits>
#include <map>

#include <Eigen/Geometry>

#include <umbilic/curves/closest_point.h>
#include <umbilic/wireframe/point_cells.h>

namespace umbilic::test {

namespace {

/// How far (relative to the step) a symmetry may carry a point of the face from it.
constexpr double on_face = 1e-3;
/// Edges whose lengths differ by less than this share of the step may correspond.
constexpr double same_length = 1e-3;
/// So many edges are tried, those first that have the fewest of their length.
constexpr std::size_t tried_edges = 6;

struct Isometry {
    Matrix3 turn = Matrix3::Identity();
    Vector3 shift = Vector3::Zero();
    Vector3 operator()(const Vector3& p) const { return turn * p + shift; }
};

/// Nodes by place.
class Nodes {
public:
    Nodes(const FaceWireframe& wireframe, double step) : step_(step), cells_(step) {
        for (const WireNode& node : wireframe.nodes) cells_.add(node.curvature.point, node.curvature.point);
    }
    /// Distance to the nearest one, relative to the step, if it is below `same_node`; else infinity.
    double nearest(const Vector3& p) const {
        double result = std::numeric_limits<double>::infinity();
        cells_.near(p, same_node * step_, [&](const Vector3& node) { result = std::min(result, (node - p).norm()); });
        return result <= same_node * step_ ? result / step_ : std::numeric_limits<double>::infinity();
    }

private:
    double step_;
    PointCells<Vector3> cells_;
};

/// Nodes of `wireframe`, moved, without counterpart; stops after more than `most`.
void count(Agreement& agreement, const FaceWireframe& wireframe, const Isometry& move, const Nodes& others, int most) {
    for (const WireNode& node : wireframe.nodes) {
        const double distance = others.nearest(move(node.curvature.point));
        if (distance <= same_node)
            agreement.farthest = std::max(agreement.farthest, distance);
        else if (++agreement.unmatched > most)
            return;
    }
}

/// Right-handed frame of an edge: along it, across, along the normal at its first node.
std::optional<Matrix3> edge_frame(const FaceWireframe& wireframe, int from, int to) {
    const WireNode &a = wireframe.nodes[from], &b = wireframe.nodes[to];
    if (!a.curvature.regular) return std::nullopt;
    const Vector3 normal = a.curvature.normal;
    const Vector3 chord = b.curvature.point - a.curvature.point;
    const Vector3 along = (chord - chord.dot(normal) * normal).normalized();
    Matrix3 frame;
    frame << along, normal.cross(along), normal;
    return frame.allFinite() ? std::optional(frame) : std::nullopt;
}

double chord(const FaceWireframe& wireframe, const WireEdge& edge) {
    return (wireframe.nodes[edge.to].curvature.point - wireframe.nodes[edge.from].curvature.point).norm();
}

bool keeps_face(const ClosestPointTree& tree, const FaceWireframe& wireframe, const Isometry& move, double step) {
    return std::all_of(wireframe.edges.begin(), wireframe.edges.end(), [&](const WireEdge& edge) {
        return std::all_of(edge.between.begin(), edge.between.end(),
                           [&](const Vector3& p) { return tree.closest(move(p), on_face * step).has_value(); });
    });
}

}  // namespace

FaceWireframe moved(FaceWireframe wireframe, const SimilarityTransform& space) {
    for (WireNode& node : wireframe.nodes) {
        node.curvature.point = space.apply(node.curvature.point);
        node.curvature.normal = space.apply_direction(node.curvature.normal);
    }
    for (WireEdge& edge : wireframe.edges)
        for (Vector3& p : edge.between) p = space.apply(p);
    return wireframe;
}

Agreement agreement(const FaceWireframe& one, const FaceWireframe& other, double step) {
    Agreement result;
    result.nodes = static_cast<int>(one.nodes.size() + other.nodes.size());
    count(result, one, {}, Nodes(other, step), result.nodes);
    count(result, other, {}, Nodes(one, step), result.nodes);
    return result;
}

Agreement agreement_up_to_symmetry(const Face& face, const FaceWireframe& one, const FaceWireframe& other,
                                   double step) {
    Agreement best = agreement(one, other, step);
    const auto alike = [&](double length) {
        std::vector<std::pair<int, int>> edges;
        for (const WireEdge& edge : other.edges)
            if (std::abs(chord(other, edge) - length) < same_length * step) {
                edges.emplace_back(edge.from, edge.to);
                edges.emplace_back(edge.to, edge.from);
            }
        return edges;
    };
    std::vector<std::pair<std::size_t, const WireEdge*>> edges;
    for (const WireEdge& edge : one.edges) {
        const double length = chord(one, edge);
        // Short edges turn the frame too much.
        if (length < 0.5 * step || !edge_frame(one, edge.from, edge.to)) continue;
        const std::size_t number = alike(length).size();
        if (number > 0) edges.emplace_back(number, &edge);
    }
    std::stable_sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    if (edges.size() > tried_edges) edges.resize(tried_edges);
    const Nodes nodes_of_one(one, step), nodes_of_other(other, step);
    Model of_face;
    of_face.faces = {face};
    const ClosestPointTree tree(of_face);
    for (const auto& [number, edge] : edges) {
        const Matrix3 frame = *edge_frame(one, edge->from, edge->to);
        const Vector3 origin = one.nodes[edge->from].curvature.point;
        for (const auto& [from, to] : alike(chord(one, *edge))) {
            const std::optional<Matrix3> there = edge_frame(other, from, to);
            if (!there) continue;
            for (const Vector3& senses : {Vector3(1, 1, 1), Vector3(1, -1, 1), Vector3(1, 1, -1), Vector3(1, -1, -1)}) {
                Isometry move, back;
                move.turn = *there * senses.asDiagonal() * frame.transpose();
                move.shift = other.nodes[from].curvature.point - move.turn * origin;
                back.turn = move.turn.transpose();
                back.shift = -(back.turn * move.shift);
                Agreement now{.nodes = best.nodes};
                count(now, one, move, nodes_of_other, best.unmatched);
                if (now.unmatched < best.unmatched) count(now, other, back, nodes_of_one, best.unmatched);
                if (now.unmatched >= best.unmatched || !keeps_face(tree, one, move, step)) continue;
                best = now;
                if (best.unmatched == 0) return best;
            }
        }
    }
    return best;
}

}  // namespace umbilic::test
