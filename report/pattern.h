// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/line_of_curvature.h>
#include <umbilic/model/model.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// Lines of curvature around an umbilic, traced on the surface, each seen as a curve of the tangent plane: x along
/// Umbilic::x_axis, y = normal x x_axis.
struct UmbilicPattern {
    struct Line {
        CurvatureFamily family = CurvatureFamily::maximum;
        bool separatrix = false;  ///< runs into the umbilic
        std::vector<Vector2> points;
    };
    double radius = 0.0;  ///< of the disc that is shown, mm
    std::vector<Line> lines;
};

/// Traces the lines in a disc that reaches at most a part of the way to the nearest of `others` (the umbilics of the
/// face). Nothing but the radius where lines cannot be traced: at a non-generic umbilic or outside of the face.
UmbilicPattern trace_pattern(const Face& face, const Umbilic& umbilic, const std::vector<Umbilic>& others,
                             const Progress& progress = {});

/// The pattern as an SVG element (thesis Fig. 2-1): both families, and the directions of the lines that run in.
std::string pattern_svg(const Umbilic& umbilic, const UmbilicPattern& pattern);

}  // namespace umbilic
