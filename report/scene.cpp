// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <umbilic/matching/score.h>
#include <umbilic/matching/table_ground.h>

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
std::vector<double> deviations(const PreparedShape& original, const std::vector<Vector3>& points,
                               const Progress& progress) {
    std::unique_ptr<GroundSurface> ground;
    if (original.model())
        ground = std::make_unique<Ground>(*original.model());
    else
        ground = std::make_unique<TableGround>(original.points()->table);
    std::vector<double> values(points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 256), [&](const auto& range) {
        progress.check();
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const GroundFoot foot = *ground->foot(points[i], std::numeric_limits<double>::infinity());
            const Vector3 offset = points[i] - foot.point;
            values[i] = std::copysign(foot.distance, offset.dot(foot.normal.value_or(offset)));
        }
    });
    return values;
}

/// Pose for the picture if none was found: beside the original, brought to its size.
SimilarityTransform beside(const BoundingBox& original, const BoundingBox& suspect) {
    SimilarityTransform pose;
    const double suspect_diagonal = suspect.diagonal();
    pose.scale = suspect_diagonal > 0.0 ? original.diagonal() / suspect_diagonal : 1.0;
    const Vector3 size = original.high - original.low;
    const double step = 0.5 * size.x() + 0.6 * pose.scale * (suspect.high - suspect.low).x();
    pose.translation = original.center() + Vector3(step + 0.1 * size.norm(), 0.0, 0.0) - pose.scale * suspect.center();
    return pose;
}

void add_umbilics(const PreparedShape& prepared, bool of_suspect, const SimilarityTransform& pose,
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

Scene make_scene(const PreparedShape& original, const std::vector<DisplayMesh>& original_meshes,
                 const PreparedShape& suspect, const std::vector<DisplayMesh>& suspect_meshes,
                 const Comparison& comparison, const Progress& progress) {
    const auto mesh_of = [](const PreparedShape& shape, const std::vector<DisplayMesh>& meshes) {
        return shape.model() ? scene_mesh(shape.model()->model, meshes) : scene_mesh(shape.points()->cloud);
    };
    Scene scene;
    progress.check();
    scene.posed = comparison.alignment.status != AlignmentStatus::not_found;
    const SimilarityTransform pose =
        scene.posed ? comparison.alignment.original_suspect : beside(original.box(), suspect.box());
    scene.original = mesh_of(original, original_meshes);
    scene.suspect = mesh_of(suspect, suspect_meshes);
    move(scene.suspect, pose);
    compute_normals(scene.original);
    compute_normals(scene.suspect);
    double largest = 0.0;
    if (scene.posed) {
        scene.suspect.deviation = deviations(original, scene.suspect.points, progress);
        for (const double value : scene.suspect.deviation) largest = std::max(largest, std::abs(value));
    }
    scene.scale = color_scale(largest, comparison.assessment.distance.tolerance);
    add_umbilics(original, false, SimilarityTransform(), scene.umbilics);
    add_umbilics(suspect, true, pose, scene.umbilics);
    return scene;
}

SceneWires original_wires(const PreparedShape& original, const Progress& progress) {
    const PreparedModel* const prepared = original.model();
    if (!prepared || !(prepared->model.size() > 0.0)) return {};
    return scene_wires(wireframe(prepared->model, {.umbilics_found = prepared->features.umbilics}, progress));
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
                       {"wires", wires_json(scene.wires, center)},
                       {"types", std::move(types)},
                       {"diagonal", number_json(box.diagonal())},
                       {"range", number_json(scene.scale.range)},
                       {"tolerance", number_json(scene.scale.tolerance)},
                       {"colors", {{"size", colors(false)}, {"signed", colors(true)}}}};
    return script_text(json);
}

}  // namespace umbilic
