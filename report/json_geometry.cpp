// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/json_geometry.h>

#include <umbilic/similarity/strong_test.h>

#include <report/versions.h>

namespace umbilic {

namespace {

Json box_json(const Face& face, const ParameterBox& box) {
    const Vector2 low = native_parameters(face, box.u.low, box.v.low);
    const Vector2 high = native_parameters(face, box.u.high, box.v.high);
    return {{number_json(low.x()), number_json(high.x())}, {number_json(low.y()), number_json(high.y())}};
}

Json boxes_json(const Face& face, const std::vector<ParameterBox>& boxes) {
    Json json = Json::array();
    for (const ParameterBox& box : boxes) json.push_back(box_json(face, box));
    return json;
}

template <typename Number>
Json optional_json(const std::optional<Number>& value) {
    return value ? Json(*value) : Json(nullptr);
}

const char* word(Containment containment) {
    switch (containment) {
        case Containment::inside:
            return "inside";
        case Containment::outside:
            return "outside";
        case Containment::boundary:
            return "boundary";
    }
    return "boundary";
}

Json native_json(const Face& face, const Vector2& at) {
    const Vector2 native = native_parameters(face, at.x(), at.y());
    return {number_json(native.x()), number_json(native.y())};
}

Json certificate_json(const Certificate& certificate) {
    return {{"index_sum", number_json(certificate.index_sum)},
            {"boundary_winding", certificate.complete ? number_json(certificate.boundary_winding) : Json(nullptr)},
            {"complete", optional_json(certificate.complete)},
            {"why", certificate.why}};
}

Json shell_json(const ShellCertificate& shell) {
    return {{"faces", shell.faces},
            {"closed", shell.closed},
            {"euler_characteristic", optional_json(shell.euler_characteristic)},
            {"genus", optional_json(shell.genus())},
            {"index_sum", shell.complete ? number_json(shell.index_sum) : Json(nullptr)},
            {"complete", optional_json(shell.complete)},
            {"why", shell.why}};
}

Json face_umbilics_json(const Face& face, const FaceUmbilics& found) {
    Json umbilics = Json::array();
    for (const Umbilic& umbilic : found.umbilics) umbilics.push_back(umbilic_json(face, umbilic));
    Json lines = Json::array();
    for (const UmbilicLine& line : found.lines) {
        Json points = Json::array();
        for (const Vector3& point : line.points) points.push_back(vector_json(point));
        Json parameters = Json::array();
        for (const Vector2& at : line.parameters) parameters.push_back(native_json(face, at));
        lines.push_back({{"boxes", boxes_json(face, line.boxes)},
                         {"points", std::move(points)},
                         {"parameters", std::move(parameters)},
                         {"closed", line.closed},
                         {"ends", {name(line.ends[0]), name(line.ends[1])}},
                         {"length", number_json(line.length)},
                         {"accuracy", number_json(line.accuracy)},
                         {"containment", word(line.containment)}});
    }
    Json regions = Json::array();
    for (const UmbilicRegion& region : found.regions) {
        const bool known = region.kind != UmbilicRegionKind::other;
        const SurfaceKind kind = region.kind == UmbilicRegionKind::planar ? SurfaceKind::plane : SurfaceKind::sphere;
        Json boundary = Json::array();
        for (const RegionBoundary& loop : region.boundary) {
            Json points = Json::array(), parameters = Json::array();
            for (const Vector3& point : loop.points) points.push_back(vector_json(point));
            for (const Vector2& at : loop.parameters) parameters.push_back(native_json(face, at));
            boundary.push_back({{"points", std::move(points)}, {"parameters", std::move(parameters)}});
        }
        regions.push_back({{"kind", name(region.kind)},
                           {"boxes", boxes_json(face, region.boxes)},
                           {"border", boxes_json(face, region.border)},
                           {"area", number_json(region.area)},
                           {"deviation", known ? number_json(region.deviation) : Json(nullptr)},
                           {"parameters", known ? elementary_json(kind, region.surface) : Json(nullptr)},
                           {"boundary", std::move(boundary)}});
    }
    Json undecided = Json::array();
    for (const UndecidedCluster& cluster : found.undecided) {
        undecided.push_back({{"boxes", boxes_json(face, cluster.boxes)}, {"index", optional_json(cluster.index)}});
    }
    return {{"face", face.number},
            {"surface", name(face.kind)},
            {"degree", {face.surface.u_degree(), face.surface.v_degree()}},
            {"poles", {face.surface.u_pole_count(), face.surface.v_pole_count()}},
            {"rational", face.surface.rational()},
            {"umbilics", std::move(umbilics)},
            {"lines", std::move(lines)},
            {"regions", std::move(regions)},
            {"undecided", std::move(undecided)},
            {"searched", box_json(face, found.searched)},
            {"recognised", found.recognised ? recognised_json(*found.recognised) : Json(nullptr)},
            {"certificate", certificate_json(found.certificate)}};
}

}  // namespace

Json vector_json(const Vector3& vector) {
    return {number_json(vector.x()), number_json(vector.y()), number_json(vector.z())};
}

Json complex_json(std::complex<double> value) {
    return {number_json(value.real()), number_json(value.imag())};
}

Json elementary_json(SurfaceKind kind, const ElementarySurface& surface) {
    Json result = {{"location", vector_json(surface.location)},
                   {"axis", vector_json(surface.axis)},
                   {"x_axis", vector_json(surface.x_axis)}};
    if (elementary(kind) && kind != SurfaceKind::plane) result["radius"] = number_json(surface.radius);
    if (kind == SurfaceKind::torus) result["minor_radius"] = number_json(surface.minor_radius);
    if (kind == SurfaceKind::cone) result["semi_angle"] = number_json(surface.semi_angle);
    return result;
}

Json recognised_json(const RecognisedSurface& recognised) {
    return {{"kind", name(recognised.kind)},
            {"deviation", number_json(recognised.deviation)},
            {"exact", recognised.exact},
            {"parameter_error", number_json(recognised.parameter_error)},
            {"parameters", elementary_json(recognised.kind, recognised.surface)}};
}

Json tool_json() {
    const Versions used = versions();
    return {{"name", "umbilic"}, {"version", used.umbilic}, {"commit", used.commit}, {"opencascade", used.opencascade}};
}

Json timing_json(const Timing& timing) {
    Json json = Json::object();
    for (const auto& [stage, seconds] : timing) json[stage] = number_json(seconds);
    return json;
}

Vector2 native_parameters(const Face& face, double u, double v) {
    return {face.region.u_map().native(u), face.region.v_map().native(v)};
}

Vector2 surface_parameters(const Face& face, double native_u, double native_v) {
    return {face.region.u_map().surface(native_u), face.region.v_map().surface(native_v)};
}

std::vector<LocatedUmbilic> isolated_umbilics(const PreparedShape& shape) {
    std::vector<LocatedUmbilic> located;
    if (!shape.model()) return located;
    for (const Umbilic* umbilic : umbilics_inside(shape.model()->features.umbilics)) {
        located.push_back({&shape.model()->model.face(umbilic->at.face), umbilic});
    }
    return located;
}

Json umbilic_json(const Face& face, const Umbilic& umbilic) {
    const Vector2 native = native_parameters(face, umbilic.at.u, umbilic.at.v);
    const UmbilicClass& kind = umbilic.kind;
    Json neighbours = Json::array();
    for (const GenericType type : kind.neighbours) neighbours.push_back(name(type));
    const ClassUncertainty& uncertainty = kind.uncertainty;
    Json directions = Json::array();
    for (const Vector3& direction : umbilic.directions) directions.push_back(vector_json(direction));
    return {{"u", number_json(native.x())},
            {"v", number_json(native.y())},
            {"point", vector_json(umbilic.point)},
            {"normal", vector_json(umbilic.normal)},
            {"kappa", number_json(umbilic.kappa)},
            {"cubic",
             {number_json(umbilic.cubic.a), number_json(umbilic.cubic.b), number_json(umbilic.cubic.c),
              number_json(umbilic.cubic.d)}},
            {"omega", kind.omega ? complex_json(*kind.omega) : Json(nullptr)},
            {"delta", number_json(kind.delta)},
            {"zeta", complex_json(kind.zeta)},
            {"radius", number_json(umbilic.radius)},
            {"type", name(kind.type)},
            {"star", kind.star == StarKind::none ? Json(nullptr) : Json(name(kind.star))},
            {"neighbours", std::move(neighbours)},
            {"ridges", optional_json(kind.ridges)},
            {"margin", number_json(umbilic.margin)},
            {"uncertainty",
             {{"kappa", number_json(umbilic.kappa_error)},
              {"cubic", number_json(umbilic.cubic_error)},
              {"omega", uncertainty.omega ? number_json(*uncertainty.omega) : Json(nullptr)},
              {"delta", number_json(uncertainty.delta)},
              {"zeta", number_json(uncertainty.zeta)}}},
            {"on_knot_line", umbilic.on_knot_line},
            {"flat", umbilic.flat},
            {"index", number_json(umbilic.index)},
            {"directions", std::move(directions)},
            {"box", box_json(face, umbilic.box)},
            {"certified", umbilic.certified},
            {"inside", umbilic.containment != Containment::outside},
            {"containment", word(umbilic.containment)},
            {"pole", umbilic.pole == PoleKind::none ? Json(nullptr)
                                                    : Json(umbilic.pole == PoleKind::inner ? "inner" : "border")}};
}

Json umbilics_json(const Model& model, const std::vector<FaceUmbilics>& umbilics,
                   const std::vector<ShellCertificate>& shells) {
    Json faces = Json::array();
    for (const FaceUmbilics& found : umbilics) faces.push_back(face_umbilics_json(model.face(found.face), found));
    Json of_shells = Json::array();
    for (const ShellCertificate& shell : shells) of_shells.push_back(shell_json(shell));
    return {{"schema", "umbilic.umbilics/1"},
            {"input", input_json(model)},
            {"faces", std::move(faces)},
            {"shells", std::move(of_shells)}};
}

}  // namespace umbilic
