// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/json_wireframe.h>

#include <report/json_geometry.h>

namespace umbilic {

namespace {

Json node_json(const Face& face, const WireNode& node) {
    const Vector2 native = native_parameters(face, node.at.u, node.at.v);
    const Curvature& c = node.curvature;
    Json json = {{"u", number_json(native.x())}, {"v", number_json(native.y())}, {"point", vector_json(c.point)}};
    json["normal"] = c.regular ? vector_json(c.normal) : Json(nullptr);
    json["kappa"] = c.regular ? Json({number_json(c.kappa_max), number_json(c.kappa_min)}) : Json(nullptr);
    json["direction"] = c.regular ? vector_json(c.direction_max) : Json(nullptr);
    json["border"] = node.on_border;
    return json;
}

Json face_json(const Face& face, const FaceWireframe& wireframe) {
    Json nodes = Json::array(), edges = Json::array(), cells = Json::array();
    for (const WireNode& node : wireframe.nodes) nodes.push_back(node_json(face, node));
    for (const WireEdge& edge : wireframe.edges) {
        Json between = Json::array();
        for (const Vector3& point : edge.between) between.push_back(vector_json(point));
        edges.push_back({{"from", edge.from},
                         {"to", edge.to},
                         {"kind", name(edge.kind)},
                         {"length", number_json(edge.length)},
                         {"between", std::move(between)}});
    }
    for (const std::vector<int>& cell : wireframe.cells) cells.push_back(cell);
    return {{"face", wireframe.face},
            {"surface", name(face.kind)},
            {"nodes", std::move(nodes)},
            {"edges", std::move(edges)},
            {"cells", std::move(cells)},
            {"quadrilaterals", wireframe.quadrilaterals},
            {"coverage", number_json(wireframe.coverage)},
            {"farthest", number_json(wireframe.farthest)},
            {"why", wireframe.why}};
}

}  // namespace

Json wireframe_json(const Model& model, const Wireframe& wireframe) {
    Json faces = Json::array();
    for (const FaceWireframe& face : wireframe.faces) faces.push_back(face_json(model.face(face.face), face));
    return {{"schema", "umbilic.wireframe/1"},
            {"input", input_json(model)},
            {"step", number_json(wireframe.step)},
            {"faces", std::move(faces)}};
}

}  // namespace umbilic
