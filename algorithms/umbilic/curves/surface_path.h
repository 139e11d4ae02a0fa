// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/surface_curve.h>
#include <umbilic/differential/edge_smoothness.h>
#include <umbilic/model/face_adjacency.h>
#include <umbilic/model/model.h>
#include <umbilic/nurbs/surface_derivatives.h>

namespace umbilic {

/// The edges over which a curve may go on from face to face.
struct SmoothJoins {
    /// Refers to the adjacency, and so to its model.
    const FaceAdjacency* adjacency = nullptr;
    std::vector<bool> smooth;  ///< by index into FaceAdjacency::edges
};

/// Joins across all edges that bend by at most `largest_bend` radians.
SmoothJoins smooth_joins(const FaceAdjacency& adjacency, double largest_bend = default_largest_bend);

/// The joins of a model together with the adjacency they refer to.
struct JoinedFaces {
    FaceAdjacency adjacency;
    SmoothJoins joins;

    /// Refers to the model.
    explicit JoinedFaces(const Model& model) : adjacency(face_adjacency(model)), joins(smooth_joins(adjacency)) {}
    JoinedFaces(const JoinedFaces&) = delete;
    JoinedFaces& operator=(const JoinedFaces&) = delete;
};

/// Joins to the other faces of a model, or none where a curve shall stay on one face.
class OptionalJoins {
public:
    /// Refers to the model.
    OptionalJoins(const Model& model, bool one_face) {
        if (!one_face && model.faces.size() > 1) joined_.emplace(model);
    }
    const SmoothJoins* get() const { return joined_ ? &joined_->joins : nullptr; }

private:
    std::optional<JoinedFaces> joined_;
};

/// State of a system of ordinary differential equations on surfaces; components that a system does not use stay 0.
using PathState = std::array<double, 7>;

/// A polynomial piece of a face's surface (see KnotVector::piece).
struct FacePiece {
    const Face* face = nullptr;
    std::array<int, 2> piece = {0, 0};

    /// Derivatives of order 2 of this piece, continued beyond its knots.
    SurfaceDerivatives derivatives(const Vector2& parameters, int order = 2) const;
};

/// At most two surfaces on which a path runs at the same time: the parameters of the first are components 0 and 1 of
/// the state, those of the second components 4 and 5. Component 6 holds the arc length of a projection.
inline constexpr std::array<int, 2> chart_components = {0, 4};
inline constexpr int projected_length = 6;

/// Derivatives of order 2 of the charts' surfaces at a state.
using ChartSurfaces = std::array<SurfaceDerivatives, 2>;

/// Differential equations whose solutions run on surfaces (geodesics, projections).
struct PathSystem {
    int charts = 1;
    /// Derivative of the state by the path's parameter, or why there is none: the path ends there.
    std::function<std::optional<CurveEnd>(double s, const PathState& y, const ChartSurfaces& surfaces, PathState& rate)>
        rates;
    /// Weighs the estimated error of a step: a length, mm.
    std::function<double(const PathState& error, const ChartSurfaces& surfaces)> error;
    /// Adapts the state where a chart passes to another polynomial piece or face at the same point in space; the
    /// chart's parameters have their new values already. May be empty.
    std::function<void(int chart, const SurfaceDerivatives& before, const SurfaceDerivatives& after, PathState& y)>
        enter;
    /// Called where a step begins, before its rates. May be empty.
    std::function<void(double s, const ChartSurfaces& surfaces)> begin_step;
};

/// One step of a path: a quartic in the parameter (the continuous extension of Dormand and Prince's method).
struct PathStep {
    double s = 0.0;       ///< parameter at the start of the step
    double length = 0.0;  ///< in the parameter
    std::array<FacePiece, 2> pieces;
    PathState start{}, end{}, start_rate{}, end_rate{}, middle{};

    /// State at the fraction x of the step, in [0, 1].
    PathState at(double x) const;
    /// Its derivative by the parameter.
    PathState rate(double x) const;
};

struct SurfacePath {
    std::vector<PathStep> steps;
    CurveEnd ended = CurveEnd::length;
    int ended_chart = 0;  ///< the chart whose border ended the path
    double length = 0.0;  ///< in the parameter
    double error = 0.0;   ///< sum of the estimated errors of the steps, mm

    const PathStep& step_at(double s) const;
    PathState at(double s) const;
};

struct SurfacePathOptions {
    double length = 0.0;        ///< of the parameter, where the path ends
    double tolerance = 0.0;     ///< error allowed in a step, mm
    double longest_step = 0.0;  ///< of the parameter
    /// The path's places in the parameter at which the rates are not smooth, increasing: steps end there.
    std::vector<double> breaks;
    /// Joins for chart 0 and chart 1; without, a path stays on its face (across the seam of a closed one).
    std::array<const SmoothJoins*, 2> joins = {nullptr, nullptr};
};

/// Follows a solution from `start` on the given faces. Within polynomial pieces the rates are smooth; the integration
/// (Boost.Odeint, Dormand and Prince 5(4)) stops at every knot line and starts anew in the next piece, so that its
/// order is kept. It ends at a border of a chart, at a trimming loop, or where the rates are not defined. References
/// the system and the faces. Throws NumericFailure if steps become too short elsewhere.
SurfacePath follow(const PathSystem& system, const PathState& start, const std::array<const Face*, 2>& faces,
                   const SurfacePathOptions& options, const Progress& progress = {});

/// Points of a chart of a path as a curve: at equal parts of about `spacing` of the parameter, or at the steps' ends
/// if 0. s is the path's parameter, or the arc length of the projection where `by_projected_length`.
SurfaceCurve sampled(const SurfacePath& path, int chart, double spacing, bool by_projected_length = false);

/// Length that thresholds on a face are relative to: sqrt(area), mm. Throws InvalidInput if the face has no extent.
double extent(const Face& face);

/// Components (du, dv) of a vector's tangential part: vector = r_u du + r_v dv.
Vector2 tangent_components(const SurfaceDerivatives& d, const Vector3& vector);

}  // namespace umbilic
