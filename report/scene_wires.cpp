// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/scene_wires.h>

#include <array>
#include <map>
#include <string>

#include <report/packed.h>

namespace umbilic {

SceneWires scene_wires(const Wireframe& wireframe) {
    SceneWires wires;
    wires.step = wireframe.step;
    for (const FaceWireframe& face : wireframe.faces) {
        for (const WireNode& node : face.nodes) wires.nodes.push_back(node.curvature.point);
        for (const WireEdge& edge : face.edges) {
            SceneWires::Line line{edge.kind, {face.nodes[edge.from].curvature.point}};
            line.points.insert(line.points.end(), edge.between.begin(), edge.between.end());
            line.points.push_back(face.nodes[edge.to].curvature.point);
            wires.lines.push_back(std::move(line));
        }
    }
    return wires;
}

Color color_of(WireKind kind) {
    switch (kind) {
        case WireKind::maximum:
            return {0.75f, 0.22f, 0.17f};
        case WireKind::minimum:
            return {0.14f, 0.38f, 0.65f};
        case WireKind::geodesic:
            return {0.52f, 0.53f, 0.55f};
        case WireKind::boundary:
            return {0.13f, 0.13f, 0.13f};
    }
    return {};
}

Json wires_json(const SceneWires& wires, const Vector3& center) {
    using Numbers = std::vector<std::array<double, 3>>;
    const auto add = [&](Numbers& numbers, const Vector3& point) {
        const Vector3 p = point - center;  // single precision suffices near the origin
        numbers.push_back({p.x(), p.y(), p.z()});
    };
    Numbers nodes;
    for (const Vector3& node : wires.nodes) add(nodes, node);
    std::map<WireKind, Numbers> pieces;
    for (const SceneWires::Line& line : wires.lines)
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            add(pieces[line.kind], line.points[i - 1]);
            add(pieces[line.kind], line.points[i]);
        }
    Json kinds = Json::array();
    for (const auto& [kind, ends] : pieces)
        kinds.push_back({{"kind", name(kind)}, {"color", hex(color_of(kind))}, {"ends", packed<float>(ends)}});
    return {{"nodes", packed<float>(nodes)}, {"kinds", std::move(kinds)}};
}

}  // namespace umbilic
