// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/wireframe.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include <tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/umbilics/find.h>
#include <umbilic/wireframe/border_nodes.h>
#include <umbilic/wireframe/completion.h>
#include <umbilic/wireframe/line_net.h>
#include <umbilic/wireframe/net_start.h>

namespace umbilic {

namespace {

/// Rounds in which edges get twice as many nodes because their chords cross.
constexpr int border_rounds = 6;

void check(const Model& model, const WireframeOptions& options) {
    const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
    if (options.step && !positive(*options.step)) throw InvalidInput("wireframe: the step must be finite and positive");
    if (!options.step && !positive(options.relative_step))
        throw InvalidInput("wireframe: the relative step must be finite and positive");
    if (!positive(options.most_nodes)) throw InvalidInput("wireframe: the budget of nodes must be finite and positive");
    if (options.face != 0) model.face(options.face);
    if (model.faces.empty()) throw InvalidInput("wireframe: the model has no faces");
}

int budget(const Face& face, const FaceBorder& border, const WireframeOptions& options, double step) {
    const double inner = options.most_nodes * std::max(face.area, 0.0) / (step * step);
    return static_cast<int>(std::min(inner, 1e7)) + 4 * border.identities + 64;
}

Completion face_wireframe(const Face& face, const FaceBorder& border, const WireframeOptions& options, double step,
                          const Progress& progress) {
    FaceUmbilics umbilics;
    const bool small = face.area < 0.25 * step * step;
    if (options.umbilics && !small) umbilics = find_umbilics(face, {.certificate = false}, progress);
    LineNet net;
    LineField field;
    // A face smaller than a cell has no room for lines.
    if (!small)
        if (const std::optional<NetStart> start = net_start(face, border, umbilics, step)) {
            field = start->field;
            const double lines = 16 + options.most_nodes * std::sqrt(face.area) / step;
            net = line_net(LineTracer(face, field), *start,
                           {.step = step, .most_lines = static_cast<std::size_t>(std::min(lines, 1e6))}, progress);
        }
    return complete(face, border, net, field, {.step = step, .most_nodes = budget(face, border, options, step)},
                    progress);
}

}  // namespace

Wireframe wireframe(const Model& model, const WireframeOptions& options, const Progress& progress) {
    check(model, options);
    Wireframe result;
    result.step = options.step.value_or(options.relative_step * model.size());
    if (!(result.step > 0.0)) throw InvalidInput("wireframe: the model has no area; give a step in mm");

    const FaceAdjacency adjacency = face_adjacency(model, {}, progress.part(0.0, 0.05));
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < model.faces.size(); ++i)
        if (options.face == 0 || model.faces[i].number == options.face) wanted.push_back(i);
    std::vector<Completion> done(model.faces.size());
    BorderNodeOptions border_options{.step = result.step, .multiples = std::vector<int>(adjacency.edges.size(), 1)};
    std::vector<std::size_t> open = wanted;
    for (int round = 0; round < border_rounds && !open.empty(); ++round) {
        const std::vector<FaceBorder> borders = border_nodes(adjacency, border_options, progress.part(0.05, 0.1));
        std::atomic<std::size_t> count = 0;
        const Progress faces = progress.part(0.1, 1.0);
        tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t k) {
            const std::size_t i = open[k];
            try {
                done[i] = face_wireframe(model.faces[i], borders[i], options, result.step, faces);
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
