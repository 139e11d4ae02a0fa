// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/wireframe_nodes.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <umbilic/wireframe/wireframe.h>

namespace umbilic {

namespace {

/// Nodes a face may have, as a multiple of its area / step^2: ordinary faces have one to one and a half.
constexpr double most_nodes = 4.0;
/// A face has at least this share of area / step^2 as inner nodes, or area samples stand for it: faces that are narrow
/// against the step consist of border.
constexpr double least_nodes = 0.5;

bool stands_for(const FaceWireframe& wireframe, const Face& face, double step, int inner) {
    return wireframe.why.empty() && inner > 0 && inner >= least_nodes * face.area / (step * step);
}

}  // namespace

NodeSet wireframe_nodes(const PreparedModel& prepared, int count, const Progress& progress) {
    const Model& model = prepared.model;
    const double step = model.size() / std::sqrt(static_cast<double>(std::max(count, 1)));
    if (!(step > 0.0)) return area_nodes(prepared);
    const Wireframe found = wireframe(
        model, {.step = step, .most_nodes = most_nodes, .drawn = false, .umbilics_found = prepared.features.umbilics},
        progress);

    std::map<int, std::vector<const AreaSample*>> samples;
    for (const AreaSample& sample : prepared.features.samples) samples[sample.at.face].push_back(&sample);
    NodeSet result;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const Face& face = model.faces[f];
        const FaceWireframe& of_face = found.faces[f];
        std::vector<AreaSample> inner;
        double area = 0.0;
        for (const WireNode& node : of_face.nodes) {
            if (node.on_border || !node.curvature.regular || !(node.area > 0.0)) continue;
            inner.push_back({node.at, node.curvature, node.area});
            area += node.area;
        }
        if (stands_for(of_face, face, step, static_cast<int>(inner.size()))) {
            for (AreaSample& node : inner) {
                node.weight *= face.area / area;
                result.nodes.push_back(node);
            }
            result.of_wireframe += static_cast<int>(inner.size());
        } else {
            for (const AreaSample* sample : samples[face.number]) result.nodes.push_back(*sample);
            ++result.area_faces;
        }
    }
    return result;
}

NodeSet area_nodes(const PreparedModel& prepared) {
    return {.nodes = prepared.features.samples, .area_faces = static_cast<int>(prepared.model.faces.size())};
}

const char* name(NodeChoice choice) {
    return choice == NodeChoice::wireframe ? "wireframe" : "area";
}

}  // namespace umbilic
