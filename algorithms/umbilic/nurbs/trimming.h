// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/nurbs/knot_vector.h>
#include <umbilic/nurbs/parameter_map.h>

namespace umbilic {

/// Planar NURBS curve (thesis 2.2, (2.32)-(2.34)); weights empty if polynomial.
class NurbsCurve2 {
public:
    /// Throws InvalidInput if sizes do not fit, a coordinate is not finite or a weight is not positive.
    NurbsCurve2(KnotVector knots, std::vector<Vector2> poles, std::vector<double> weights = {});

    const KnotVector& knots() const { return knots_; }
    const std::vector<Vector2>& poles() const { return poles_; }
    const std::vector<double>& weights() const { return weights_; }
    ParameterInterval domain() const { return knots_.domain(); }
    Vector2 value(double t) const;
    /// Value and first derivative.
    std::pair<Vector2, Vector2> value_and_tangent(double t) const;

private:
    KnotVector knots_;
    std::vector<Vector2> poles_;
    std::vector<double> weights_;
};

/// One oriented edge of a trimming loop, as a curve in the parameter plane of the face.
struct TrimmingCurve {
    /// Curve in native parameters (see ParameterMap).
    NurbsCurve2 curve;
    /// True if the loop runs through the curve from its end to its start.
    bool reversed = false;
    /// Number of the model's edge this curve belongs to, from 1; 0 if unknown. A seam edge stands twice in its face's
    /// loops.
    int edge = 0;
    /// The edge is a single point in space (pole of a sphere, apex of a cone).
    bool degenerate = false;
    /// Largest distance in space (mm) between the edge and the image of this curve, as the file states it.
    double tolerance = 0.0;
};

using TrimmingLoop = std::vector<TrimmingCurve>;

/// Where a parameter point lies with respect to the trimming loops of its face.
enum class Containment { inside, outside, boundary };

/// The part of a surface's parameter plane that belongs to a face: bounded by closed loops, even-odd rule.
class TrimmingRegion {
public:
    /// The whole domain of the surface.
    explicit TrimmingRegion(ParameterBox domain);
    /// `domain`: the surface's own; `loops` in native parameters, each closed within the domain's rounding. Throws
    /// InvalidInput if a loop is not closed.
    TrimmingRegion(ParameterBox domain, std::vector<TrimmingLoop> loops, ParameterMap u_map, ParameterMap v_map);

    const std::vector<TrimmingLoop>& loops() const { return loops_; }
    const ParameterMap& u_map() const { return u_map_; }
    const ParameterMap& v_map() const { return v_map_; }
    ParameterBox domain() const { return domain_; }
    /// Box of the loops, within the domain, in surface parameters.
    ParameterBox box() const { return box_; }
    /// True if the loops bound the whole domain rectangle and nothing else: no point needs a test.
    bool whole_domain() const { return whole_domain_; }

    /// Classifies (u, v), surface parameters: `boundary` if a loop passes within `radius` (same unit as u and v,
    /// relative to the domain's sides) or within the accuracy of the loops themselves.
    Containment classify(double u, double v, double radius = 0.0) const;

    /// Point and tangent of a trimming curve in surface parameters, t in the curve's own domain.
    Vector2 curve_point(const TrimmingCurve& curve, double t) const;

    /// Polyline of loop number `index`, in surface parameters, closed (the last point equals the first); its distance
    /// from the true loop is at most `polyline_deviation` of the domain's sides.
    const std::vector<Vector2>& polyline(int index) const { return polylines_[index]; }

    /// Largest distance between polylines and loops, relative to the domain's sides.
    static constexpr double polyline_deviation = 1e-6;

private:
    ParameterBox domain_;
    ParameterBox box_;
    std::vector<TrimmingLoop> loops_;
    ParameterMap u_map_;
    ParameterMap v_map_;
    std::vector<std::vector<Vector2>> polylines_;
    bool whole_domain_ = true;

    /// Segments of all polylines, scaled to the unit square, and which of them touch each band of equal height in v:
    /// those of band i are in_band_[band_start_[i]] ... in_band_[band_start_[i + 1]].
    struct Segment {
        Vector2 from, to;
    };
    void build_bands();
    int band(double scaled_v) const;
    std::vector<Segment> segments_;
    std::vector<int> band_start_, in_band_;
    ParameterInterval banded_;
};

}  // namespace umbilic
