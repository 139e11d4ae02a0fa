// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes in what the net of a face leaves open.
#include <umbilic/wireframe/face_completion.h>

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace umbilic {

namespace {

/// New nodes come no nearer to the border than this.
constexpr double least_new_distance = 0.317;
/// A triangle whose circle is too large gets a node in the middle of its longest edge if its circle's centre is not on
/// the face and that edge is longer than this.
constexpr double longest_edge = 1.211;
/// A triangle's circle may be as large as this share of the step.
constexpr double greatest_radius = 0.983;
constexpr int most_corrections = 20;
constexpr double relative_correction = 1e-12;

double circumradius(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double area = (b - a).cross(c - a).norm();
    if (!(area > 0.0)) return std::numeric_limits<double>::infinity();
    return (b - a).norm() * (c - b).norm() * (a - c).norm() / (2 * area);
}

}  // namespace

/// Newton's method for the point of the surface on two planes n . x = d, not farther than `reach` (mm) from p.
std::optional<Vector2> FaceCompletion::solve(Vector2 p, const Vector3& n1, double d1, const Vector3& n2, double d2,
                                             double reach) const {
    double way = 0.0;
    for (int i = 0; i < most_corrections; ++i) {
        const Vector2 at = wrapped(p);
        const SurfaceDerivatives d = face_.surface.derivatives(at.x(), at.y(), 1);
        Matrix2 jacobian;
        jacobian << n1.dot(d.r_u()), n1.dot(d.r_v()), n2.dot(d.r_u()), n2.dot(d.r_v());
        const Vector2 step = jacobian.fullPivLu().solve(Vector2(n1.dot(d.r()) - d1, n2.dot(d.r()) - d2));
        if (!step.allFinite()) return std::nullopt;
        const double moved = (d.r_u() * step.x() + d.r_v() * step.y()).norm();
        way += moved;
        if (!(way <= reach)) return std::nullopt;
        p -= step;
        if (moved <= relative_correction * options_.step) return p;
    }
    return std::nullopt;
}

/// The point of the surface equally far from the corners, in the triangle's frame.
std::optional<Vector2> FaceCompletion::circumcentre(int triangle) const {
    const auto& s = [&](int k) { return mesh_.slot(3 * triangle + k); };
    const std::vector<Vector3>& points = mesh_.points();
    const Vector3 &a = points[s(0).vertex], &b = points[s(1).vertex], &c = points[s(2).vertex];
    // Barycentric coordinates of the centre in the plane of the corners.
    const double la = (c - b).squaredNorm(), lb = (a - c).squaredNorm(), lc = (b - a).squaredNorm();
    Vector3 w(la * (lb + lc - la), lb * (lc + la - lb), lc * (la + lb - lc));
    const double sum = w.sum();
    if (!(sum > 0.0)) return std::nullopt;
    w /= sum;
    if (w.cwiseAbs().maxCoeff() > 3.0) w = Vector3::Constant(1.0 / 3.0);
    double x = 0.0, y = 0.0;
    for (int k = 0; k < 3; ++k) {
        x += w[k] * static_cast<double>(s(k).corner.x);
        y += w[k] * static_cast<double>(s(k).corner.y);
    }
    const double reach = 4 * std::sqrt(std::max({la, lb, lc}));
    return solve(from_grid(x, y), b - a, 0.5 * (b.squaredNorm() - a.squaredNorm()), c - a,
                 0.5 * (c.squaredNorm() - a.squaredNorm()), reach);
}

/// The point of the surface above the middle of an edge, equally far from its ends, in the frame of the slot.
std::optional<Vector2> FaceCompletion::edge_middle(int slot) const {
    const FaceTriangulation::Slot &s = mesh_.slot(FaceTriangulation::next(slot)),
                                  &t = mesh_.slot(FaceTriangulation::previous(slot));
    const Vector3 &a = mesh_.points()[s.vertex], &b = mesh_.points()[t.vertex];
    const Vector2 p = from_grid(0.5 * static_cast<double>(s.corner.x + t.corner.x),
                                0.5 * static_cast<double>(s.corner.y + t.corner.y));
    const Vector2 at = wrapped(p);
    const SurfaceDerivatives d = face_.surface.derivatives(at.x(), at.y(), 1);
    const Vector3 middle = 0.5 * (a + b), side = d.r_u().cross(d.r_v()).cross(b - a);
    if (!(side.norm() > 0.0)) return std::nullopt;
    return solve(p, b - a, (b - a).dot(middle), side.normalized(), side.normalized().dot(middle), 4 * (b - a).norm());
}

/// False if the budget of nodes is spent.
bool FaceCompletion::refine() {
    const double step = options_.step;
    struct Entry {
        double rank;
        int triangle;
        unsigned version;
        bool operator<(const Entry& o) const { return std::tie(rank, o.triangle) < std::tie(o.rank, triangle); }
    };
    std::priority_queue<Entry> queue;
    const auto look = [&](int triangle) {
        if (!mesh_.alive(triangle)) return;
        const int a = mesh_.slot(3 * triangle).vertex, b = mesh_.slot(3 * triangle + 1).vertex,
                  c = mesh_.slot(3 * triangle + 2).vertex;
        if (a == b || b == c || c == a) return;
        const double radius = circumradius(mesh_.points()[a], mesh_.points()[b], mesh_.points()[c]);
        if (!(radius > greatest_radius * step)) return;
        const Vector3 middle = (mesh_.points()[a] + mesh_.points()[b] + mesh_.points()[c]) / 3;
        queue.push({radius * (1 + preference_share * frame_.preference(middle)), triangle, mesh_.version(triangle)});
    };
    for (int t = 0; t < mesh_.triangle_count(); ++t) look(t);
    mesh_.take_changed();
    while (!queue.empty()) {
        progress_.check();
        const Entry entry = queue.top();
        queue.pop();
        if (!mesh_.alive(entry.triangle) || mesh_.version(entry.triangle) != entry.version) continue;
        if (mesh_.vertex_count() >= options_.most_nodes) return false;
        const auto try_insert = [&](const std::optional<Vector2>& p, double least) {
            if (!p) return false;
            const Vector2 at = wrapped(*p);
            const Vector3 point = face_.surface.value(at.x(), at.y());
            if (border_distance(point) < least_new_distance * step) return false;
            const FaceTriangulation::Place place = mesh_.locate(to_grid(*p), entry.triangle, false);
            if (place.outside) return false;
            for (int s = 3 * place.triangle; s < 3 * place.triangle + 3; ++s)
                if ((mesh_.points()[mesh_.slot(s).vertex] - point).norm() < least) return false;
            return add_vertex(place, at, point) >= 0;
        };
        bool added = try_insert(circumcentre(entry.triangle), 0.7 * step);
        if (!added) {
            int longest = -1;
            double length = longest_edge * step;
            for (int s = 3 * entry.triangle; s < 3 * entry.triangle + 3; ++s) {
                const double l = (mesh_.points()[mesh_.slot(FaceTriangulation::next(s)).vertex] -
                                  mesh_.points()[mesh_.slot(FaceTriangulation::previous(s)).vertex])
                                     .norm();
                if (l > length && mesh_.slot(s).twin >= 0) {
                    length = l;
                    longest = s;
                }
            }
            if (longest >= 0) added = try_insert(edge_middle(longest), 0.3 * step);
        }
        if (!added) continue;
        for (const int triangle : mesh_.take_changed()) look(triangle);
    }
    return true;
}

}  // namespace umbilic
