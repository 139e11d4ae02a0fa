// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/scene.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <Eigen/Geometry>

#include <umbilic/differential/curvature.h>

#include <report/json.h>
#include <report/json_geometry.h>
#include <report/readable.h>

namespace umbilic {

namespace {

void move(SceneMesh& mesh, const SimilarityTransform& transform) {
    for (Vector3& point : mesh.points) point = transform.apply(point);
    if (transform.mirrored) {
        for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
}

/// Signed distances of the points from the original, positive on its outward side.
std::vector<double> deviations(const PreparedModel& original, const std::vector<Vector3>& points) {
    const std::vector<ClosestPoint> feet = original.tree.closest(points);
    std::unordered_map<int, const Face*> faces;
    for (const Face& face : original.model.faces) faces.emplace(face.number, &face);
    std::vector<double> values(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Face& face = *faces.at(feet[i].at.face);
        const Curvature frame = curvature(face.surface, feet[i].at.u, feet[i].at.v);
        const Vector3 outward = face.reversed ? Vector3(-frame.normal) : frame.normal;
        values[i] = std::copysign(feet[i].distance, (points[i] - feet[i].point).dot(outward));
    }
    return values;
}

/// Pose for the picture if none was found: beside the original, brought to its size.
SimilarityTransform beside(const Model& original, const Model& suspect) {
    SimilarityTransform pose;
    const double suspect_diagonal = suspect.box.diagonal();
    pose.scale = suspect_diagonal > 0.0 ? original.box.diagonal() / suspect_diagonal : 1.0;
    const Vector3 size = original.box.high - original.box.low;
    const double step = 0.5 * size.x() + 0.6 * pose.scale * (suspect.box.high - suspect.box.low).x();
    pose.translation =
        original.box.center() + Vector3(step + 0.1 * size.norm(), 0.0, 0.0) - pose.scale * suspect.box.center();
    return pose;
}

void add_umbilics(const PreparedModel& prepared, bool of_suspect, const SimilarityTransform& pose,
                  std::vector<SceneUmbilic>& umbilics) {
    int number = 0;
    for (const auto& [face, umbilic] : isolated_umbilics(prepared)) {
        SceneUmbilic shown;
        shown.of_suspect = of_suspect;
        shown.number = number++;
        shown.point = pose.apply(umbilic->point);
        shown.type = umbilic->kind.type;
        for (const Vector3& direction : umbilic->directions) {
            shown.directions.push_back(pose.apply_direction(direction));
        }
        const Vector2 native = native_parameters(*face, umbilic->at.u, umbilic->at.v);
        shown.label = std::string(of_suspect ? "S" : "O") + std::to_string(shown.number + 1) + " " +
                      name(umbilic->kind.type) + ", face " + std::to_string(face->number) + ", u " +
                      readable(native.x(), 6) + ", v " + readable(native.y(), 6) + ", κ " +
                      readable(umbilic->kappa, "1/mm");
        umbilics.push_back(std::move(shown));
    }
}

}  // namespace

Scene make_scene(const PreparedModel& original, const std::vector<DisplayMesh>& original_meshes,
                 const PreparedModel& suspect, const std::vector<DisplayMesh>& suspect_meshes,
                 const Comparison& comparison, const Progress& progress) {
    Scene scene;
    progress.check();
    scene.posed = comparison.alignment.status != AlignmentStatus::not_found;
    const SimilarityTransform pose =
        scene.posed ? comparison.alignment.original_suspect : beside(original.model, suspect.model);
    scene.original = scene_mesh(original.model, original_meshes);
    scene.suspect = scene_mesh(suspect.model, suspect_meshes);
    move(scene.suspect, pose);
    compute_normals(scene.original);
    compute_normals(scene.suspect);
    double largest = 0.0;
    if (scene.posed) {
        progress.check();
        scene.suspect.deviation = deviations(original, scene.suspect.points);
        for (const double value : scene.suspect.deviation) largest = std::max(largest, std::abs(value));
    }
    scene.scale = color_scale(largest, comparison.assessment.distance.tolerance);
    add_umbilics(original, false, SimilarityTransform(), scene.umbilics);
    add_umbilics(suspect, true, pose, scene.umbilics);
    return scene;
}

std::string scene_json(const Scene& scene) {
    BoundingBox box;
    for (const Vector3& point : scene.original.points) box.add(point);
    if (box.empty()) box.add(Vector3::Zero());
    const Vector3 center = box.center();
    Json umbilics = Json::array();
    for (const SceneUmbilic& umbilic : scene.umbilics) {
        Json directions = Json::array();
        for (const Vector3& direction : umbilic.directions) directions.push_back(vector_json(direction));
        umbilics.push_back({{"suspect", umbilic.of_suspect},
                            {"point", vector_json(umbilic.point - center)},
                            {"type", name(umbilic.type)},
                            {"directions", std::move(directions)},
                            {"label", umbilic.label}});
    }
    const auto colors = [&](bool is_signed) {
        Json table = Json::array();
        constexpr int steps = 64;
        for (int i = 0; i <= steps; ++i) {
            const double t = static_cast<double>(i) / steps;
            const double range = scene.scale.range;
            table.push_back(
                hex(is_signed ? scene.scale.of_signed((2.0 * t - 1.0) * range) : scene.scale.of_size(t * range)));
        }
        return table;
    };
    Json types = Json::object();
    for (const UmbilicType type :
         {UmbilicType::star, UmbilicType::lemon, UmbilicType::monstar, UmbilicType::non_generic}) {
        types[name(type)] = hex(color_of(type));
    }
    const Json json = {{"original", mesh_json(scene.original, center)},
                       {"suspect", mesh_json(scene.suspect, center)},
                       {"posed", scene.posed},
                       {"umbilics", std::move(umbilics)},
                       {"types", std::move(types)},
                       {"diagonal", number_json(box.diagonal())},
                       {"range", number_json(scene.scale.range)},
                       {"tolerance", number_json(scene.scale.tolerance)},
                       {"colors", {{"size", colors(false)}, {"signed", colors(true)}}}};
    return script_text(json);
}

}  // namespace umbilic
