// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/completion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <queue>
#include <set>
#include <tuple>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <umbilic/differential/curvature.h>
#include <umbilic/wireframe/face_triangulation.h>
#include <umbilic/wireframe/point_cells.h>

namespace umbilic {

namespace {

/// Gap between the ends of two border curves that meet in space, relative to the sides of the parameter box.
constexpr double loose_end = 1e-5;
/// Nodes of the net nearer to the border than this share of the step are left out.
constexpr double least_border_distance = 0.447;
/// Middles of a border's segments are asked for as far as this.
constexpr double border_reach = least_border_distance + 0.5 * longest_stretch / (between_count + 1);
/// And those nearer than this to each other.
constexpr double least_node_distance = 0.337;
/// A part of a line that is longer than this times its chord is no side of a cell.
constexpr double greatest_bend = 1.2;
/// New nodes come no nearer to the border than this.
constexpr double least_new_distance = 0.317;
/// A triangle whose circle is too large gets a node in the middle of its longest edge if its circle's centre is not on
/// the face and that edge is longer than this.
constexpr double longest_edge = 1.211;
/// A triangle's circle may be as large as this share of the step.
constexpr double greatest_radius = 0.983;
/// Two triangles without a part of a line between them become a quadrilateral if its corners differ from right angles
/// by less than this.
constexpr double greatest_corner_bend = 0.8;
/// Of triangles, or crossings, that differ by less than this share, the one that the face's frame prefers comes first.
constexpr double preference_share = 1e-3;
constexpr int most_corrections = 20;
constexpr double relative_correction = 1e-12;
/// Points of an edge between its ends.
constexpr int between_points = 3;

/// Barycentric coordinates of the samples of a cell.
constexpr std::array<std::array<double, 3>, 6> cell_samples = {
    {{0.7, 0.15, 0.15}, {0.15, 0.7, 0.15}, {0.15, 0.15, 0.7}, {0.45, 0.45, 0.1}, {0.45, 0.1, 0.45}, {0.1, 0.45, 0.45}}};

double segment_distance(const Vector3& p, const Vector3& a, const Vector3& b) {
    const Vector3 d = b - a;
    const double length = d.squaredNorm();
    const double t = length > 0.0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0.0;
    return (p - a - t * d).norm();
}

double circumradius(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double area = (b - a).cross(c - a).norm();
    if (!(area > 0.0)) return std::numeric_limits<double>::infinity();
    return (b - a).norm() * (c - b).norm() * (a - c).norm() / (2 * area);
}

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

class FaceCompletion {
public:
    FaceCompletion(const Face& face, const FaceBorder& border, const FaceFrame& frame, const LineNet& net,
                   const LineField& field, const CompletionOptions& options, const Progress& progress)
        : face_(face),
          border_(border),
          frame_(frame),
          net_(net),
          field_(field),
          options_(options),
          progress_(progress),
          border_segments_(std::max(options.step, 1e-300)) {}

    Completion run();

private:
    struct Vertex {
        Vector2 parameters;
        bool on_border = false;
    };

    GridPoint to_grid(const Vector2& p) const {
        const auto coordinate = [](double x, const ParameterInterval& range) {
            return static_cast<std::int64_t>(
                std::llround((x - range.low) / range.length() * static_cast<double>(grid_side)));
        };
        return {coordinate(p.x(), box_.u), coordinate(p.y(), box_.v)};
    }
    Vector2 from_grid(double x, double y) const {
        return {box_.u.low + box_.u.length() * x / static_cast<double>(grid_side),
                box_.v.low + box_.v.length() * y / static_cast<double>(grid_side)};
    }
    Vector2 wrapped(Vector2 p) const;
    bool build_border(Completion& result);
    void add_net();
    void remove_seam();
    bool refine();
    std::optional<Vector2> circumcentre(int triangle) const;
    std::optional<Vector2> edge_middle(int slot) const;
    std::optional<Vector2> solve(Vector2 p, const Vector3& n1, double d1, const Vector3& n2, double d2,
                                 double reach) const;
    double border_distance(const Vector3& p) const;
    int add_vertex(const FaceTriangulation::Place& place, const Vector2& p, const Vector3& point);
    FaceWireframe assemble() const;
    void measure(FaceWireframe& wireframe, const std::vector<int>& node_of) const;

    const Face& face_;
    const FaceBorder& border_;
    const FaceFrame& frame_;
    const LineNet& net_;
    const LineField& field_;
    const CompletionOptions& options_;
    const Progress& progress_;

    ParameterBox box_;
    bool u_closed_ = false, v_closed_ = false;
    FaceTriangulation mesh_;
    std::vector<Vertex> vertices_;
    std::vector<int> net_vertex_;
    struct Segment {
        Vector3 a, b;
    };
    PointCells<Segment> border_segments_;
    bool exhausted_ = false;
};

Vector2 FaceCompletion::wrapped(Vector2 p) const {
    const ParameterBox domain = face_.surface.domain();
    if (u_closed_) p.x() -= domain.u.length() * std::floor((p.x() - domain.u.low) / domain.u.length());
    if (v_closed_) p.y() -= domain.v.length() * std::floor((p.y() - domain.v.low) / domain.v.length());
    return {domain.u.clamp(p.x()), domain.v.clamp(p.y())};
}

bool FaceCompletion::build_border(Completion& result) {
    const ParameterBox domain = face_.surface.domain();
    u_closed_ = face_.u_closed || face_.u_periodic;
    v_closed_ = face_.v_closed || face_.v_periodic;
    box_ = {{domain.u.high, domain.u.low}, {domain.v.high, domain.v.low}};
    for (const std::vector<BorderNode>& loop : border_.loops)
        for (const BorderNode& node : loop) {
            box_.u = {std::min(box_.u.low, node.parameters.x()), std::max(box_.u.high, node.parameters.x())};
            box_.v = {std::min(box_.v.low, node.parameters.y()), std::max(box_.v.high, node.parameters.y())};
        }
    if (u_closed_) box_.u = domain.u;
    if (v_closed_) box_.v = domain.v;
    if (!(box_.u.length() > 0.0 && box_.v.length() > 0.0)) {
        result.wireframe.why = "the border has no extent in the parameter plane";
        return false;
    }

    // Copies of the nodes as corners in the parameter plane.
    FaceTriangulation::Loops loops;
    std::vector<const BorderNode*> copies;
    // Where the curves of a loop do not meet exactly in the parameter plane the same point follows itself.
    const auto same = [&](int copy, const GridPoint& at, const BorderNode& node) {
        const GridPoint gap = loops.corners[copy] - at;
        const double most = copies[copy]->identity == node.identity ? loose_end * static_cast<double>(grid_side) : 0.0;
        return std::abs(static_cast<double>(gap.x)) <= most && std::abs(static_cast<double>(gap.y)) <= most;
    };
    for (const std::vector<BorderNode>& loop : border_.loops) {
        std::vector<int> corners;
        for (const BorderNode& node : loop) {
            const GridPoint at = to_grid(node.parameters);
            if (!corners.empty() && same(corners.back(), at, node)) {
                copies.back() = &node;
                loops.corners.back() = at;
                continue;
            }
            corners.push_back(static_cast<int>(copies.size()));
            copies.push_back(&node);
            loops.corners.push_back(at);
        }
        if (corners.size() > 1 && same(corners.back(), loops.corners[corners.front()], *copies[corners.front()])) {
            corners.pop_back();
            copies.pop_back();
            loops.corners.pop_back();
        }
        if (corners.size() < 3) {
            result.wireframe.why = "a loop of the border has fewer than three distinct nodes";
            return false;
        }
        loops.loops.push_back(std::move(corners));
        for (std::size_t i = 0; i < loop.size(); ++i) {
            if (loop[i].kind != BorderKind::border) continue;
            Vector3 before = loop[i].point;
            std::vector<Vector3> way = loop[i].between;
            way.push_back(loop[(i + 1) % loop.size()].point);
            for (const Vector3& next : way) {
                border_segments_.add(0.5 * (before + next), {before, next});
                before = next;
            }
        }
    }
    const SurfaceDerivatives middle = face_.surface.derivatives(box_.u.middle(), box_.v.middle(), 1);
    const double aspect = std::clamp(
        middle.r_u().norm() * box_.u.length() / std::max(middle.r_v().norm() * box_.v.length(), 1e-300), 1e-4, 1e4);
    if (const auto conflict = mesh_.build(loops, aspect)) {
        for (const int copy : {conflict->first, conflict->second})
            if (copies[copy]->edge >= 0) result.crossing_edges.push_back(copies[copy]->edge);
        result.wireframe.why = "the chords between the border's nodes cross in the parameter plane";
        return false;
    }

    // Both sides of a seam.
    std::map<std::tuple<int, int, int>, std::pair<int, int>> open;
    for (const std::vector<int>& loop : loops.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const int from = loop[i], to = loop[(i + 1) % loop.size()];
            if (copies[from]->kind != BorderKind::seam) continue;
            const std::tuple<int, int, int> same = {copies[from]->edge, copies[to]->identity, copies[from]->identity};
            if (const auto found = open.find(same); found != open.end()) {
                mesh_.glue(from, to, found->second.first, found->second.second);
                open.erase(found);
            } else {
                open[{copies[from]->edge, copies[from]->identity, copies[to]->identity}] = {from, to};
            }
        }
    std::vector<int> names;
    vertices_.resize(border_.identities);
    std::vector<Vector3> points(border_.identities, Vector3::Zero());
    for (const BorderNode* node : copies) {
        names.push_back(node->identity);
        vertices_[node->identity] = {node->parameters, border_.on_border[node->identity]};
        points[node->identity] = node->point;
    }
    mesh_.rename(names);
    mesh_.set_points(std::move(points));
    return true;
}

double FaceCompletion::border_distance(const Vector3& p) const {
    double distance = options_.step;
    border_segments_.near(p, border_reach * options_.step,
                          [&](const Segment& s) { distance = std::min(distance, segment_distance(p, s.a, s.b)); });
    return distance;
}

int FaceCompletion::add_vertex(const FaceTriangulation::Place& place, const Vector2& p, const Vector3& point) {
    const int vertex = mesh_.insert(place, point);
    if (vertex < 0) return -1;
    vertices_.resize(std::max<std::size_t>(vertices_.size(), vertex + 1));
    vertices_[vertex] = {p, false};
    return vertex;
}

void FaceCompletion::add_net() {
    net_vertex_.assign(net_.nodes.size(), -1);
    mesh_.set_metric([this](const GridPoint& p) -> Matrix2 {
        const Vector2 at = wrapped(from_grid(static_cast<double>(p.x), static_cast<double>(p.y)));
        const SurfaceDerivatives d = face_.surface.derivatives(at.x(), at.y(), 1);
        const double u = box_.u.length(), v = box_.v.length();
        Matrix2 metric;
        metric(0, 0) = u * u * d.r_u().squaredNorm();
        metric(0, 1) = metric(1, 0) = u * v * d.r_u().dot(d.r_v());
        metric(1, 1) = v * v * d.r_v().squaredNorm();
        return metric;
    });
    // Near umbilics lines cross in a small space: the crossing that is nearer to the start stays.
    std::vector<int> order(net_.nodes.size());
    std::iota(order.begin(), order.end(), 0);
    const auto rank = [&](int i) {
        return net_.nodes[i].distance * (1 - preference_share * frame_.preference(net_.nodes[i].point));
    };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
    PointCells<int> kept(options_.step);
    for (const int i : order) {
        const NetNode& node = net_.nodes[i];
        if (border_distance(node.point) < least_border_distance * options_.step) continue;
        bool crowded = false;
        kept.near(node.point, least_node_distance * options_.step, [&](int other) {
            crowded = crowded || (net_.nodes[other].point - node.point).norm() < least_node_distance * options_.step;
        });
        if (crowded) continue;
        const FaceTriangulation::Place place = mesh_.locate(to_grid(node.parameters), -1, true);
        if (place.outside) continue;
        net_vertex_[i] = add_vertex(place, node.parameters, node.point);
        if (net_vertex_[i] >= 0) kept.add(node.point, i);
    }
}

/// Nodes of the seam served to glue the parameter plane; they are no points of the shape.
void FaceCompletion::remove_seam() {
    // Without any other node they have to stay.
    if (mesh_.vertex_count() < border_.identities + 3 &&
        std::none_of(border_.on_border.begin(), border_.on_border.end(), [](bool on) { return on; }))
        return;
    for (int v = 0; v < border_.identities; ++v)
        if (!border_.on_border[v]) mesh_.remove(v);
}

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
        for (int k = 0; k < 3; ++k) {
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
    wireframe.coverage = area > 0.0 ? covered / area : 1.0;
}

Completion FaceCompletion::run() {
    Completion result;
    result.wireframe.face = face_.number;
    if (!build_border(result)) return result;
    add_net();
    mesh_.improve(frame_.lean);
    remove_seam();
    const bool whole = refine();
    result.wireframe = assemble();
    if (!whole) result.wireframe.why = "the budget of nodes is spent; choose a larger step";
    return result;
}

}  // namespace

Completion complete(const Face& face, const FaceBorder& border, const FaceFrame& frame, const LineNet& net,
                    const LineField& field, const CompletionOptions& options, const Progress& progress) {
    return FaceCompletion(face, border, frame, net, field, options, progress).run();
}

}  // namespace umbilic
