// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/scene_mesh.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <unordered_map>

#include <boost/algorithm/string/replace.hpp>

#include <Eigen/Geometry>

#include <report/packed.h>

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

}  // namespace

SceneMesh scene_mesh(const Model& model, const std::vector<DisplayMesh>& meshes) {
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

SceneMesh scene_mesh(const PointCloud& cloud) {
    SceneMesh scene;
    scene.points = cloud.points;
    scene.triangles = cloud.triangles;
    return scene;
}

void compute_normals(SceneMesh& mesh) {
    mesh.normals.assign(mesh.points.size(), Vector3::Zero());
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vector3 normal = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
        for (const int i : {a, b, c}) mesh.normals[i] += normal;
    }
    for (Vector3& normal : mesh.normals) normal = normal.squaredNorm() > 0.0 ? normal.normalized() : Vector3::UnitZ();
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

std::string script_text(const Json& json) {
    // A name from a file must not end the script element that holds this.
    return boost::replace_all_copy(json.dump(-1, ' ', true, Json::error_handler_t::replace), "<", "\\u003c");
}

}  // namespace umbilic
