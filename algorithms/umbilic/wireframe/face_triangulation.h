// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <umbilic/core/types.h>

namespace umbilic {

/// Point of a face's parameter box on a grid of 2^28 steps a side: whether three of them turn left is decided exactly.
struct GridPoint {
    std::int64_t x = 0, y = 0;

    GridPoint operator+(const GridPoint& o) const { return {x + o.x, y + o.y}; }
    GridPoint operator-(const GridPoint& o) const { return {x - o.x, y - o.y}; }
    bool operator==(const GridPoint&) const = default;
};

inline constexpr std::int64_t grid_side = std::int64_t(1) << 28;

/// Twice the signed area of a triangle: positive if it turns left.
std::int64_t orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// Triangulation of a face by nodes, embedded in its parameter plane; where the surface is closed the plane is glued
/// and triangles may reach across the seam. Triangle t has the slots 3 t, 3 t + 1, 3 t + 2 in counter-clockwise order;
/// the edge of a slot is the one opposite to its corner.
class FaceTriangulation {
public:
    struct Slot {
        int vertex = -1;  ///< of the corner; -1 in triangles that are gone
        GridPoint corner;
        int twin = -1;       ///< slot of the same edge in the neighbour; -1 at the border
        bool fixed = false;  ///< the edge must stay
    };

    /// Vertices of the loops in order, and which vertices at the other side of a seam are the same points.
    struct Loops {
        std::vector<std::vector<int>> loops;
        std::vector<GridPoint> corners;  ///< by vertex
    };

    /// Why two segments of the loops, each named by its first vertex, cannot be triangulated: they cross or touch.
    struct Conflict {
        int first = 0, second = 0;
    };

    /// Constrained triangulation of what the loops bound (even-odd rule). `aspect` is the ratio of the lengths that
    /// one grid step in x and one in y have in space, in the mean. Returns the conflict if the segments cross.
    std::optional<Conflict> build(const Loops& loops, double aspect);

    /// Joins the border edges (a0, a1) and (b1, b0) where the surface is closed; to be called for all seam edges, then
    /// rename() once.
    void glue(int a0, int a1, int b0, int b1);
    /// Squared lengths in space near a point of the plane: x'x times (0, 0), x'y times (0, 1), y'y times (1, 1). From
    /// now on, until improve(), flips follow circles in it rather than in one metric for all of the plane.
    void set_metric(std::function<Matrix2(const GridPoint&)> metric) { metric_ = std::move(metric); }

    /// Replaces vertex numbers.
    void rename(const std::vector<int>& names);

    /// Positions in space of all vertices.
    void set_points(std::vector<Vector3> points);
    const std::vector<Vector3>& points() const { return points_; }
    /// Flips edges until no flip makes the least angle in space of two triangles greater, and so from now on after
    /// every change; before, flips follow the circles in the parameter plane. Between diagonals that are equally good
    /// (of a rectangle, say) the one more along `preferred`, a unit vector, is taken.
    void improve(const Vector3& preferred);

    struct Place {
        int triangle = -1;
        GridPoint at;          ///< in the triangle's frame
        bool outside = false;  ///< the way to it leads over a border
    };
    /// The triangle that holds a point, walking from `triangle`. With `search`, all triangles are looked at if the
    /// straight way leads over a border.
    Place locate(GridPoint at, int triangle, bool search) const;

    /// Adds a vertex in the place, flips around it, and returns its number; -1 if it falls on another vertex or a
    /// fixed edge.
    int insert(const Place& place, const Vector3& point);
    /// Takes an inner vertex out again. False if its neighbours cannot be joined without it.
    bool remove(int vertex);

    int slot_count() const { return static_cast<int>(slots_.size()); }
    const Slot& slot(int i) const { return slots_[i]; }
    int triangle_count() const { return slot_count() / 3; }
    bool alive(int triangle) const { return slots_[3 * triangle].vertex >= 0; }
    int vertex_count() const { return static_cast<int>(slot_of_.size()); }
    /// Changes whenever the triangle does.
    unsigned version(int triangle) const { return versions_[triangle]; }
    /// Triangles that changed or were added since the last call, each once, in increasing order.
    std::vector<int> take_changed();

    static int next(int slot) { return slot - slot % 3 + (slot % 3 + 1) % 3; }
    static int previous(int slot) { return slot - slot % 3 + (slot % 3 + 2) % 3; }

private:
    int add_triangle();
    void set_corner(int slot, int vertex, const GridPoint& corner);
    void link(int a, int b);
    bool convex(int slot) const;
    void flip(int slot);
    bool should_flip(int slot) const;
    void legalise(std::vector<int>& stack);
    int find_edge(int from, int to) const;
    std::optional<Conflict> enforce(int from, int to);
    GridPoint opposite(int slot) const;
    double least_angle(int a, int b, int c) const;
    double along_preferred(int a, int b) const;

    std::vector<Slot> slots_;
    std::vector<unsigned> versions_;
    std::vector<int> slot_of_;  ///< some slot of each vertex, or -1
    std::vector<Vector3> points_;
    std::vector<int> free_;
    std::vector<int> changed_;
    double aspect_ = 1.0;
    std::function<Matrix2(const GridPoint&)> metric_;
    bool in_space_ = false;
    Vector3 preferred_ = Vector3::Zero();
    mutable int last_ = 0;
};

}  // namespace umbilic
