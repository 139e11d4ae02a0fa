// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/differential/curvature.h>

#include <cassert>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace umbilic {

Curvature curvature(const SurfaceDerivatives& d) {
    Curvature result;
    result.point = d.r();
    result.regular = regular(d);
    if (!result.regular) return result;

    const Vector3 cross = d.r_u().cross(d.r_v());
    const double area = cross.norm();
    result.normal = cross / area;
    const double speed = d.r_u().norm();
    const Vector3 x = d.r_u() / speed;
    const Vector3 y = result.normal.cross(x);
    // In the frame (x, y): r_u = speed x, r_v = a x + b y; the shape operator is symmetric there.
    const double a = d.r_v().dot(x);
    const double b = area / speed;
    const double L = result.normal.dot(d.r_uu());
    const double M = result.normal.dot(d.r_uv());
    const double N = result.normal.dot(d.r_vv());
    const double xx = -L / (speed * speed);
    const double xy = -(M - a / speed * L) / (speed * b);
    const double yy = -(N - 2 * a / speed * M + a * a / (speed * speed) * L) / (b * b);

    const double mean = 0.5 * (xx + yy);
    const double half = 0.5 * (xx - yy);
    const double radius = std::hypot(half, xy);
    result.kappa_max = mean + radius;
    result.kappa_min = mean - radius;
    // Eigenvector of the greater value, by the half-angle formula without cancellation.
    double c = 1.0, s = 0.0;
    if (radius > 0.0) {
        if (half >= 0.0) {
            c = radius + half;
            s = xy;
        } else {
            c = std::abs(xy);
            s = std::copysign(radius - half, xy);
        }
        const double length = std::hypot(c, s);
        c /= length;
        s /= length;
    }
    result.direction_max = c * x + s * y;
    result.direction_min = c * y - s * x;
    return result;
}

Curvature curvature(const NurbsSurface& surface, double u, double v) {
    return curvature(surface.derivatives(u, v, 2));
}

void curvatures(const NurbsSurface& surface, std::span<const Vector2> parameters, std::span<Curvature> result) {
    assert(parameters.size() == result.size());
    for (std::size_t i = 0; i < parameters.size(); ++i)
        result[i] = curvature(surface, parameters[i].x(), parameters[i].y());
}

Curvature flipped(const Curvature& curvature) {
    Curvature result = curvature;
    result.normal = -curvature.normal;
    result.kappa_max = -curvature.kappa_min;
    result.kappa_min = -curvature.kappa_max;
    result.direction_max = curvature.direction_min;
    result.direction_min = result.normal.cross(result.direction_max);
    return result;
}

}  // namespace umbilic
