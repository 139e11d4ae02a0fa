// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/nurbs/boundary_point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace umbilic {

namespace {

/// First and second derivative of ParameterMap::surface(): with phi = d / 4 - (native - a) / 2 on the span [a, a + d],
/// the first is d sin(d / 2) / (8 sin^2(d / 4) cos^2(phi)).
std::pair<double, double> map_slopes(const ParameterMap& map, double native) {
    if (map.identity()) return {1.0, 0.0};
    const std::vector<double>& breaks = map.breaks();
    if (native < breaks.front() || native > breaks.back()) return {1.0, 0.0};
    const auto next = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, native);
    const double a = *(next - 1), d = *next - a;
    const double phi = d / 4 - (native - a) / 2;
    const double si = std::sin(d / 4), co = std::cos(phi);
    const double factor = d * std::sin(d / 2) / (8 * si * si);
    return {factor / (co * co), -factor * std::sin(phi) / (co * co * co)};
}

struct CurveDerivatives {
    Vector2 c, c_t, c_tt;
};

CurveDerivatives derivatives(const NurbsCurve2& curve, double t) {
    const int p = curve.knots().degree();
    std::array<double, 3 * (maximum_degree + 1)> basis;
    const int span = curve.knots().span(t);
    curve.knots().basis(span, t, 2, basis.data());
    std::array<Vector3, 3> h = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
    for (int i = 0; i <= p; ++i) {
        const int index = span - p + i;
        const double w = curve.weights().empty() ? 1.0 : curve.weights()[index];
        const Vector3 point(w * curve.poles()[index].x(), w * curve.poles()[index].y(), w);
        for (int k = 0; k < 3; ++k) h[k] += basis[k * (p + 1) + i] * point;
    }
    CurveDerivatives d;
    d.c = h[0].head<2>() / h[0].z();
    d.c_t = (h[1].head<2>() - h[1].z() * d.c) / h[0].z();
    d.c_tt = (h[2].head<2>() - 2 * h[1].z() * d.c_t - h[2].z() * d.c) / h[0].z();
    return d;
}

}  // namespace

BoundaryPoint boundary_point(const NurbsSurface& surface, const TrimmingRegion& region, const TrimmingCurve& curve,
                             double t) {
    const CurveDerivatives native = derivatives(curve.curve, t);
    const auto [u1, u2] = map_slopes(region.u_map(), native.c.x());
    const auto [v1, v2] = map_slopes(region.v_map(), native.c.y());
    const ParameterBox domain = surface.domain();
    const double u = region.u_map().surface(native.c.x()), v = region.v_map().surface(native.c.y());
    const double u_t = u1 * native.c_t.x(), v_t = v1 * native.c_t.y();
    const double u_tt = u2 * native.c_t.x() * native.c_t.x() + u1 * native.c_tt.x();
    const double v_tt = v2 * native.c_t.y() * native.c_t.y() + v1 * native.c_tt.y();
    BoundaryPoint point;
    point.parameters = {domain.u.clamp(u), domain.v.clamp(v)};
    point.parameters_t = {u_t, v_t};
    const SurfaceDerivatives d = surface.derivatives(point.parameters.x(), point.parameters.y(), 2);
    point.r = d.r();
    point.r_t = u_t * d.r_u() + v_t * d.r_v();
    point.r_tt =
        u_t * u_t * d.r_uu() + 2 * u_t * v_t * d.r_uv() + v_t * v_t * d.r_vv() + u_tt * d.r_u() + v_tt * d.r_v();
    return point;
}

}  // namespace umbilic
