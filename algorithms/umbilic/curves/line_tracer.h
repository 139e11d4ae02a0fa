// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/surface_curve.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Two orthogonal families of lines on a face: the lines of curvature, or, where a surface has none (plane, sphere),
/// the lines that climb along a given axis (maximum) and those that run level (minimum).
struct LineField {
    std::optional<Vector3> axis;
};

/// A line field's value at a point.
struct FieldValue {
    Vector3 point = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();  ///< of the surface, r_u x r_v
    Vector3 r_u, r_v;
    Vector3 tangent = Vector3::UnitX();  ///< unit, of the family asked for; its sign is arbitrary
    double spread = 0.0;                 ///< kappa_max - kappa_min, or of an axis the length of its tangential part
    double kappa = 0.0;                  ///< greater of the two |kappa|, or 1 for an axis
    bool regular = false;

    /// Rates (du/ds, dv/ds) of a tangent vector.
    Vector2 rates(const Vector3& vector) const;
};

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

/// Traces lines on one face (thesis 3.3). Within a polynomial piece of the surface the direction is a smooth function;
/// the integration stops at every knot line and starts anew in the next piece, so that its order is kept. Pieces so
/// narrow that rounding of the control points leaves no second derivative are passed over: the piece before them
/// continues to their far side. References the face.
class LineTracer {
public:
    LineTracer(const Face& face, LineField field = {});

    const Face& face() const { return face_; }
    bool along_axis() const { return field_.axis.has_value(); }
    /// The field on the piece of the surface that holds (u, v).
    FieldValue value(const Vector2& parameters, CurvatureFamily family) const;
    /// Length the face's thresholds are relative to: sqrt(area), mm.
    double size() const { return size_; }
    /// True if the families cannot be told apart there: spread <= collapse * max(kappa, 1 / size), or singular.
    bool indeterminate(const FieldValue& value) const;

    /// Line from (u, v) towards `direction` (of its two senses the one with the positive product).
    TracedLine trace(const Vector2& start, CurvatureFamily family, const Vector3& direction,
                     const TraceOptions& options, const Progress& progress = {}) const;

    /// Parameters moved into the domain where the surface is closed.
    Vector2 wrapped(Vector2 parameters) const;

    /// Relative difference of the principal curvatures below which directions are lost.
    static constexpr double collapse = 1e-6;

private:
    FieldValue piece_value(const std::array<int, 2>& piece, const Vector2& parameters, CurvatureFamily family) const;
    /// Number of the piece that carries the field at (u, v): not one that is passed over.
    std::array<int, 2> piece_at(const Vector2& parameters) const;
    friend struct LineRun;

    const Face& face_;
    LineField field_;
    double size_ = 1.0;
    std::array<bool, 2> closed_ = {false, false};
    /// For every piece in u and in v the piece whose polynomial is taken on it: itself, or a neighbour if it is too
    /// narrow.
    std::array<std::vector<int>, 2> carrier_;
};

}  // namespace umbilic
