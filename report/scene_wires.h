// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/wireframe/wireframe.h>

#include <report/color_scale.h>
#include <report/json.h>

namespace umbilic {

/// A wireframe as pictures show it.
struct SceneWires {
    struct Line {
        WireKind kind = WireKind::geodesic;
        std::vector<Vector3> points;
    };
    double step = 0.0;  ///< mm
    std::vector<Line> lines;
    std::vector<Vector3> nodes;
};

SceneWires scene_wires(const Wireframe& wireframe);

/// Colour of edges of this kind in pictures.
Color color_of(WireKind kind);

/// The wires for the page's viewer, relative to `center`: nodes, and by kind the ends of straight pieces, as arrays of
/// 32-bit numbers in base64.
Json wires_json(const SceneWires& wires, const Vector3& center);

}  // namespace umbilic
