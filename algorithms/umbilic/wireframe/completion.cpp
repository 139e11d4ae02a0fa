// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/completion.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include <Eigen/Geometry>

#include <umbilic/wireframe/face_completion.h>

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

double segment_distance(const Vector3& p, const Vector3& a, const Vector3& b) {
    const Vector3 d = b - a;
    const double length = d.squaredNorm();
    const double t = length > 0.0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0.0;
    return (p - a - t * d).norm();
}

}  // namespace

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

Completion complete(const Face& face, const FaceBorder& border, const FaceFrame& frame, const LineNet& net,
                    const LineField& field, const CompletionOptions& options, const Progress& progress) {
    return FaceCompletion(face, border, frame, net, field, options, progress).run();
}

}  // namespace umbilic
