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
    const Vector3 cross = d.r_u().cross(d.r_v());
    const double squared_area = cross.squaredNorm(), squared_speed = d.r_u().squaredNorm();
    result.regular = squared_area > regularity * regularity * squared_speed * d.r_v().squaredNorm();
    if (!result.regular) return result;

    const double area = std::sqrt(squared_area), speed = std::sqrt(squared_speed);
    const double per_area = 1.0 / area, per_speed = 1.0 / speed;
    result.normal = per_area * cross;
    const Vector3 x = per_speed * d.r_u();
    const Vector3 y = result.normal.cross(x);
    // In the frame (x, y): r_u = speed x, r_v = a x + b y with b = area / speed; the shape operator is symmetric there.
    const double per_b = speed * per_area;
    const double skew = d.r_v().dot(x) * per_speed;
    const double L = result.normal.dot(d.r_uu());
    const double M = result.normal.dot(d.r_uv());
    const double N = result.normal.dot(d.r_vv());
    const double xx = -L * per_speed * per_speed;
    const double xy = -(M - skew * L) * per_area;
    const double yy = -(N - 2 * skew * M + skew * skew * L) * per_b * per_b;

    const double mean = 0.5 * (xx + yy);
    const double half = 0.5 * (xx - yy);
    const double radius = std::sqrt(half * half + xy * xy);
    result.kappa_max = mean + radius;
    result.kappa_min = mean - radius;
    // Eigenvector of the greater value, by the half-angle formula without cancellation: (radius + |half|, |xy|) has the
    // squared length 2 radius (radius + |half|).
    double c = 1.0, s = 0.0;
    if (radius > 0.0) {
        const double sum = radius + std::abs(half);
        const double per_length = 1.0 / std::sqrt(2 * radius * sum);
        c = half >= 0.0 ? sum * per_length : std::abs(xy) * per_length;
        s = half >= 0.0 ? xy * per_length : std::copysign(sum * per_length, xy);
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
