// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/points/triangle_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

/// Triangles of a leaf.
constexpr int leaf_size = 4;

/// A box, and the range of TriangleTree's order that it holds. A node of more than leaf_size triangles is split in
/// half: its first half is the next node, its second one is number `second`.
struct Node {
    BoundingBox box;
    int begin = 0, end = 0, second = 0;
};

double squared_distance(const BoundingBox& box, const Vector3& p) {
    return (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).squaredNorm();
}

/// Barycentric coordinates of the closest point of a triangle (C. Ericson, Real-Time Collision Detection, 2005, 5.1.5).
std::array<double, 3> closest_weights(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
    if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
    if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
    const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
    if (of_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double t = d1 / (d1 - d3);
        return {1.0 - t, t, 0.0};
    }
    if (of_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double t = d2 / (d2 - d6);
        return {1.0 - t, 0.0, t};
    }
    if (of_a <= 0.0 && d4 >= d3 && d5 >= d6) {
        const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0.0, 1.0 - t, t};
    }
    const double sum = of_a + of_b + of_c;
    return {of_a / sum, of_b / sum, of_c / sum};
}

std::array<int, 2> edge(const std::array<int, 3>& triangle, int opposite) {
    const int a = triangle[(opposite + 1) % 3], b = triangle[(opposite + 2) % 3];
    return {std::min(a, b), std::max(a, b)};
}

}  // namespace

struct TriangleTree::Tree {
    explicit Tree(const PointCloud& of) : mesh(of), order(of.triangles.size()), border_point(of.points.size(), 0) {
        std::iota(order.begin(), order.end(), 0);
        split(0, static_cast<int>(order.size()));
        for (const std::array<int, 3>& triangle : mesh.triangles)
            for (int k = 0; k < 3; ++k) border_edges.push_back(edge(triangle, k));
        std::sort(border_edges.begin(), border_edges.end());
        std::size_t kept = 0;
        for (std::size_t i = 0; i < border_edges.size();) {
            const auto equal = std::find_if(border_edges.begin() + static_cast<std::ptrdiff_t>(i), border_edges.end(),
                                            [&](const auto& other) { return other != border_edges[i]; });
            const auto next = static_cast<std::size_t>(equal - border_edges.begin());
            if (next == i + 1) border_edges[kept++] = border_edges[i];
            i = next;
        }
        border_edges.resize(kept);
        for (const auto& [a, b] : border_edges) border_point[a] = border_point[b] = 1;
    }

    bool at_border(const TriangleFoot& foot) const {
        const std::array<int, 3>& triangle = mesh.triangles[foot.triangle];
        for (int k = 0; k < 3; ++k) {
            if (foot.weights[k] == 1.0) return border_point[triangle[k]] != 0;
            if (foot.weights[k] == 0.0 &&
                std::binary_search(border_edges.begin(), border_edges.end(), edge(triangle, k)) &&
                foot.weights[(k + 1) % 3] > 0.0 && foot.weights[(k + 2) % 3] > 0.0)
                return true;
        }
        return false;
    }

    /// Sum of the corners.
    Vector3 middle(int triangle) const {
        const auto& [a, b, c] = mesh.triangles[triangle];
        return mesh.points[a] + mesh.points[b] + mesh.points[c];
    }

    /// Adds the nodes of a range of the order, and puts it in order.
    void split(int begin, int end) {
        Node node{.begin = begin, .end = end};
        BoundingBox middles;
        for (int i = begin; i < end; ++i) {
            for (const int corner : mesh.triangles[order[i]]) node.box.add(mesh.points[corner]);
            middles.add(middle(order[i]));
        }
        const std::size_t place = nodes.size();
        nodes.push_back(node);
        if (end - begin <= leaf_size) return;
        Eigen::Index axis = 0;
        (middles.high - middles.low).maxCoeff(&axis);
        const int half = begin + (end - begin) / 2;
        std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end,
                         [&](int a, int b) { return std::pair(middle(a)[axis], a) < std::pair(middle(b)[axis], b); });
        split(begin, half);
        nodes[place].second = static_cast<int>(nodes.size());
        split(half, end);
    }

    void closest(const Vector3& point, int at, TriangleFoot& best, double& least) const {
        const Node& node = nodes[at];
        if (node.second == 0) {
            for (int i = node.begin; i < node.end; ++i) {
                const auto& [a, b, c] = mesh.triangles[order[i]];
                const std::array<double, 3> weights =
                    closest_weights(point, mesh.points[a], mesh.points[b], mesh.points[c]);
                const Vector3 foot =
                    weights[0] * mesh.points[a] + weights[1] * mesh.points[b] + weights[2] * mesh.points[c];
                const double squared = (foot - point).squaredNorm();
                if (squared > least || (squared == least && order[i] > best.triangle)) continue;
                least = squared;
                best = {order[i], weights, foot};
            }
            return;
        }
        std::array<std::pair<double, int>, 2> halves = {
            std::pair(squared_distance(nodes[at + 1].box, point), at + 1),
            std::pair(squared_distance(nodes[node.second].box, point), node.second)};
        if (halves[1] < halves[0]) std::swap(halves[0], halves[1]);
        for (const auto& [nearest, half] : halves)
            if (nearest <= least) closest(point, half, best, least);
    }

    const PointCloud& mesh;
    std::vector<int> order;
    std::vector<Node> nodes;
    std::vector<std::array<int, 2>> border_edges;  ///< sorted
    std::vector<char> border_point;
};

TriangleTree::TriangleTree(const PointCloud& mesh) {
    if (!mesh.is_mesh()) throw InvalidInput(mesh.source.path + ": has no triangles");
    tree_ = std::make_unique<const Tree>(mesh);
}
TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;

TriangleFoot TriangleTree::closest(const Vector3& point) const {
    TriangleFoot best;
    double least = std::numeric_limits<double>::infinity();
    tree_->closest(point, 0, best, least);
    best.distance = std::sqrt(least);
    best.at_border = tree_->at_border(best);
    return best;
}

}  // namespace umbilic
