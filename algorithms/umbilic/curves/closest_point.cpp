// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/closest_point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <Eigen/Core>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/curves/cell_tree.h>

namespace umbilic {

namespace {

/// Distances are taken as equal, and bounds as reached, within this times the size of the coordinates.
constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();
/// A Newton step below this part of the cell is the last one: the error it leaves is of the order of its square.
constexpr double last_step = 1e-7;
constexpr int most_steps = 60;
/// Cells one query may halve beyond those of the tree before it gives up proving its answer.
constexpr int most_halvings = 4000;
/// Points a task of a batch takes at least.
constexpr std::size_t batch_grain = 64;

struct Range {
    std::array<double, 2> low, high;
};

/// One query. Everything is relative to the tree's origin.
class Search {
public:
    Search(const CellTree& tree, const Vector3& point, double limit, int without)
        : tree_(tree),
          p_(point - tree.origin),
          without_(without),
          slack_(rounding * (p_.norm() + tree.radius)),
          best_(limit) {}

    std::optional<ClosestPoint> run();

private:
    double bound() const { return best_ + slack_; }
    /// Closes the cell: after it, no point of the cell's part of the face is closer than the best one by more than
    /// rounding. False if the cell has to be halved.
    bool close(const Cell& cell);
    void halve(const Cell& cell);
    void descend(const Cell& cell, const Range& range, std::array<double, 2> x, bool convex);
    /// `free`: the squared distance is stationary there; `settled`: so it is, or it cannot fall across the border.
    void offer(const Cell& cell, const std::array<double, 2>& x, const Vector3& point, bool free, bool settled);

    const CellTree& tree_;
    Vector3 p_;
    int without_;  ///< number of the face that is left out
    double slack_;
    double best_;
    bool found_ = false;
    bool settled_ = false;  ///< the best point is a minimum, and not only a point as close
    bool proved_ = true;
    ClosestPoint result_;
};

/// Squared distances from p to the four boxes of a node.
void squared_distances(const BoxNode& node, const Vector3& p, std::array<double, 4>& result) {
    std::array<double, 4> x, y, z;
    for (int k = 0; k < 4; ++k) x[k] = p.x() - node.center[0][k];
    for (int k = 0; k < 4; ++k) y[k] = p.y() - node.center[1][k];
    for (int k = 0; k < 4; ++k) z[k] = p.z() - node.center[2][k];
    result.fill(0.0);
    for (int a = 0; a < 3; ++a)
        for (int k = 0; k < 4; ++k) {
            const double along = x[k] * node.axis[a][0][k] + y[k] * node.axis[a][1][k] + z[k] * node.axis[a][2][k];
            const double beyond = std::max(std::abs(along) - node.half[a][k], 0.0);
            result[k] += beyond * beyond;
        }
}

/// Minimum of the convex g.d + d.H d / 2, H = (h[0], h[1]; h[1], h[2]), over a range of d that holds 0.
std::array<double, 2> model_step(const std::array<double, 3>& h, const std::array<double, 2>& g, const Range& range) {
    const double determinant = h[0] * h[2] - h[1] * h[1];
    if (determinant > 0.0) {
        const std::array<double, 2> d = {-(h[2] * g[0] - h[1] * g[1]) / determinant,
                                         -(h[0] * g[1] - h[1] * g[0]) / determinant};
        if (range.low[0] <= d[0] && d[0] <= range.high[0] && range.low[1] <= d[1] && d[1] <= range.high[1]) return d;
    }
    // Otherwise it lies on a side of the range.
    std::array<double, 2> best = {0.0, 0.0};
    double least = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 2; ++a)
        for (const double fixed : {range.low[a], range.high[a]}) {
            const int b = 1 - a;
            const double slope = g[b] + h[1] * fixed, bend = h[2 * b];
            const double free = bend > 0.0 ? std::clamp(-slope / bend, range.low[b], range.high[b])
                                           : (slope > 0.0 ? range.low[b] : range.high[b]);
            const double value =
                g[a] * fixed + 0.5 * h[2 * a] * fixed * fixed + slope * free + 0.5 * bend * free * free;
            if (value < least) {
                least = value;
                best[a] = fixed;
                best[b] = free;
            }
        }
    return best;
}

/// Parameter of the patch for x in [-1/2, 1/2], exact at the ends.
double patch_parameter(const LocalBox& box, int side, double x) {
    if (x <= -0.5) return box.low[side];
    if (x >= 0.5) return box.high[side];
    return 0.5 * (box.low[side] + box.high[side]) + x * (box.high[side] - box.low[side]);
}

std::optional<ClosestPoint> Search::run() {
    // Nearest box first; a child enters the stack above its farther siblings.
    struct Entry {
        double squared;
        int child;
    };
    constexpr int deepest = 3 * 64;
    std::array<Entry, deepest> stack;
    int size = 0;
    if (!tree_.nodes.empty()) stack[size++] = {0.0, 0};
    while (size > 0) {
        const Entry entry = stack[--size];
        const double limit = bound();
        if (entry.squared > limit * limit) continue;
        if (entry.child < 0) {
            const Cell& cell = tree_.cells[-1 - entry.child];
            if (without_ != 0 && tree_.faces[tree_.patches[cell.patch].face].number == without_) continue;
            if (!close(cell)) halve(cell);
            continue;
        }
        const BoxNode& node = tree_.nodes[entry.child];
        std::array<double, 4> squared;
        squared_distances(node, p_, squared);
        const int first = size;
        for (int k = 0; k < node.count; ++k) {
            if (squared[k] > limit * limit) continue;
            int at = size++;
            for (; at > first && stack[at - 1].squared < squared[k]; --at) stack[at] = stack[at - 1];
            stack[at] = {squared[k], node.child[k]};
        }
    }
    if (!found_) return std::nullopt;
    result_.point += tree_.origin;
    result_.certified = proved_;
    return result_;
}

bool Search::close(const Cell& cell) {
    const CellModel& m = cell.model;
    const Vector3 v = m.c - p_;
    const double far = v.norm();
    if (far - m.radius > bound()) return true;

    std::array<double, 2> g = {v.dot(m.r_u), v.dot(m.r_v)};
    const std::array<double, 3> h = {m.r_u.squaredNorm() + v.dot(m.r_uu), m.r_u.dot(m.r_v) + v.dot(m.r_uv),
                                     m.r_v.squaredNorm() + v.dot(m.r_vv)};
    Range range{{-0.5, -0.5}, {0.5, 0.5}};
    for (int a = 0; a < 2; ++a)
        if (cell.box.low[a] == cell.box.high[a]) range.low[a] = range.high[a] = 0.0;
    // Where the squared distance rises (falls) all over the cell, its minimum is on the lower (upper) side; unless the
    // surface goes on beyond that side, where it falls further.
    for (bool narrowed = true; narrowed;) {
        narrowed = false;
        for (int a = 0; a < 2; ++a) {
            if (range.low[a] == range.high[a]) continue;
            const int b = 1 - a;
            const double error = far * m.slope_far[a] + m.slope_near[a] + slack_ * m.speed[a];
            const double middle =
                g[a] + 0.5 * h[2 * a] * (range.low[a] + range.high[a]) + 0.5 * h[1] * (range.low[b] + range.high[b]);
            const double half = 0.5 * std::abs(h[2 * a]) * (range.high[a] - range.low[a]) +
                                0.5 * std::abs(h[1]) * (range.high[b] - range.low[b]) + error;
            if (std::abs(middle) <= half) continue;
            const bool rises = middle > 0.0;
            if (!cell.border[2 * a + (rises ? 0 : 1)]) return true;
            (rises ? range.high[a] : range.low[a]) = rises ? range.low[a] : range.high[a];
            narrowed = true;
        }
    }

    const bool free_u = range.low[0] < range.high[0], free_v = range.low[1] < range.high[1];
    const double least_u = h[0] - far * m.bend_far[0] - m.bend_near[0];
    const double least_v = h[2] - far * m.bend_far[2] - m.bend_near[2];
    const double mixed = std::abs(h[1]) + far * m.bend_far[1] + m.bend_near[1];
    const bool convex = (!free_u || least_u > 0.0) && (!free_v || least_v > 0.0) &&
                        (!(free_u && free_v) || least_u * least_v > mixed * mixed);
    std::array<double, 2> x = {0.5 * (range.low[0] + range.high[0]), 0.5 * (range.low[1] + range.high[1])};
    if (convex) {
        // Minimum of the quadratic model as a start.
        const std::array<double, 2> slope = {g[0] + h[0] * x[0] + h[1] * x[1], g[1] + h[1] * x[0] + h[2] * x[1]};
        if (free_u && free_v) {
            const double determinant = h[0] * h[2] - h[1] * h[1];
            x[0] -= (h[2] * slope[0] - h[1] * slope[1]) / determinant;
            x[1] -= (h[0] * slope[1] - h[1] * slope[0]) / determinant;
        } else if (free_u) {
            x[0] -= slope[0] / h[0];
        } else if (free_v) {
            x[1] -= slope[1] / h[2];
        }
        for (int a = 0; a < 2; ++a) x[a] = std::clamp(x[a], range.low[a], range.high[a]);
    }
    descend(cell, range, x, convex);
    return convex || m.radius <= slack_;
}

void Search::descend(const Cell& cell, const Range& range, std::array<double, 2> x, bool convex) {
    const TreePatch& patch = tree_.patches[cell.patch];
    const auto parameter = [&](const std::array<double, 2>& y) {
        return std::array<double, 2>{patch_parameter(cell.box, 0, y[0]), patch_parameter(cell.box, 1, y[1])};
    };
    const std::array<double, 2> scale = {cell.box.high[0] - cell.box.low[0], cell.box.high[1] - cell.box.low[1]};
    std::array<double, 2> before = x, step = {0.0, 0.0};
    double squared_before = std::numeric_limits<double>::infinity();
    for (int count = 0; count < most_steps; ++count) {
        const std::array<double, 2> at = parameter(x);
        const LocalDerivatives d = tree_.evaluate(patch, at[0], at[1]);
        const Vector3 off = d.r - p_;
        const double squared = off.squaredNorm();
        if (squared > squared_before + slack_ * slack_ + slack_ * std::sqrt(squared_before)) {
            for (int a = 0; a < 2; ++a) {
                step[a] *= 0.5;
                x[a] = before[a] + step[a];
            }
            continue;
        }
        const std::array<Vector3, 2> tangent = {scale[0] * d.r_u, scale[1] * d.r_v};
        const std::array<double, 2> g = {off.dot(tangent[0]), off.dot(tangent[1])};
        if (convex) {
            // A convex function lies above its tangent plane.
            double least = 0.5 * squared;
            for (int a = 0; a < 2; ++a) least += std::min(g[a] * (range.low[a] - x[a]), g[a] * (range.high[a] - x[a]));
            if (2 * least > bound() * bound()) return;
        } else if (squared > bound() * bound()) {
            return;
        }

        double e = tangent[0].squaredNorm(), f = tangent[0].dot(tangent[1]), h = tangent[1].squaredNorm();
        const double e2 = e + scale[0] * scale[0] * off.dot(d.r_uu);
        const double f2 = f + scale[0] * scale[1] * off.dot(d.r_uv);
        const double h2 = h + scale[1] * scale[1] * off.dot(d.r_vv);
        // Newton where its model has a minimum, Gauss-Newton elsewhere.
        if (convex || (e2 > 0.0 && e2 * h2 > f2 * f2)) std::tie(e, f, h) = std::make_tuple(e2, f2, h2);
        step = model_step({e, f, h}, g,
                          {{range.low[0] - x[0], range.low[1] - x[1]}, {range.high[0] - x[0], range.high[1] - x[1]}});
        before = x;
        squared_before = squared;
        bool stationary = true, settled = true;
        for (int a = 0; a < 2; ++a) {
            x[a] = std::clamp(before[a] + step[a], range.low[a], range.high[a]);
            step[a] = x[a] - before[a];
            const bool flat = (range.low[a] < x[a] && x[a] < range.high[a]) ||
                              std::abs(g[a]) <= slack_ * tangent[a].norm() || cell.box.low[a] == cell.box.high[a];
            stationary = stationary && flat;
            settled =
                settled && (flat || (x[a] == -0.5 && cell.border[2 * a]) || (x[a] == 0.5 && cell.border[2 * a + 1]));
        }
        if (std::abs(step[0]) <= last_step && std::abs(step[1]) <= last_step) {
            const std::array<double, 2> s = {scale[0] * step[0], scale[1] * step[1]};
            const Vector3 point = d.r + s[0] * d.r_u + s[1] * d.r_v +
                                  0.5 * (s[0] * s[0] * d.r_uu + 2 * s[0] * s[1] * d.r_uv + s[1] * s[1] * d.r_vv);
            offer(cell, parameter(x), point, stationary, settled);
            return;
        }
        if (!convex) offer(cell, at, d.r, false, false);
    }
    proved_ = proved_ && !convex;
}

void Search::offer(const Cell& cell, const std::array<double, 2>& x, const Vector3& point, bool free, bool settled) {
    const double distance = (point - p_).norm();
    if (distance > (found_ ? bound() : best_)) return;
    const TreePatch& patch = tree_.patches[cell.patch];
    const CellTree::TreeFace& face = tree_.faces[patch.face];
    const Vector2 at = tree_.parameters(patch, x[0], x[1]);
    if (cell.trimmed && !cell.on_loop) {
        const Containment place = face.region.classify(at.x(), at.y());
        if (place == Containment::outside || (place == Containment::boundary && !free)) return;
    }
    const auto key = [](const SurfacePoint& p) { return std::make_tuple(p.face, p.u, p.v); };
    const SurfacePoint candidate{face.number, at.x(), at.y()};
    if (found_ && distance >= best_ - slack_ &&
        (settled < settled_ || (settled == settled_ && key(candidate) >= key(result_.at)))) {
        best_ = std::min(best_, distance);
        return;
    }
    int sides = 0;
    if (cell.on_loop) {
        sides = 1;
        for (int a = 0; a < 2; ++a)
            if (cell.box.low[a] < cell.box.high[a])
                sides += (cell.border[2 * a] && x[a] == cell.box.low[a]) ||
                         (cell.border[2 * a + 1] && x[a] == cell.box.high[a]);
    } else if (face.whole) {
        const ParameterBox domain = face.surface.domain();
        sides =
            (at.x() == domain.u.low || at.x() == domain.u.high) + (at.y() == domain.v.low || at.y() == domain.v.high);
    }
    best_ = found_ ? std::min(best_, distance) : distance;
    found_ = true;
    settled_ = settled;
    result_.at = candidate;
    result_.point = point;
    result_.distance = distance;
    result_.kind = sides == 0 ? FootKind::interior : sides == 1 ? FootKind::edge : FootKind::corner;
}

void Search::halve(const Cell& start) {
    const TreePatch& patch = tree_.patches[start.patch];
    const TrimmingRegion& region = tree_.faces[patch.face].region;
    std::vector<Vector4> net;
    std::vector<Cell> open;
    const auto split = [&](const Cell& cell) {
        const int side = CellTree::longer_side(cell.model);
        const double middle = 0.5 * (cell.box.low[side] + cell.box.high[side]);
        Cell low = cell, high = cell;
        low.box.high[side] = high.box.low[side] = middle;
        low.border[2 * side + 1] = high.border[2 * side] = false;
        open.push_back(high);
        open.push_back(low);
    };
    split(start);
    for (int count = 0; !open.empty(); ++count) {
        if (count == most_halvings) {
            proved_ = false;
            return;
        }
        Cell cell = open.back();
        open.pop_back();
        if (cell.trimmed && !cell.on_loop) {
            const Vector2 low = tree_.parameters(patch, cell.box.low[0], cell.box.low[1]);
            const Vector2 high = tree_.parameters(patch, cell.box.high[0], cell.box.high[1]);
            const ParameterBox domain = region.domain();
            const Vector2 side((high - low).x() / domain.u.length(), (high - low).y() / domain.v.length());
            const Vector2 middle = 0.5 * (low + high);
            const Containment place = region.classify(middle.x(), middle.y(), 0.5 * side.norm());
            if (place == Containment::outside) continue;
            cell.trimmed = place == Containment::boundary;
        }
        cell.model = tree_.model(patch, cell.box, net);
        if (!net.empty() && best_ < std::numeric_limits<double>::infinity() &&
            squared_distance_bound(patch.local.u_degree, patch.local.v_degree, net, p_, best_) >=
                -slack_ * (2 * best_ + slack_))
            continue;
        if (!close(cell)) split(cell);
    }
}

}  // namespace

struct ClosestPointTree::Tree : CellTree {
    using CellTree::CellTree;
};

ClosestPointTree::ClosestPointTree(const Model& model) : tree_(std::make_unique<const Tree>(model.faces)) {}

ClosestPointTree::ClosestPointTree(const NurbsSurface& surface) {
    std::vector<Face> faces;
    faces.push_back({.number = 1, .surface = surface, .region = TrimmingRegion(surface.domain())});
    tree_ = std::make_unique<const Tree>(faces);
}

ClosestPointTree::~ClosestPointTree() = default;
ClosestPointTree::ClosestPointTree(ClosestPointTree&&) noexcept = default;
ClosestPointTree& ClosestPointTree::operator=(ClosestPointTree&&) noexcept = default;

std::optional<ClosestPoint> ClosestPointTree::closest(const Vector3& point, double limit, int without) const {
    if (!point.allFinite()) throw InvalidInput("closest point: a coordinate of the point is not finite");
    if (!(limit >= 0.0)) throw InvalidInput("closest point: the limit must not be negative");
    return Search(*tree_, point, limit, without).run();
}

std::vector<ClosestPoint> ClosestPointTree::closest(std::span<const Vector3> points, double limit) const {
    std::vector<ClosestPoint> result(points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), batch_grain), [&](const auto& part) {
        for (std::size_t i = part.begin(); i < part.end(); ++i)
            if (const std::optional<ClosestPoint> found = closest(points[i], limit)) result[i] = *found;
    });
    return result;
}

}  // namespace umbilic
