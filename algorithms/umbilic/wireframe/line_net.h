// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/line_tracer.h>

namespace umbilic {

/// Where a net begins.
struct NetStart {
    LineField field;
    Vector2 parameters = Vector2::Zero();
    /// At a star umbilic: where the half-lines begin that run into it (none at a regular point), and which way.
    struct Spoke {
        Vector2 parameters;
        Vector3 direction;
        CurvatureFamily family;
    };
    std::vector<Spoke> spokes;
};

/// Crossing of a line of the one and a line of the other family.
struct NetNode {
    Vector2 parameters = Vector2::Zero();
    Vector3 point = Vector3::Zero();
    double distance = 0.0;  ///< from the start along lines, mm
};

/// Part of a line between two neighbouring crossings.
struct NetEdge {
    int from = 0, to = 0;
    CurvatureFamily family = CurvatureFamily::maximum;
    double length = 0.0;
    std::vector<Vector3> between;  ///< points of it at equal distances, without its ends
};

struct LineNet {
    std::vector<NetNode> nodes;
    std::vector<NetEdge> edges;
    int lines = 0;
};

struct LineNetOptions {
    double step = 0.0;  ///< distance of neighbouring lines, mm
    std::size_t most_lines = 0;
    bool drawn = true;  ///< with the points between crossings
};

/// Lines of both families at about equal distances over a face, and their crossings (thesis 3.7.2, Figures 3-8 and
/// 3-9, (3.46)-(3.48)). From the start lines grow outwards: a new line crosses an old one where that has no crossing
/// for the distance of one step, and ends at a border, an umbilic, or where another line of its family is near. Every
/// choice depends on lengths in space, measured from the start.
LineNet line_net(const LineTracer& tracer, const NetStart& start, const LineNetOptions& options,
                 const Progress& progress = {});

}  // namespace umbilic
