// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/geodesic.h>

#include <cmath>

#include <umbilic/core/errors.h>
#include <umbilic/curves/geodesic_path.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

double geodesic_curvature(const SurfaceDerivatives& d, const Vector2& velocity, const Vector2& acceleration) {
    const auto [E, F, G] = first_form(d);
    // The tangential part of the curve's acceleration, as components; what it lacks to a geodesic's turns the curve.
    const Vector2 excess = acceleration - geodesic_acceleration(d, velocity);
    const double cross = velocity.x() * excess.y() - velocity.y() * excess.x();
    const double squared_speed =
        E * velocity.x() * velocity.x() + 2 * F * velocity.x() * velocity.y() + G * velocity.y() * velocity.y();
    return std::sqrt(E * G - F * F) * cross / std::pow(squared_speed, 1.5);
}

SurfaceCurve geodesic(const Face& face, const Vector2& start, const Vector3& direction, double length,
                      const GeodesicOptions& options, const Progress& progress) {
    const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
    if (!positive(length)) throw InvalidInput("geodesic: the length must be finite and positive");
    if (!positive(options.tolerance)) throw InvalidInput("geodesic: the tolerance must be finite and positive");
    if (!std::isfinite(options.spacing) || options.spacing < 0.0)
        throw InvalidInput("geodesic: the spacing must be finite and not negative");
    check_on_face(face, start, "geodesic");
    const Vector3 normal = unit_normal(face.surface.derivatives(start.x(), start.y(), 1));
    const Vector3 along = direction - direction.dot(normal) * normal;
    // Rounding alone leaves less of a direction along the normal.
    if (!direction.allFinite() || !(along.norm() > regularity * direction.norm()))
        throw InvalidInput("geodesic: the direction must be finite and have a part in the tangent plane");
    const SurfacePath path =
        geodesic_path(face, start, along, length, {.joins = options.joins, .tolerance = options.tolerance}, progress);
    SurfaceCurve curve = sampled(path, 0, options.spacing);
    if (curve.points.empty())
        curve.points.push_back({0.0, {face.number, start.x(), start.y()}, face.surface.value(start.x(), start.y())});
    return curve;
}

}  // namespace umbilic
