// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace umbilic {

/// automatic: given pairs or pose, analytic faces, umbilics, moments, curvature, in this order, until a pose convinces;
/// of measured points their local jets, which is also what points and curvature mean there. On request only, the
/// thesis's own methods: kh, points of equal Gaussian and mean curvature; umbilic_lines and umbilic_kh, methods 1 and 2
/// of its 4.7.1.
enum class MethodChoice { automatic, analytic, umbilics, umbilic_lines, umbilic_kh, moments, curvature, kh, points };
/// How the scale is searched where points of equal curvature are compared at one scale after the other.
enum class ScaleSearch { golden_section, brent };
/// How points of given curvatures are found. direct: find_curvature_points(); the thesis's own for comparison:
/// auxiliary, the system with an auxiliary variable by the projected polyhedron (its Appendix B); approximated, bicubic
/// surfaces of K and H (4.8).
enum class CurvatureSolver { direct, auxiliary, approximated };
enum class MirrorChoice { automatic, never };
enum class ScopeChoice { automatic, global, partial };

/// What is known of the scale. automatic: nothing; fixed: it is 1; range: it lies in [low, high].
struct ScaleChoice {
    enum class Kind { automatic, fixed, range } kind = Kind::automatic;
    double low = 0.0;
    double high = 0.0;

    /// True if a scale may be tried: within the range widened by the factor `slack` (>= 1) on both sides.
    bool allows(double scale, double slack) const {
        const double low_end = kind == Kind::fixed ? 1.0 : low, high_end = kind == Kind::fixed ? 1.0 : high;
        return kind == Kind::automatic || (low_end <= scale * slack && scale <= high_end * slack);
    }
    /// The same of the inverse transform.
    ScaleChoice inverse() const {
        if (kind != Kind::range) return *this;
        return {kind, 1.0 / high, 1.0 / low};
    }
    /// The nearest allowed scale.
    double clamp(double scale) const {
        if (kind == Kind::automatic) return scale;
        if (kind == Kind::fixed) return 1.0;
        return scale < low ? low : scale > high ? high : scale;
    }
};

}  // namespace umbilic
