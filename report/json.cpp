// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/json.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <report/json_geometry.h>

namespace umbilic {

Json number_json(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string text(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

Json input_json(const Model& model) {
    const Source& source = model.source;
    const auto is_nurbs = [](const Face& face) {
        return face.kind == SurfaceKind::bspline || face.kind == SurfaceKind::bezier;
    };
    Json skipped = Json::array();
    for (const Skipped& part : model.skipped) {
        const Json which = part.face > 0 ? Json{{"face", part.face}} : Json{{"entity", part.entity}};
        skipped.push_back(which);
        skipped.back()["why"] = part.why;
    }
    return {{"path", source.path},
            {"sha256", source.sha256},
            {"bytes", source.bytes},
            {"format", source.format},
            {"unit", source.unit},
            {"unit_in_mm", number_json(source.unit_in_mm)},
            {"solids", model.solids.size()},
            {"shells", model.shells},
            {"faces", model.faces.size()},
            {"nurbs_faces", std::count_if(model.faces.begin(), model.faces.end(), is_nurbs)},
            {"declared_faces", model.declared_faces < 0 ? Json(nullptr) : Json(model.declared_faces)},
            {"area", number_json(model.area)},
            {"volume", number_json(model.volume)},
            {"box", {vector_json(model.box.low), vector_json(model.box.high)}},
            {"valid", model.valid},
            {"skipped", std::move(skipped)},
            {"repaired", model.repaired},
            {"warnings", model.warnings}};
}

Json input_json(const PointCloud& cloud) {
    const Source& source = cloud.source;
    const BoundingBox box = cloud.box();
    return {{"path", source.path},
            {"sha256", source.sha256},
            {"bytes", source.bytes},
            {"format", source.format},
            {"layout", cloud.layout},
            {"unit", source.unit},
            {"unit_in_mm", number_json(source.unit_in_mm)},
            {"solids", 0},
            {"faces", 0},
            {"nurbs_faces", 0},
            {"points", cloud.points.size()},
            {"triangles", cloud.triangles.size()},
            {"normals", !cloud.normals.empty()},
            {"thinned_out", cloud.thinned_out},
            {"not_finite", cloud.not_finite},
            {"merged", cloud.merged},
            {"degenerate_triangles", cloud.degenerate_triangles},
            {"area", nullptr},
            {"volume", nullptr},
            {"noise", nullptr},
            {"box", {vector_json(box.low), vector_json(box.high)}},
            {"skipped", Json::array()},
            {"repaired", Json::array()},
            {"warnings", cloud.warnings}};
}

Json input_json(const PreparedShape& shape) {
    if (shape.model()) return input_json(shape.model()->model);
    const PreparedPoints& points = *shape.points();
    Json json = input_json(points.cloud);
    json["area"] = number_json(points.area);
    json["noise"] = number_json(points.noise);
    return json;
}

Json info_json(const Model& model, const std::vector<std::optional<RecognisedSurface>>& recognised) {
    std::map<std::string, int> by_surface;
    Json faces = Json::array();
    for (std::size_t k = 0; k < model.faces.size(); ++k) {
        const Face& face = model.faces[k];
        ++by_surface[name(face.kind)];
        faces.push_back({{"face", face.number},
                         {"surface", name(face.kind)},
                         {"degree", {face.surface.u_degree(), face.surface.v_degree()}},
                         {"poles", {face.surface.u_pole_count(), face.surface.v_pole_count()}},
                         {"rational", face.surface.rational()},
                         {"periodic", {face.u_periodic, face.v_periodic}},
                         {"closed", {face.u_closed, face.v_closed}},
                         {"trimmed", !face.region.whole_domain()},
                         {"area", number_json(face.area)},
                         {"orientation", face.reversed ? "reversed" : "forward"},
                         {"solid", face.solid < 0 ? Json(nullptr) : Json(face.solid + 1)},
                         {"name", face.name},
                         {"conversion_error", number_json(face.conversion_error)},
                         {"recognised", recognised[k] ? recognised_json(*recognised[k]) : Json(nullptr)}});
    }
    return {{"schema", "umbilic.info/1"},
            {"input", input_json(model)},
            {"surfaces", by_surface},
            {"faces", std::move(faces)}};
}

}  // namespace umbilic
