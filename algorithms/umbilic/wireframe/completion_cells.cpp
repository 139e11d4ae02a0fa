// SPDX-License-Identifier: LGPL-2.1-or-later
// Edges and cells of a face's wireframe from its triangulation.
#include <umbilic/wireframe/face_completion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include <Eigen/Geometry>

#include <umbilic/differential/curvature.h>

namespace umbilic {

namespace {

/// A part of a line that is longer than this times its chord is no side of a cell.
constexpr double greatest_bend = 1.2;
/// Two triangles without a part of a line between them become a quadrilateral if its corners differ from right angles
/// by less than this.
constexpr double greatest_corner_bend = 0.8;
/// Points of an edge between its ends.
constexpr int between_points = 3;

/// Barycentric coordinates of the samples of a cell.
constexpr std::array<std::array<double, 3>, 6> cell_samples = {
    {{0.7, 0.15, 0.15}, {0.15, 0.7, 0.15}, {0.15, 0.15, 0.7}, {0.45, 0.45, 0.1}, {0.45, 0.1, 0.45}, {0.1, 0.45, 0.45}}};

/// Greatest difference of a quadrilateral's corner from a right angle, counted in the sense of the first; more than a
/// right angle if it is not convex.
double corner_bend(const std::array<Vector3, 4>& corners) {
    const Vector3 normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
    double result = 0.0;
    for (int k = 0; k < 4; ++k) {
        const Vector3 to_next = corners[(k + 1) % 4] - corners[k], to_last = corners[(k + 3) % 4] - corners[k];
        const Vector3 turn = to_next.cross(to_last);
        const double angle = std::atan2(turn.dot(normal) < 0.0 ? -turn.norm() : turn.norm(), to_next.dot(to_last));
        result = std::max(result, std::abs(angle - 0.5 * std::numbers::pi));
    }
    return result;
}

}  // namespace

FaceWireframe FaceCompletion::assemble() const {
    FaceWireframe result;
    result.face = face_.number;
    std::vector<int> node_of(vertices_.size(), -1);
    const std::vector<Vector3>& points = mesh_.points();
    for (int s = 0; s < mesh_.slot_count(); ++s) {
        const int v = mesh_.slot(s).vertex;
        if (v < 0 || node_of[v] >= 0) continue;
        node_of[v] = -2;
    }
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
        if (node_of[v] != -2) continue;
        node_of[v] = static_cast<int>(result.nodes.size());
        const Vector2& p = vertices_[v].parameters;
        WireNode node{.at = {face_.number, p.x(), p.y()}, .curvature = curvature(face_.surface, p.x(), p.y())};
        if (face_.reversed && node.curvature.regular) node.curvature = flipped(node.curvature);
        node.curvature.point = points[v];
        node.on_border = vertices_[v].on_border;
        result.nodes.push_back(std::move(node));
    }

    const auto key = [](int a, int b) { return std::pair(std::min(a, b), std::max(a, b)); };
    std::map<std::pair<int, int>, const NetEdge*> net_edges;
    for (const NetEdge& edge : net_.edges) {
        const int a = net_vertex_[edge.from], b = net_vertex_[edge.to];
        if (a >= 0 && b >= 0 && a != b && edge.length <= greatest_bend * (points[a] - points[b]).norm())
            net_edges[key(a, b)] = &edge;
    }
    std::map<std::pair<int, int>, std::pair<const BorderNode*, int>> border_edges;
    for (const std::vector<BorderNode>& loop : border_.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            if (loop[i].kind == BorderKind::border)
                border_edges[key(loop[i].identity, loop[(i + 1) % loop.size()].identity)] = {&loop[i],
                                                                                             loop[i].identity};
    const auto net_edge = [&](int a, int b) -> const NetEdge* {
        const auto found = net_edges.find(key(a, b));
        return found == net_edges.end() ? nullptr : found->second;
    };

    // Pairs of triangles between four parts of lines become quadrilaterals.
    std::vector<bool> taken(mesh_.triangle_count(), false);
    std::set<std::pair<int, int>> diagonals;
    const auto join = [&](int s) {
        const FaceTriangulation::Slot& slot = mesh_.slot(s);
        const int b = mesh_.slot(FaceTriangulation::next(s)).vertex,
                  c = mesh_.slot(FaceTriangulation::previous(s)).vertex;
        taken[s / 3] = taken[slot.twin / 3] = true;
        diagonals.insert(key(b, c));
        result.cells.push_back({node_of[slot.vertex], node_of[b], node_of[mesh_.slot(slot.twin).vertex], node_of[c]});
        ++result.quadrilaterals;
    };
    for (int s = 0; s < mesh_.slot_count(); ++s) {
        const FaceTriangulation::Slot& slot = mesh_.slot(s);
        if (slot.vertex < 0 || slot.twin < s || taken[s / 3] || taken[slot.twin / 3] || slot.twin / 3 == s / 3)
            continue;
        const int a = slot.vertex, b = mesh_.slot(FaceTriangulation::next(s)).vertex,
                  c = mesh_.slot(FaceTriangulation::previous(s)).vertex, d = mesh_.slot(slot.twin).vertex;
        if (net_edge(b, c)) continue;
        const std::array<const NetEdge*, 4> sides = {net_edge(a, b), net_edge(b, d), net_edge(d, c), net_edge(c, a)};
        if (std::any_of(sides.begin(), sides.end(), [](const NetEdge* e) { return !e; })) continue;
        if (sides[0]->family == sides[1]->family || sides[0]->family != sides[2]->family ||
            sides[1]->family != sides[3]->family)
            continue;
        join(s);
    }
    // Between nodes that the lines leave open, the pairs with the squarest corners first.
    struct Pair {
        double bend;
        int slot;
    };
    std::vector<Pair> pairs;
    for (int s = 0; s < mesh_.slot_count(); ++s) {
        const FaceTriangulation::Slot& slot = mesh_.slot(s);
        if (slot.vertex < 0 || slot.twin < s || taken[s / 3] || taken[slot.twin / 3] || slot.twin / 3 == s / 3)
            continue;
        const int a = slot.vertex, b = mesh_.slot(FaceTriangulation::next(s)).vertex,
                  c = mesh_.slot(FaceTriangulation::previous(s)).vertex, d = mesh_.slot(slot.twin).vertex;
        if (net_edge(b, c) || a == d || a == b || a == c || b == c || d == b || d == c) continue;
        const double bend = corner_bend({points[a], points[b], points[d], points[c]});
        if (bend < greatest_corner_bend) pairs.push_back({bend, s});
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.bend < b.bend; });
    for (const auto& [bend, s] : pairs) {
        const int twin = mesh_.slot(s).twin;
        if (taken[s / 3] || taken[twin / 3]) continue;
        join(s);
    }
    std::set<std::pair<int, int>> edges;
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
        if (!mesh_.alive(t)) continue;
        const int a = mesh_.slot(3 * t).vertex, b = mesh_.slot(3 * t + 1).vertex, c = mesh_.slot(3 * t + 2).vertex;
        for (const auto& [p, q] : {key(a, b), key(b, c), key(c, a)})
            if (p != q && !diagonals.count({p, q})) edges.insert({p, q});
        if (taken[t] || a == b || b == c || c == a) continue;
        result.cells.push_back({node_of[a], node_of[b], node_of[c]});
    }
    for (const auto& [a, b] : edges) {
        WireEdge edge{.from = node_of[a], .to = node_of[b]};
        // Lines along an axis are no geodesics; they only brought the nodes.
        if (const NetEdge* line = field_.axis ? nullptr : net_edge(a, b)) {
            edge.kind = line->family == CurvatureFamily::maximum ? WireKind::maximum : WireKind::minimum;
            edge.length = line->length;
            edge.between = line->between;
            if (net_vertex_[line->from] != a) std::reverse(edge.between.begin(), edge.between.end());
        } else if (const auto border = border_edges.find({a, b}); border != border_edges.end()) {
            edge.kind = WireKind::boundary;
            edge.length = border->second.first->length;
            edge.between = border->second.first->between;
            if (border->second.second != a) std::reverse(edge.between.begin(), edge.between.end());
        } else {
            const Vector3 chord = points[b] - points[a];
            const Curvature &from = result.nodes[edge.from].curvature, &to = result.nodes[edge.to].curvature;
            const double c = chord.norm();
            double half = 0.0;
            if (from.regular && to.regular && c > 0.0)
                half = 0.5 * std::abs(std::asin(std::clamp(chord.dot(to.normal) / c, -1.0, 1.0)) -
                                      std::asin(std::clamp(chord.dot(from.normal) / c, -1.0, 1.0)));
            edge.length = half > 1e-6 ? c * half / std::sin(half) : c;
        }
        result.edges.push_back(std::move(edge));
    }
    measure(result, node_of);
    return result;
}

/// Points of geodesic edges, and how far the face is from the nodes.
void FaceCompletion::measure(FaceWireframe& wireframe, const std::vector<int>& node_of) const {
    std::map<std::pair<int, int>, int> edge_of;
    for (std::size_t i = 0; i < wireframe.edges.size(); ++i)
        edge_of[{wireframe.edges[i].from, wireframe.edges[i].to}] = static_cast<int>(i);
    PointCells<Vector3> nodes(options_.step);
    for (const WireNode& node : wireframe.nodes) nodes.add(node.curvature.point, node.curvature.point);
    double area = 0.0, covered = 0.0;
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
        if (!mesh_.alive(t)) continue;
        const std::array<FaceTriangulation::Slot, 3> s = {mesh_.slot(3 * t), mesh_.slot(3 * t + 1),
                                                          mesh_.slot(3 * t + 2)};
        const std::vector<Vector3>& points = mesh_.points();
        const Vector3 &a = points[s[0].vertex], &b = points[s[1].vertex], &c = points[s[2].vertex];
        const double weight = 0.5 * (b - a).cross(c - a).norm() / cell_samples.size();
        for (const auto& w : cell_samples) {
            if (!options_.drawn) break;
            double x = 0.0, y = 0.0;
            for (int k = 0; k < 3; ++k) {
                x += w[k] * static_cast<double>(s[k].corner.x);
                y += w[k] * static_cast<double>(s[k].corner.y);
            }
            const Vector2 at = wrapped(from_grid(x, y));
            const Vector3 p = face_.surface.value(at.x(), at.y());
            double distance = std::numeric_limits<double>::infinity();
            for (const FaceTriangulation::Slot& corner : s)
                distance = std::min(distance, (points[corner.vertex] - p).norm());
            // In thin triangles another node may be nearer.
            if (distance > options_.step)
                nodes.near(p, options_.step,
                           [&](const Vector3& node) { distance = std::min(distance, (node - p).norm()); });
            area += weight;
            if (distance <= options_.step) covered += weight;
            wireframe.farthest = std::max(wireframe.farthest, distance);
        }
        // The triangle's area among its inner corners.
        const auto inner = [&](const FaceTriangulation::Slot& corner) { return !vertices_[corner.vertex].on_border; };
        const auto inner_corners = std::count_if(s.begin(), s.end(), inner);
        for (const FaceTriangulation::Slot& corner : s)
            if (inner(corner))
                wireframe.nodes[node_of[corner.vertex]].area += weight * cell_samples.size() / inner_corners;
        for (int k = 0; options_.drawn && k < 3; ++k) {
            const FaceTriangulation::Slot &from = s[(k + 1) % 3], &to = s[(k + 2) % 3];
            if (from.vertex > to.vertex) continue;
            const auto found = edge_of.find({node_of[from.vertex], node_of[to.vertex]});
            if (found == edge_of.end()) continue;
            WireEdge& edge = wireframe.edges[found->second];
            if (edge.kind != WireKind::geodesic || !edge.between.empty()) continue;
            const Vector3 &p = points[from.vertex], &q = points[to.vertex], chord = q - p;
            const Vector3 normal =
                wireframe.nodes[edge.from].curvature.normal + wireframe.nodes[edge.to].curvature.normal;
            const Vector3 side = normal.cross(chord);
            for (int n = 1; n <= between_points; ++n) {
                const double share = static_cast<double>(n) / (between_points + 1);
                const Vector2 guess = from_grid((1 - share) * from.corner.x + share * to.corner.x,
                                                (1 - share) * from.corner.y + share * to.corner.y);
                const Vector3 on = p + share * chord;
                const auto at = side.norm() > 0.0 ? solve(guess, chord, chord.dot(on), side.normalized(),
                                                          side.normalized().dot(on), chord.norm())
                                                  : std::nullopt;
                const Vector2 there = wrapped(at.value_or(guess));
                edge.between.push_back(face_.surface.value(there.x(), there.y()));
            }
        }
    }
    if (options_.drawn) wireframe.coverage = area > 0.0 ? covered / area : 1.0;
}

}  // namespace umbilic
