// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/wireframe.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include <tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/umbilics/find.h>
#include <umbilic/wireframe/border_nodes.h>
#include <umbilic/wireframe/completion.h>
#include <umbilic/wireframe/face_frame.h>
#include <umbilic/wireframe/line_net.h>
#include <umbilic/wireframe/net_start.h>

namespace umbilic {

namespace {

/// Rounds in which edges get twice as many nodes because their chords cross.
constexpr int border_rounds = 6;
/// Both sides of a seam are a whole side of the domain apart, less this share.
constexpr double seam_slack = 1e-3;

/// Nodes that a step may ask for: some tens of microseconds and a kilobyte each.
constexpr double most_wanted = 1e6;

/// Throws if the step is so small that the work would not end.
void check_step(const Model& model, const WireframeOptions& options, double step) {
    double area = 0.0;
    for (const Face& face : model.faces)
        if (options.face == 0 || face.number == options.face) area += std::max(face.area, 0.0);
    const double least = std::sqrt(area / most_wanted);
    if (step >= least) return;
    std::ostringstream text;
    text << "wireframe: a step of " << step << " mm needs more than a million nodes; choose at least " << least
         << " mm";
    throw InvalidInput(text.str());
}

void check(const Model& model, const WireframeOptions& options) {
    const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
    if (options.step && !positive(*options.step)) throw InvalidInput("wireframe: the step must be finite and positive");
    if (!options.step && !positive(options.relative_step))
        throw InvalidInput("wireframe: the relative step must be finite and positive");
    if (!positive(options.most_nodes)) throw InvalidInput("wireframe: the budget of nodes must be finite and positive");
    if (options.face != 0) model.face(options.face);
    if (!options.umbilics_found.empty() && options.umbilics_found.size() != model.faces.size())
        throw InvalidInput("wireframe: the umbilics found before are not those of the model's faces");
    if (model.faces.empty()) throw InvalidInput("wireframe: the model has no faces");
}

int budget(const Face& face, const FaceBorder& border, const WireframeOptions& options, double step) {
    const double inner = options.most_nodes * std::max(face.area, 0.0) / (step * step);
    return static_cast<int>(std::min(inner, 1e7)) + 4 * border.identities + 64;
}

/// The parameters in which a face is joined to itself along its own seam edge: the surface may be closed only within
/// the tolerance of the model.
std::array<bool, 2> joined_to_itself(const Face& face, const FaceBorder& border) {
    const ParameterBox domain = face.surface.domain();
    std::map<int, Vector2> first;
    std::array<bool, 2> result = {false, false};
    for (const std::vector<BorderNode>& loop : border.loops)
        for (const BorderNode& node : loop) {
            if (node.kind != BorderKind::seam) continue;
            const Vector2 way = node.parameters - first.emplace(node.identity, node.parameters).first->second;
            result[0] = result[0] || std::abs(way.x()) > (1 - seam_slack) * domain.u.length();
            result[1] = result[1] || std::abs(way.y()) > (1 - seam_slack) * domain.v.length();
        }
    return result;
}

/// Of the lengths of all borders, if there are any.
std::optional<Vector3> centroid(const std::vector<FaceBorder>& borders) {
    WeightedPoints all;
    for (const FaceBorder& border : borders) {
        const WeightedPoints own = border_points(border);
        all.points.insert(all.points.end(), own.points.begin(), own.points.end());
        all.weights.insert(all.weights.end(), own.weights.begin(), own.weights.end());
    }
    return all.points.empty() ? std::nullopt : std::optional(all.centroid());
}

Completion mesh(const Face& face, const FaceBorder& border, const FaceFrame& frame, const FaceUmbilics* found,
                const WireframeOptions& options, double step, const Progress& progress) {
    FaceUmbilics umbilics;
    const bool small = face.area < 0.25 * step * step;
    if (options.umbilics && !small) umbilics = found ? *found : find_umbilics(face, {.certificate = false}, progress);
    LineNet net;
    LineField field;
    // A face smaller than a cell has no room for lines.
    if (!small)
        if (const std::optional<NetStart> start = net_start(face, border, frame, umbilics, step)) {
            field = start->field;
            const double lines = 16 + options.most_nodes * std::sqrt(face.area) / step;
            net = line_net(
                LineTracer(face, field), *start,
                {.step = step, .most_lines = static_cast<std::size_t>(std::min(lines, 1e6)), .drawn = options.drawn},
                progress);
        }
    return complete(face, border, frame, net, field,
                    {.step = step, .most_nodes = budget(face, border, options, step), .drawn = options.drawn},
                    progress);
}

Completion face_wireframe(const Face& face, const FaceBorder& border, const FaceFrame& frame, const FaceUmbilics* found,
                          const WireframeOptions& options, double step, const Progress& progress) {
    const auto [u, v] = joined_to_itself(face, border);
    if ((!u || face.u_closed || face.u_periodic) && (!v || face.v_closed || face.v_periodic))
        return mesh(face, border, frame, found, options, step, progress);
    Face closed = face;
    closed.u_closed = closed.u_closed || u;
    closed.v_closed = closed.v_closed || v;
    return mesh(closed, border, frame, found, options, step, progress);
}

}  // namespace

Wireframe wireframe(const Model& model, const WireframeOptions& options, const Progress& progress) {
    check(model, options);
    Wireframe result;
    result.step = options.step.value_or(options.relative_step * model.size());
    if (!(result.step > 0.0)) throw InvalidInput("wireframe: the model has no area; give a step in mm");
    check_step(model, options, result.step);

    const FaceAdjacency adjacency = face_adjacency(model, {}, progress.part(0.0, 0.05));
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < model.faces.size(); ++i)
        if (options.face == 0 || model.faces[i].number == options.face) wanted.push_back(i);
    std::vector<Completion> done(model.faces.size());
    BorderNodeOptions border_options{.step = result.step, .multiples = std::vector<int>(adjacency.edges.size(), 1)};
    std::vector<std::size_t> open = wanted;
    for (int round = 0; round < border_rounds && !open.empty(); ++round) {
        const std::vector<FaceBorder> borders = border_nodes(adjacency, border_options, progress.part(0.05, 0.1));
        const std::optional<Vector3> middle = centroid(borders);
        std::atomic<std::size_t> count = 0;
        const Progress faces = progress.part(0.1, 1.0);
        tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t k) {
            const std::size_t i = open[k];
            const FaceUmbilics* const found = options.umbilics_found.empty() ? nullptr : &options.umbilics_found[i];
            try {
                const FaceFrame frame = face_frame(model.faces[i], borders[i], middle, model.size());
                done[i] = face_wireframe(model.faces[i], borders[i], frame, found, options, result.step, faces);
            } catch (const NumericFailure& failure) {
                done[i] = {};
                done[i].wireframe.face = model.faces[i].number;
                done[i].wireframe.why = failure.what();
            }
            faces.report(static_cast<double>(++count) / static_cast<double>(open.size()), "wireframe");
        });
        // Edges whose chords cross get more nodes, and with them all faces that they bound.
        std::vector<bool> changed(adjacency.edges.size(), false);
        for (const std::size_t i : wanted)
            for (const int edge : done[i].crossing_edges) changed[edge] = true;
        for (std::size_t e = 0; e < changed.size(); ++e)
            if (changed[e]) border_options.multiples[e] *= 2;
        open.clear();
        for (const std::size_t i : wanted) {
            bool again = false;
            for (const auto& loop : adjacency.edges_of[i])
                for (const auto& curve : loop)
                    for (const int edge : curve) again = again || changed[edge];
            if (again) open.push_back(i);
            done[i].crossing_edges.clear();
        }
    }
    for (const std::size_t i : wanted) result.faces.push_back(std::move(done[i].wireframe));
    return result;
}

const char* name(WireKind kind) {
    switch (kind) {
        case WireKind::maximum:
            return "maximum";
        case WireKind::minimum:
            return "minimum";
        case WireKind::geodesic:
            return "geodesic";
        case WireKind::boundary:
            return "boundary";
    }
    return "";
}

}  // namespace umbilic
