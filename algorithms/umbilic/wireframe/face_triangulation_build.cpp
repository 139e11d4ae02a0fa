// SPDX-License-Identifier: LGPL-2.1-or-later
// The triangulation of what the loops of a face bound.
#include <umbilic/wireframe/face_triangulation.h>

#include <algorithm>
#include <deque>

namespace umbilic {

int FaceTriangulation::find_edge(int from, int to) const {
    // Around `from`, first one way, then, if a border is met, the other.
    const int first = slot_of_[from];
    if (first < 0) return -1;
    int s = first;
    do {
        if (slots_[next(s)].vertex == to) return previous(s);
        if (slots_[previous(s)].vertex == to) return next(s);
        const int twin = slots_[next(s)].twin;
        if (twin < 0) break;
        s = next(twin);
    } while (s != first);
    s = first;
    while (true) {
        const int twin = slots_[previous(s)].twin;
        if (twin < 0) return -1;
        s = previous(twin);
        if (s == first) return -1;
        if (slots_[next(s)].vertex == to) return previous(s);
        if (slots_[previous(s)].vertex == to) return next(s);
    }
}

std::optional<FaceTriangulation::Conflict> FaceTriangulation::enforce(int from, int to) {
    const auto fix = [&](int slot) {
        slots_[slot].fixed = true;
        if (slots_[slot].twin >= 0) slots_[slots_[slot].twin].fixed = true;
    };
    if (const int slot = find_edge(from, to); slot >= 0) {
        fix(slot);
        return std::nullopt;
    }
    const GridPoint a = slots_[slot_of_[from]].corner, b = slots_[slot_of_[to]].corner;
    // The edges between, as pairs of vertices.
    std::deque<std::pair<int, int>> crossed;
    int s = slot_of_[from];
    for (const int first = s;;) {
        const std::int64_t right = orientation(a, b, slots_[next(s)].corner);
        const std::int64_t left = orientation(a, b, slots_[previous(s)].corner);
        const bool ahead =
            (right < 0 && left > 0) && orientation(slots_[next(s)].corner, slots_[previous(s)].corner, b) <= 0;
        if (ahead) break;
        const int twin = slots_[next(s)].twin;
        if (twin < 0) return Conflict{from, from};
        s = next(twin);
        if (s == first) return Conflict{from, from};  // a vertex lies on the segment
    }
    while (true) {
        if (slots_[s].fixed) return Conflict{from, slots_[next(s)].vertex};
        crossed.emplace_back(slots_[next(s)].vertex, slots_[previous(s)].vertex);
        const int twin = slots_[s].twin;
        if (slots_[twin].vertex == to) break;
        const std::int64_t side = orientation(a, b, slots_[twin].corner);
        if (side == 0) return Conflict{from, slots_[twin].vertex};
        // The next edge crossed is opposite to the end that lies on the same side as the new corner.
        s = side > 0 ? next(twin) : previous(twin);
    }
    for (std::size_t tries = 0, limit = 64 + 16 * crossed.size() * crossed.size(); !crossed.empty(); ++tries) {
        if (tries > limit) return Conflict{from, from};
        const auto [p, q] = crossed.front();
        crossed.pop_front();
        const int slot = find_edge(p, q);
        if (slot < 0) continue;
        if (!convex(slot)) {
            crossed.emplace_back(p, q);
            continue;
        }
        flip(slot);
        const int diagonal = next(slot);  // opposite b in (a, b, d)
        const int x = slots_[next(diagonal)].vertex, y = slots_[previous(diagonal)].vertex;
        const bool ends_here = x == from || x == to || y == from || y == to;
        const std::int64_t one = orientation(a, b, slots_[next(diagonal)].corner);
        const std::int64_t other = orientation(a, b, slots_[previous(diagonal)].corner);
        if (!ends_here && ((one > 0) != (other > 0))) crossed.emplace_back(x, y);
    }
    const int slot = find_edge(from, to);
    if (slot < 0) return Conflict{from, from};
    fix(slot);
    return std::nullopt;
}

std::optional<FaceTriangulation::Conflict> FaceTriangulation::build(const Loops& loops, double aspect) {
    slots_.clear();
    versions_.clear();
    free_.clear();
    points_.clear();
    in_space_ = false;
    aspect_ = aspect;
    metric_ = nullptr;
    preferred_ = Vector3::Zero();
    const int count = static_cast<int>(loops.corners.size());
    // Outer triangle.
    slot_of_.assign(3, -1);
    const int outer = 3 * add_triangle();
    const std::int64_t far = 2 * grid_side;
    set_corner(outer, 0, {-far, -far});
    set_corner(outer + 1, 1, {2 * far, -far});
    set_corner(outer + 2, 2, {grid_side / 2, 2 * far});
    std::vector<int> inserted(count, -1), original = {-1, -1, -1};
    int near = 0;
    for (const std::vector<int>& loop : loops.loops)
        for (const int v : loop) {
            const Place place = locate(loops.corners[v], near, true);
            inserted[v] = place.triangle < 0 ? -1 : insert(place, Vector3::Zero());
            if (inserted[v] < 0) return Conflict{v, v};
            original.push_back(v);
            near = slot_of_[inserted[v]] / 3;
        }
    for (const std::vector<int>& loop : loops.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            if (auto conflict = enforce(inserted[loop[i]], inserted[loop[(i + 1) % loop.size()]])) {
                const auto name = [&](int v) { return v < 3 ? loop[i] : original[v]; };
                return Conflict{loop[i], name(conflict->second)};
            }
    // Even-odd from the outside.
    std::vector<int> depth(triangle_count(), -1);
    std::deque<int> queue = {slot_of_[0] / 3};
    depth[queue.front()] = 0;
    while (!queue.empty()) {
        const int t = queue.front();
        queue.pop_front();
        for (int s = 3 * t; s < 3 * t + 3; ++s) {
            const int twin = slots_[s].twin;
            if (twin < 0 || depth[twin / 3] >= 0) continue;
            depth[twin / 3] = depth[t] ^ (slots_[s].fixed ? 1 : 0);
            queue.push_back(twin / 3);
        }
    }
    for (int t = 0; t < triangle_count(); ++t) {
        if (depth[t] == 1) continue;
        for (int s = 3 * t; s < 3 * t + 3; ++s) {
            if (slots_[s].twin >= 0) slots_[slots_[s].twin].twin = -1;
            slots_[s] = {};
        }
    }
    for (int s = 0; s < slot_count(); ++s)
        if (slots_[s].vertex >= 0) slots_[s].vertex = original[slots_[s].vertex];
    slot_of_.assign(count, -1);
    for (int s = 0; s < slot_count(); ++s)
        if (slots_[s].vertex >= 0) slot_of_[slots_[s].vertex] = s;
    return std::nullopt;
}

void FaceTriangulation::glue(int a0, int a1, int b0, int b1) {
    const int a = find_edge(a0, a1), b = find_edge(b0, b1);
    if (a < 0 || b < 0 || a == b || slots_[a].twin >= 0 || slots_[b].twin >= 0) return;
    slots_[a].fixed = slots_[b].fixed = false;
    slots_[a].twin = b;
    slots_[b].twin = a;
}

void FaceTriangulation::rename(const std::vector<int>& names) {
    int count = 0;
    for (const int name : names) count = std::max(count, name + 1);
    slot_of_.assign(count, -1);
    for (int s = 0; s < slot_count(); ++s) {
        if (slots_[s].vertex < 0) continue;
        slots_[s].vertex = names[slots_[s].vertex];
        slot_of_[slots_[s].vertex] = s;
    }
}

void FaceTriangulation::set_points(std::vector<Vector3> points) {
    points_ = std::move(points);
}

}  // namespace umbilic
