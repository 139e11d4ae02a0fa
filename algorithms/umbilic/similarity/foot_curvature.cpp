// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/foot_curvature.h>

#include <cmath>

namespace umbilic {

namespace {

struct OneSided {
    double parameter;
    Side side;
};

/// Interior breaks with a continuity below the given one, within `reach` of the parameter.
std::vector<double> breaks_within(const KnotVector& knots, double parameter, double reach, int continuity) {
    std::vector<double> result;
    const std::vector<double>& breaks = knots.breaks();
    for (int i = 1; i + 1 < static_cast<int>(breaks.size()); ++i)
        if (knots.continuity(i) < continuity && std::abs(breaks[i] - parameter) <= reach) result.push_back(breaks[i]);
    return result;
}

std::vector<OneSided> one_sided(const KnotVector& knots, bool closed, double parameter, double reach) {
    std::vector<OneSided> result = {{parameter, Side::right}};
    for (double b : breaks_within(knots, parameter, reach, curvature_continuity)) {
        result.push_back({b, Side::left});
        result.push_back({b, Side::right});
    }
    const ParameterInterval domain = knots.domain();
    if (closed && (parameter - domain.low <= reach || domain.high - parameter <= reach)) {
        result.push_back({domain.low, Side::right});
        result.push_back({domain.high, Side::left});
    }
    return result;
}

/// Length in the parameter that `radius` mm along the parameter line are, to first order; 0 where the line stands
/// still.
double reach(double radius, double speed) {
    return speed > 0.0 ? radius / speed : 0.0;
}

}  // namespace

std::vector<Curvature> curvatures_within(const Face& face, double u, double v, double radius) {
    const SurfaceDerivatives d = face.surface.derivatives(u, v, 1);
    const auto us = one_sided(face.surface.u_knots(), face.u_closed, u, reach(radius, d.r_u().norm()));
    const auto vs = one_sided(face.surface.v_knots(), face.v_closed, v, reach(radius, d.r_v().norm()));
    std::vector<Curvature> result;
    for (const OneSided& a : us)
        for (const OneSided& b : vs) {
            const Curvature c = curvature(face.surface.derivatives(a.parameter, b.parameter, 2, a.side, b.side));
            if (c.regular) result.push_back(face.reversed ? flipped(c) : c);
        }
    return result;
}

bool near_knot_line(const NurbsSurface& surface, double u, double v, double radius, int continuity) {
    const SurfaceDerivatives d = surface.derivatives(u, v, 1);
    return !breaks_within(surface.u_knots(), u, reach(radius, d.r_u().norm()), continuity).empty() ||
           !breaks_within(surface.v_knots(), v, reach(radius, d.r_v().norm()), continuity).empty();
}

}  // namespace umbilic
