// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include <umbilic/model/display_mesh.h>
#include <umbilic/model/model.h>
#include <umbilic/model/point_cloud.h>

#include <report/json.h>

namespace umbilic {

/// All faces of a model in one triangle mesh, for pictures.
struct SceneMesh {
    struct FaceRange {
        int face = 0;
        int first_triangle = 0;
    };
    std::vector<Vector3> points;
    std::vector<Vector3> normals;  ///< one per point
    std::vector<std::array<int, 3>> triangles;
    std::vector<std::array<int, 2>> edges;  ///< borders of the faces
    std::vector<FaceRange> faces;           ///< in the order of their triangles
    std::vector<double> deviation;          ///< signed distance to the other model, mm; empty if there is no pose
};

/// Joins the meshes of all faces after splitting long edges at points of the surfaces; without normals.
SceneMesh scene_mesh(const Model& model, const std::vector<DisplayMesh>& meshes);

/// The points and triangles of a cloud or mesh.
SceneMesh scene_mesh(const PointCloud& cloud);

/// Fills in one normal per point, the mean of its triangles' by area.
void compute_normals(SceneMesh& mesh);

/// The mesh for the page's viewer, relative to `center`: arrays of 32-bit little-endian numbers in base64.
Json mesh_json(const SceneMesh& mesh, const Vector3& center);

/// JSON that can stand inside a script element.
std::string script_text(const Json& json);

}  // namespace umbilic
