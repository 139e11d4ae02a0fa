// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <umbilic/wireframe/wireframe.h>

#include <cli/commands.h>
#include <cli/console.h>
#include <cli/exit_status.h>
#include <cli/finite_numbers.h>
#include <cli/loading.h>
#include <occ_adapter/read_file.h>
#include <report/json_wireframe.h>
#include <report/readable.h>

namespace umbilic {

namespace {

std::string summary(const Model& model, const Wireframe& wireframe) {
    std::vector<std::vector<std::string>> rows;
    for (const FaceWireframe& face : wireframe.faces) {
        rows.push_back({std::to_string(face.face), name(model.face(face.face).kind), readable_count(face.nodes.size()),
                        readable_count(face.edges.size()), readable_count(face.cells.size()),
                        readable_count(face.quadrilaterals), readable(100.0 * face.coverage, 6) + " %",
                        readable(face.farthest), face.why});
    }
    return "Step " + readable(wireframe.step) + " mm\n" +
           table({"face", "surface", "nodes", "edges", "cells", "quadrilaterals", "coverage", "farthest, mm", ""}, rows,
                 {0, 2, 3, 4, 5, 6, 7});
}

/// Every edge once, as points from node to node. Edges on borders stand once for each face.
std::vector<std::vector<Vector3>> curves(const Wireframe& wireframe) {
    std::vector<std::vector<Vector3>> result;
    for (const FaceWireframe& face : wireframe.faces)
        for (const WireEdge& edge : face.edges) {
            std::vector<Vector3> points = {face.nodes[edge.from].curvature.point};
            points.insert(points.end(), edge.between.begin(), edge.between.end());
            points.push_back(face.nodes[edge.to].curvature.point);
            result.push_back(std::move(points));
        }
    return result;
}

}  // namespace

void add_wireframe(CLI::App& application, Session& session, Command& command) {
    struct Options {
        std::string path, output;
        WireframeOptions wireframe;
    };
    auto* const subcommand =
        application.add_subcommand("wireframe", "Nodes, edges and cells that depend on the shape alone");
    const auto options = std::make_shared<Options>();
    subcommand->add_option("FILE", options->path, "STEP, IGES or BREP file")->required();
    subcommand->add_option("--face", options->wireframe.face, "Only this face, from 1")->check(finite_number(false));
    auto* const step = subcommand->add_option("--step", options->wireframe.step, "Distance of neighbouring lines, mm")
                           ->check(finite_number(false));
    subcommand
        ->add_option("--relative_step", options->wireframe.relative_step,
                     "The same relative to the square root of the model's area")
        ->check(finite_number(false))
        ->excludes(step);
    subcommand->add_option("-o,--output", options->output, "STEP file for the edges");
    add_common_options(*subcommand, session);
    subcommand->callback([&session, &command, options] {
        command = [&session, options] {
            const Progress& progress = session.progress;
            const ReadResult read = load(session, options->path, {}, progress.part(0.0, 0.3));
            const Model& model = read.model;
            if (const int wanted = options->wireframe.face;
                wanted > 0 && std::none_of(model.faces.begin(), model.faces.end(),
                                           [&](const Face& face) { return face.number == wanted; }))
                throw WrongUse(options->path + ": has no face " + std::to_string(wanted) +
                               "; umbilic info lists its faces");
            const Wireframe found =
                as_asked(options->path, [&] { return wireframe(model, options->wireframe, progress.part(0.3, 1.0)); });
            if (!options->output.empty()) write_curves_step(curves(found), options->output);
            clear_progress_bar();
            print(session, bold(printable(options->path)) + "\n" + summary(model, found));
            write_json(session, wireframe_json(model, found));
            return exit_done;
        };
    });
}

}  // namespace umbilic
