// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/face_triangulation.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace umbilic {

namespace {

/// A flip must make the least angle greater by more than this (radians): rounding never flips back and forth.
constexpr double least_gain = 1e-9;
/// So much of the least angle (radians) an edge along the preferred direction may cost: more than the accuracy of
/// nodes.
constexpr double preference_share = 1e-3;

double angle(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Whether d lies inside of the circle through a, b, c in a metric.
bool in_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d, const Matrix2& metric) {
    const double determinant_of_metric = metric(0, 0) * metric(1, 1) - metric(0, 1) * metric(0, 1);
    if (!(metric(0, 0) > 0.0 && determinant_of_metric > 0.0)) return false;
    const double xx = std::sqrt(metric(0, 0)), xy = metric(0, 1) / xx, yy = std::sqrt(determinant_of_metric) / xx;
    const auto lifted = [&](const GridPoint& p) -> Vector3 {
        const double x = static_cast<double>(p.x - d.x), y = static_cast<double>(p.y - d.y);
        const double along = xx * x + xy * y, across = yy * y;
        return {along, across, along * along + across * across};
    };
    const Vector3 p = lifted(a), q = lifted(b), r = lifted(c);
    const double determinant = p.dot(q.cross(r));
    const double scale = p.z() * q.head<2>().norm() * r.head<2>().norm();
    return determinant > 1e-9 * scale;
}

}  // namespace

std::int64_t orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

int FaceTriangulation::add_triangle() {
    if (!free_.empty()) {
        const int triangle = free_.back();
        free_.pop_back();
        for (int k = 0; k < 3; ++k) slots_[3 * triangle + k] = {};
        return triangle;
    }
    slots_.resize(slots_.size() + 3);
    versions_.push_back(0);
    return triangle_count() - 1;
}

void FaceTriangulation::set_corner(int slot, int vertex, const GridPoint& corner) {
    slots_[slot].vertex = vertex;
    slots_[slot].corner = corner;
    slot_of_[vertex] = slot;
    ++versions_[slot / 3];
    if (changed_.empty() || changed_.back() != slot / 3) changed_.push_back(slot / 3);
}

std::vector<int> FaceTriangulation::take_changed() {
    std::vector<int> result;
    result.swap(changed_);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

void FaceTriangulation::link(int a, int b) {
    slots_[a].twin = b;
    if (b >= 0) {
        slots_[b].twin = a;
        slots_[b].fixed = slots_[a].fixed = slots_[a].fixed || slots_[b].fixed;
    }
}

GridPoint FaceTriangulation::opposite(int slot) const {
    const int twin = slots_[slot].twin;
    return slots_[twin].corner + slots_[next(slot)].corner - slots_[previous(twin)].corner;
}

bool FaceTriangulation::convex(int slot) const {
    const GridPoint a = slots_[slot].corner, b = slots_[next(slot)].corner, c = slots_[previous(slot)].corner;
    const GridPoint d = opposite(slot);
    return orientation(a, b, d) > 0 && orientation(a, d, c) > 0;
}

/// Replaces the edge b-c of the triangles (a, b, c), (d, c, b) by a-d.
void FaceTriangulation::flip(int slot) {
    const int t = slot, u = slots_[slot].twin;
    const int tb = next(t), tc = previous(t), uc = next(u), ub = previous(u);
    const GridPoint d = opposite(t);
    const Slot a = slots_[t], b = slots_[tb], c = slots_[tc];
    const int vd = slots_[u].vertex;
    // Outer edges: opposite b is c-a, opposite c is a-b; in the other triangle opposite c is b-d, opposite b is d-c.
    const int ca = b.twin, ab = c.twin, bd = slots_[uc].twin, dc = slots_[ub].twin;
    const bool ca_fixed = b.fixed, ab_fixed = c.fixed, bd_fixed = slots_[uc].fixed, dc_fixed = slots_[ub].fixed;
    const GridPoint ac = a.corner, bc = b.corner, cc = c.corner;
    const int va = a.vertex, vb = b.vertex, vc = c.vertex;
    // First triangle (a, b, d) in the slots t, tb, tc; second (a, d, c) in u, uc, ub.
    set_corner(t, va, ac);
    set_corner(tb, vb, bc);
    set_corner(tc, vd, d);
    set_corner(u, va, ac);
    set_corner(uc, vd, d);
    set_corner(ub, vc, cc);
    for (const int s : {t, tb, tc, u, uc, ub}) slots_[s].fixed = false;
    const auto join = [&](int s, int outer, bool fixed) {
        slots_[s].fixed = fixed;
        slots_[s].twin = outer;
        if (outer >= 0) slots_[outer].twin = s;
    };
    // An outer edge may be shared by these two triangles themselves; then its twin moves too.
    const auto moved = [&](int outer) {
        if (outer == tb) return uc;
        if (outer == tc) return tc;
        if (outer == uc) return t;
        if (outer == ub) return u;
        return outer;
    };
    join(t, moved(bd), bd_fixed);   // b-d
    join(tc, moved(ab), ab_fixed);  // a-b
    join(u, moved(dc), dc_fixed);   // d-c
    join(uc, moved(ca), ca_fixed);  // c-a
    slots_[tb].twin = ub;           // d-a
    slots_[ub].twin = tb;
}

double FaceTriangulation::least_angle(int a, int b, int c) const {
    const Vector3 &p = points_[a], &q = points_[b], &r = points_[c];
    return std::min({angle(q - p, r - p), angle(r - q, p - q), angle(p - r, q - r)});
}

/// Square of the cosine between an edge and the preferred direction.
double FaceTriangulation::along_preferred(int a, int b) const {
    const Vector3 way = points_[b] - points_[a];
    const double along = way.dot(preferred_), length = way.squaredNorm();
    return length > 0.0 ? along * along / length : 0.0;
}

bool FaceTriangulation::should_flip(int slot) const {
    const int twin = slots_[slot].twin;
    if (twin < 0 || slots_[slot].fixed || twin / 3 == slot / 3 || !convex(slot)) return false;
    const int a = slots_[slot].vertex, b = slots_[next(slot)].vertex, c = slots_[previous(slot)].vertex,
              d = slots_[twin].vertex;
    if (!in_space_) {
        const GridPoint p = slots_[slot].corner, q = slots_[next(slot)].corner, r = slots_[previous(slot)].corner,
                        far = opposite(slot);
        Matrix2 metric = Vector2(aspect_ * aspect_, 1.0).asDiagonal();
        if (metric_) metric = metric_({(p.x + q.x + r.x + far.x) / 4, (p.y + q.y + r.y + far.y) / 4});
        return in_circle(p, q, r, far, metric);
    }
    if (a == b || b == c || c == a || d == b || d == c || a == d) return false;
    const double gain =
        std::min(least_angle(a, b, d), least_angle(a, d, c)) - std::min(least_angle(a, b, c), least_angle(d, c, b));
    return gain + preference_share * (along_preferred(a, d) - along_preferred(b, c)) > least_gain;
}

void FaceTriangulation::legalise(std::vector<int>& stack) {
    // Where the metric changes from place to place flips could go round.
    for (long flips = 0, most = 16L * slot_count() + 64; !stack.empty() && flips < most;) {
        const int slot = stack.back();
        stack.pop_back();
        if (slots_[slot].vertex < 0 || !should_flip(slot)) continue;
        ++flips;
        const int twin = slots_[slot].twin;
        flip(slot);
        for (const int s : {slot, previous(slot), twin, next(twin)}) stack.push_back(s);
    }
}

void FaceTriangulation::improve(const Vector3& preferred) {
    in_space_ = true;
    preferred_ = preferred;
    std::vector<int> stack;
    for (int s = slot_count() - 1; s >= 0; --s)
        if (slots_[s].vertex >= 0 && slots_[s].twin > s) stack.push_back(s);
    legalise(stack);
}

FaceTriangulation::Place FaceTriangulation::locate(GridPoint at, int triangle, bool search) const {
    if (triangle < 0 || triangle >= triangle_count() || !alive(triangle)) {
        triangle = last_ < triangle_count() && alive(last_) ? last_ : 0;
        while (triangle < triangle_count() && !alive(triangle)) ++triangle;
        if (triangle == triangle_count()) return {-1, at, true};
    }
    int from = -1;
    for (int steps = 0, limit = 4 * triangle_count() + 16; steps < limit; ++steps) {
        int leave = -1;
        for (int k = 0; k < 3; ++k) {
            const int s = 3 * triangle + (k + steps) % 3;
            if (s == from) continue;
            if (orientation(slots_[next(s)].corner, slots_[previous(s)].corner, at) < 0) {
                leave = s;
                if (slots_[s].twin >= 0) break;
            }
        }
        if (leave < 0) {
            last_ = triangle;
            return {triangle, at, false};
        }
        const int twin = slots_[leave].twin;
        if (twin < 0) {
            if (!search) return {triangle, at, true};
            break;
        }
        at = at - slots_[next(leave)].corner + slots_[previous(twin)].corner;
        triangle = twin / 3;
        from = twin;
    }
    for (int t = 0; t < triangle_count(); ++t) {
        if (!alive(t)) continue;
        bool inside = true;
        for (int s = 3 * t; s < 3 * t + 3 && inside; ++s)
            inside = orientation(slots_[next(s)].corner, slots_[previous(s)].corner, at) >= 0;
        if (inside) {
            last_ = t;
            return {t, at, false};
        }
    }
    return {-1, at, true};
}

int FaceTriangulation::insert(const Place& place, const Vector3& point) {
    const int t = 3 * place.triangle;
    int on = -1;
    for (int s = t; s < t + 3; ++s) {
        if (slots_[s].corner == place.at) return -1;
        if (orientation(slots_[next(s)].corner, slots_[previous(s)].corner, place.at) == 0) on = s;
    }
    if (on >= 0 && (slots_[on].fixed || slots_[on].twin < 0)) return -1;
    const int vertex = vertex_count();
    slot_of_.push_back(-1);
    if (!points_.empty()) points_.push_back(point);
    std::vector<int> stack;
    if (on < 0) {
        // (a, b, c) becomes (p, b, c), (a, p, c), (a, b, p).
        const int second = 3 * add_triangle(), third = 3 * add_triangle();
        const Slot a = slots_[t], b = slots_[t + 1], c = slots_[t + 2];
        set_corner(second, a.vertex, a.corner);
        set_corner(second + 1, vertex, place.at);
        set_corner(second + 2, c.vertex, c.corner);
        set_corner(third, a.vertex, a.corner);
        set_corner(third + 1, b.vertex, b.corner);
        set_corner(third + 2, vertex, place.at);
        slots_[second + 1].fixed = b.fixed;
        slots_[third + 2].fixed = c.fixed;
        slots_[t + 1].fixed = slots_[t + 2].fixed = false;
        link(second + 1, b.twin == t + 2 ? third + 2 : b.twin);
        link(third + 2, c.twin == t + 1 ? second + 1 : c.twin);
        set_corner(t, vertex, place.at);
        slot_of_[b.vertex] = t + 1;
        slot_of_[c.vertex] = t + 2;
        link(t + 1, second);
        link(t + 2, third);
        link(second + 2, third + 1);
        stack = {t, second + 1, third + 2};
    } else {
        // The edge b-c of (a, b, c), (d, c, b) is cut.
        const int twin = slots_[on].twin;
        const int second = 3 * add_triangle(), fourth = 3 * add_triangle();
        const int b_slot = next(on), c_slot = previous(on), uc = next(twin), ub = previous(twin);
        const Slot a = slots_[on], b = slots_[b_slot], c = slots_[c_slot], d = slots_[twin], dc = slots_[uc],
                   db = slots_[ub];
        const GridPoint other = place.at - b.corner + db.corner;
        // (a, b, p) stays in t, (a, p, c) is new; (d, c, p) stays in the twin's triangle, (d, p, b) is new.
        set_corner(second, a.vertex, a.corner);
        set_corner(second + 1, vertex, place.at);
        set_corner(second + 2, c.vertex, c.corner);
        set_corner(fourth, d.vertex, d.corner);
        set_corner(fourth + 1, vertex, other);
        set_corner(fourth + 2, db.vertex, db.corner);
        slots_[second + 1].fixed = b.fixed;
        link(second + 1, b.twin);
        slots_[fourth + 1].fixed = dc.fixed;
        link(fourth + 1, dc.twin);
        slots_[b_slot].fixed = slots_[uc].fixed = false;
        set_corner(c_slot, vertex, place.at);
        set_corner(ub, vertex, other);
        slot_of_[b.vertex] = b_slot;
        slot_of_[dc.vertex] = uc;
        slots_[on].twin = slots_[twin].twin = -1;
        link(on, fourth);
        link(second, twin);
        link(b_slot, second + 2);
        link(uc, fourth + 2);
        stack = {c_slot, second + 1, ub, fourth + 1};
    }
    for (const int s : stack) ++versions_[s / 3];
    legalise(stack);
    return vertex;
}

bool FaceTriangulation::remove(int vertex) {
    const auto star = [&] {
        std::vector<int> slots;
        const int first = slot_of_[vertex];
        int s = first;
        do {
            slots.push_back(s);
            const int twin = slots_[next(s)].twin;
            if (twin < 0) return std::vector<int>();
            s = next(twin);
        } while (s != first && slots.size() < slots_.size());
        return slots;
    };
    std::vector<int> slots = star();
    // What is left of these triangles fills the hole.
    const std::vector<int> changed = slots;
    // Every flip takes one edge from the vertex; where it meets itself across a seam that may fail.
    for (std::size_t flips = slots.size(); slots.size() > 3; --flips) {
        if (flips == 0) return false;
        // The edge at the vertex whose flip leaves the best triangle behind.
        int best = -1;
        double widest = -1.0;
        for (const int s : slots) {
            const int edge = next(s);  // between the vertex and the previous corner
            const int twin = slots_[edge].twin;
            if (twin < 0 || slots_[edge].fixed || twin / 3 == edge / 3) continue;
            // The triangle (a, far, d) stays behind; the other one, with the vertex, may be flat: it will go.
            const Slot &a_slot = slots_[edge], &far_slot = slots_[next(edge)], &own = slots_[previous(edge)];
            const GridPoint d_corner = opposite(edge);
            if (orientation(a_slot.corner, far_slot.corner, d_corner) <= 0 ||
                orientation(a_slot.corner, d_corner, own.corner) < 0)
                continue;
            const int a = a_slot.vertex, d = slots_[twin].vertex, far = far_slot.vertex;
            if (own.vertex != vertex) continue;
            if (a == d || far == a || far == d || far == vertex || a == vertex || d == vertex) continue;
            const double least = least_angle(a, d, far);
            if (least > widest) {
                widest = least;
                best = edge;
            }
        }
        if (best < 0) return false;
        flip(best);
        slots = star();
    }
    if (slots.size() != 3) return false;
    // (v, b, c), (v, c, d), (v, d, b) become (d, b, c): the first one takes the corner d.
    const int first = slots[0];
    const int second = slots_[next(first)].twin / 3, third = slots_[previous(first)].twin / 3;
    if (second == third || second == first / 3 || third == first / 3) return false;
    const int in_second = slots[1], in_third = slots[2];
    const int d = slots_[previous(in_second)].vertex;
    const GridPoint shift = slots_[first].corner - slots_[in_second].corner;
    const GridPoint corner = slots_[previous(in_second)].corner + shift;
    const int cd = slots_[in_second].twin, db = slots_[in_third].twin;
    for (const int outer : {cd, db})
        if (outer >= 0 && (outer / 3 == second || outer / 3 == third)) return false;
    const bool cd_fixed = slots_[in_second].fixed, db_fixed = slots_[in_third].fixed;
    set_corner(first, d, corner);
    const auto join = [&](int s, int outer, bool fixed) {
        slots_[s].twin = outer;
        slots_[s].fixed = fixed;
        if (outer >= 0) slots_[outer].twin = s;
    };
    join(next(first), cd, cd_fixed);      // opposite b: c-d
    join(previous(first), db, db_fixed);  // opposite c: d-b
    for (const int s : {in_second, in_third}) {
        const int t = s / 3;
        for (int k = 3 * t; k < 3 * t + 3; ++k) slots_[k] = {};
        ++versions_[t];
        free_.push_back(t);
    }
    slot_of_[vertex] = -1;
    for (const int s : {first, next(first), previous(first)}) slot_of_[slots_[s].vertex] = s;
    std::vector<int> stack;
    for (const int slot : changed)
        for (int s = slot - slot % 3, end = s + 3; s < end; ++s)
            if (slots_[s].vertex >= 0) stack.push_back(s);
    legalise(stack);
    return true;
}

}  // namespace umbilic
