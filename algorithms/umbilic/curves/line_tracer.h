// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/line_field.h>
#include <umbilic/curves/surface_curve.h>

namespace umbilic {

/// One step of a traced line, in the parameter plane: a quartic in arc length through both ends, their rates and the
/// middle (Dormand and Prince's continuous extension).
struct TracedStep {
    double s = 0.0;       ///< arc length at the start of the step, mm
    double length = 0.0;  ///< mm
    std::array<int, 2> piece = {0, 0};
    Vector2 start, end, start_rate, end_rate, middle;

    /// Parameters and their rates at the fraction x of the step, in [0, 1].
    Vector2 at(double x) const;
    Vector2 rate(double x) const;
};

struct TracedLine {
    std::vector<TracedStep> steps;
    CurveEnd ended = CurveEnd::length;
    bool stuck = false;  ///< ended before an umbilic: the surface is not smooth enough there
    double length = 0.0;
    std::optional<double> stopped;           ///< arc length at which TraceOptions::stop was true
    double error = 0.0;                      ///< sum of the estimated errors of the steps, mm
    Vector3 end_tangent = Vector3::UnitX();  ///< unit, at the end, in the direction of the run

    /// Number of the step that holds the arc length s.
    std::size_t step_at(double s) const;
    Vector2 at(double s) const;
};

struct TraceOptions {
    double length = 0.0;                 ///< where to stop, mm
    double tolerance = 0.0;              ///< error allowed in a step of the length of 1 / kappa or shorter, mm
    double longest_step = 0.0;           ///< mm
    bool close = true;                   ///< stop where the line comes back to its start
    double closing_distance = 0.0;       ///< mm: a line that passes its start within this distance is closed
    std::size_t most_steps = 1'000'000;  ///< a line that needs more is stuck
    double stop_spacing = 0.0;           ///< mm, arc length between the places where `stop` is asked
    /// Asked with the field at every multiple of `stop_spacing` but 0, after the step that holds it: the line ends with
    /// that step.
    std::function<bool(const FieldValue&)> stop;
};

/// Traces lines on one face (thesis 3.3). The integration stops at every knot line and starts anew in the next piece,
/// so that its order is kept. References the face.
class LineTracer : public FaceLineField {
public:
    using FaceLineField::FaceLineField;

    /// Line from (u, v) towards `direction` (of its two senses the one with the positive product).
    TracedLine trace(const Vector2& start, CurvatureFamily family, const Vector3& direction,
                     const TraceOptions& options, const Progress& progress = {}) const;
};

}  // namespace umbilic
