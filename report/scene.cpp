// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/scene.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>
#include <unordered_map>

#include <boost/algorithm/string/replace.hpp>

#include <Eigen/Geometry>

#include <umbilic/differential/curvature.h>

#include <report/base64.h>
#include <report/json.h>
#include <report/json_geometry.h>
#include <report/readable.h>

namespace umbilic {

namespace {

/// Longest edge of a triangle relative to the model's diagonal: deviations are only seen at vertices.
constexpr double longest_edge = 1.0 / 32.0;
/// Times an edge is halved at most, against meshes with absurdly long triangles.
constexpr int split_rounds = 6;

std::uint64_t edge_key(int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

/// Splits edges longer than `limit` at points of the surface, the same way from both of their triangles.
DisplayMesh split_long_edges(DisplayMesh mesh, const NurbsSurface& surface, double limit) {
    for (int round = 0; round < split_rounds; ++round) {
        std::unordered_map<std::uint64_t, int> middles;
        const auto middle = [&](int a, int b) {
            if ((mesh.points[a] - mesh.points[b]).norm() <= limit) return -1;
            const auto [entry, is_new] = middles.emplace(edge_key(a, b), static_cast<int>(mesh.points.size()));
            if (is_new) {
                const Vector2 at = 0.5 * (mesh.parameters[a] + mesh.parameters[b]);
                mesh.parameters.push_back(at);
                mesh.points.push_back(surface.value(at.x(), at.y()));
            }
            return entry->second;
        };
        std::vector<std::array<int, 3>> triangles;
        for (auto [a, b, c] : mesh.triangles) {
            int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            if (ab < 0 && bc < 0 && ca < 0) {
                triangles.push_back({a, b, c});
                continue;
            }
            if (ab >= 0 && bc >= 0 && ca >= 0) {
                triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
                continue;
            }
            // Turn the triangle until ab is split and ca is not.
            while (ab < 0 || ca >= 0) {
                std::tie(a, b, c, ab, bc, ca) = std::tuple(b, c, a, bc, ca, ab);
            }
            if (bc < 0) {
                triangles.insert(triangles.end(), {{a, ab, c}, {ab, b, c}});
            } else {
                triangles.insert(triangles.end(), {{ab, b, bc}, {a, ab, bc}, {a, bc, c}});
            }
        }
        mesh.triangles = std::move(triangles);
        if (middles.empty()) break;
    }
    return mesh;
}

/// Edges that belong to one triangle only: the border of the face.
void add_border(const DisplayMesh& mesh, int offset, std::vector<std::array<int, 2>>& edges) {
    std::map<std::uint64_t, int> uses;
    for (const auto& [a, b, c] : mesh.triangles) {
        for (const std::uint64_t key : {edge_key(a, b), edge_key(b, c), edge_key(c, a)}) ++uses[key];
    }
    for (const auto& [key, count] : uses) {
        if (count == 1) {
            edges.push_back({offset + static_cast<int>(key >> 32), offset + static_cast<int>(key & 0xffffffffu)});
        }
    }
}

SceneMesh joined(const Model& model, const std::vector<DisplayMesh>& meshes) {
    SceneMesh scene;
    const double limit = longest_edge * model.box.diagonal();
    for (const DisplayMesh& coarse : meshes) {
        const DisplayMesh mesh = split_long_edges(coarse, model.face(coarse.face).surface, limit);
        const int offset = static_cast<int>(scene.points.size());
        scene.faces.push_back({mesh.face, static_cast<int>(scene.triangles.size())});
        scene.points.insert(scene.points.end(), mesh.points.begin(), mesh.points.end());
        for (const auto& [a, b, c] : mesh.triangles) {
            scene.triangles.push_back({offset + a, offset + b, offset + c});
        }
        add_border(mesh, offset, scene.edges);
    }
    return scene;
}

void move(SceneMesh& mesh, const SimilarityTransform& transform) {
    for (Vector3& point : mesh.points) point = transform.apply(point);
    if (transform.mirrored) {
        for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
}

void compute_normals(SceneMesh& mesh) {
    mesh.normals.assign(mesh.points.size(), Vector3::Zero());
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vector3 normal = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
        for (const int i : {a, b, c}) mesh.normals[i] += normal;
    }
    for (Vector3& normal : mesh.normals) normal = normal.squaredNorm() > 0.0 ? normal.normalized() : Vector3::UnitZ();
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

/// Little-endian 32-bit numbers in base64.
template <typename Number, typename Range>
std::string packed(const Range& values) {
    static_assert(sizeof(Number) == 4 && std::endian::native == std::endian::little);
    std::string bytes;
    for (const auto& entry : values) {
        for (const auto& value : entry) {
            const auto number = static_cast<Number>(value);
            char raw[4];
            std::memcpy(raw, &number, 4);
            bytes.append(raw, 4);
        }
    }
    return base64(bytes);
}

Json mesh_json(const SceneMesh& mesh, const Vector3& center) {
    std::vector<std::array<double, 3>> points;
    for (const Vector3& point : mesh.points) {
        const Vector3 p = point - center;  // single precision suffices near the origin
        points.push_back({p.x(), p.y(), p.z()});
    }
    std::vector<std::array<int, 2>> faces;
    for (const auto& range : mesh.faces) faces.push_back({range.face, range.first_triangle});
    const std::vector<std::vector<double>> deviation = {mesh.deviation};
    return {{"points", packed<float>(points)},
            {"triangles", packed<std::uint32_t>(mesh.triangles)},
            {"edges", packed<std::uint32_t>(mesh.edges)},
            {"faces", packed<std::uint32_t>(faces)},
            {"deviation", packed<float>(deviation)}};
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
    scene.original = joined(original.model, original_meshes);
    scene.suspect = joined(suspect.model, suspect_meshes);
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
    // A name from a file must not end the script element that holds this.
    return boost::replace_all_copy(json.dump(-1, ' ', true, Json::error_handler_t::replace), "<", "\\u003c");
}

}  // namespace umbilic
