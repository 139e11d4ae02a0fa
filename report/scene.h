// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/similarity/compare.h>

#include <report/color_scale.h>
#include <report/scene_mesh.h>
#include <report/scene_wires.h>

namespace umbilic {

/// An isolated umbilic in the picture.
struct SceneUmbilic {
    bool of_suspect = false;
    int number = 0;  ///< from 0, as in the strong test
    Vector3 point = Vector3::Zero();
    UmbilicType type = UmbilicType::non_generic;
    std::vector<Vector3> directions;  ///< unit tangents of the lines of curvature that run into it
    std::string label;
};

/// What the pictures show, in the frame and unit of the original.
struct Scene {
    SceneMesh original;  ///< without triangles if it is a cloud of points
    SceneMesh suspect;
    /// False if no pose was found: then the suspect stands beside the original, brought to its size.
    bool posed = false;
    std::vector<SceneUmbilic> umbilics;
    SceneWires wires;  ///< of the original; empty unless they were asked for
    ColorScale scale;
};

/// Brings the suspect's display meshes, or its points, into the pose that was found and measures them against the
/// original: the values are exact distances at the vertices, after long edges of models were split on the surface, or
/// distances from the jets of measured points. Display meshes are those of models. Throws Cancelled.
Scene make_scene(const PreparedShape& original, const std::vector<DisplayMesh>& original_meshes,
                 const PreparedShape& suspect, const std::vector<DisplayMesh>& suspect_meshes,
                 const Comparison& comparison, const Progress& progress = {});

/// The original's wireframe with the usual step, wide enough to be seen in pictures; empty for a cloud of points.
/// Throws Cancelled.
SceneWires original_wires(const PreparedShape& original, const Progress& progress = {});

/// The scene for the page's viewer, as JSON: arrays of 32-bit little-endian numbers in base64.
std::string scene_json(const Scene& scene);

}  // namespace umbilic
