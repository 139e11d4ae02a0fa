// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/pattern.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <umbilic/core/errors.h>
#include <umbilic/differential/fundamental_forms.h>

#include <report/mark.h>

namespace umbilic {

namespace {

/// Radius of the disc relative to sqrt(area of the face), and to the way to the nearest other umbilic.
constexpr double face_share = 0.06, neighbour_share = 0.45;
/// Rings of points from which lines are traced, relative to the radius, and points on a ring.
constexpr double rings[] = {0.35, 0.75};
constexpr int points_on_ring = 6;
/// Points of a line across the disc.
constexpr int points_of_line = 24;
/// Accuracy of a drawing.
constexpr double drawing_tolerance = 1e-6;
constexpr double half_side = 50.0;

Vector2 in_plane(const Umbilic& umbilic, const Vector3& point) {
    const Vector3 way = point - umbilic.point;
    return {way.dot(umbilic.x_axis), way.dot(umbilic.normal.cross(umbilic.x_axis))};
}

UmbilicPattern::Line line_of(const Umbilic& umbilic, const SurfaceCurve& curve, CurvatureFamily family,
                             bool separatrix) {
    UmbilicPattern::Line line{family, separatrix, {}};
    for (const SurfaceCurvePoint& point : curve.points) line.points.push_back(in_plane(umbilic, point.point));
    return line;
}

}  // namespace

UmbilicPattern trace_pattern(const Face& face, const Umbilic& umbilic, const std::vector<Umbilic>& others,
                             const Progress& progress) {
    UmbilicPattern pattern;
    pattern.radius = face_share * std::sqrt(face.area);
    for (const Umbilic& other : others)
        if (const double distance = (other.point - umbilic.point).norm(); distance > 0.0)
            pattern.radius = std::min(pattern.radius, neighbour_share * distance);
    if (umbilic.kind.type == UmbilicType::non_generic || umbilic.containment != Containment::inside ||
        !(pattern.radius > 0.0))
        return pattern;

    LineOfCurvatureOptions options;
    options.tolerance = drawing_tolerance;
    options.length = 2.0 * pattern.radius;
    options.spacing = 2.0 * pattern.radius / points_of_line;
    try {
        for (const Separatrix& separatrix : separatrices(face, umbilic, options, progress))
            pattern.lines.push_back(line_of(umbilic, separatrix.curve, separatrix.family, true));
        const SurfaceDerivatives d = face.surface.derivatives(umbilic.at.u, umbilic.at.v, 1);
        const Vector3 y_axis = umbilic.normal.cross(umbilic.x_axis);
        Matrix2 metric;
        const auto [E, F, G] = first_form(d);
        metric << E, F, F, G;
        const Matrix2 inverse = metric.inverse();
        for (const double ring : rings)
            for (int k = 0; k < points_on_ring; ++k) {
                const double angle = 2.0 * std::numbers::pi * (k + 0.5 * ring) / points_on_ring;
                const Vector3 way =
                    ring * pattern.radius * (std::cos(angle) * umbilic.x_axis + std::sin(angle) * y_axis);
                const Vector2 start =
                    Vector2(umbilic.at.u, umbilic.at.v) + inverse * Vector2(d.r_u().dot(way), d.r_v().dot(way));
                if (!face.surface.domain().contains(start.x(), start.y()) ||
                    face.region.classify(start.x(), start.y()) != Containment::inside)
                    continue;
                for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum})
                    pattern.lines.push_back(
                        line_of(umbilic, line_of_curvature(face, start, family, options, progress), family, false));
            }
    } catch (const NumericFailure&) {
        // Too rough to be traced: the directions alone are shown.
        pattern.lines.clear();
    }
    return pattern;
}

std::string pattern_svg(const Umbilic& umbilic, const UmbilicPattern& pattern) {
    std::string svg = fmt::format(
        "<svg class=\"pattern\" viewBox=\"{0} {0} {1} {1}\" role=\"img\" aria-label=\"Lines of curvature around the "
        "umbilic\">",
        -half_side, 2.0 * half_side);
    const double scale = half_side / pattern.radius;
    for (const bool separatrix : {false, true})
        for (const UmbilicPattern::Line& line : pattern.lines) {
            if (line.separatrix != separatrix) continue;
            std::string path;
            for (const Vector2& at : line.points)
                path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", scale * at.x(), -scale * at.y());
            svg += fmt::format("<path class=\"{}{}\" d=\"{}\"/>", name(line.family), separatrix ? " separatrix" : "",
                               path);
        }
    if (pattern.lines.empty())
        for (const double angle : umbilic.kind.angles)
            svg += fmt::format("<path class=\"direction\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>",
                               -half_side * std::cos(angle), half_side * std::sin(angle), half_side * std::cos(angle),
                               -half_side * std::sin(angle));
    return svg + mark_svg(umbilic.kind.type, 0.0, 0.0, 5.0) + "</svg>";
}

}  // namespace umbilic
