// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/curvature_surfaces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/LU>

#include <umbilic/bernstein/projected_polyhedron.h>
#include <umbilic/core/errors.h>
#include <umbilic/nurbs/bezier_patch.h>
#include <umbilic/points/multilevel_spline.h>

namespace umbilic {

namespace {

/// Solutions of neighbouring pieces that are nearer than this part of the domain are one.
constexpr double same_place = 1e-9;

double at_share(double share, const ParameterInterval& range) {
    return range.low + share * range.length();
}

/// Slopes by s and t of a bicubic Bernstein polynomial at (s, t).
Vector2 slopes(const std::vector<double>& c, double s, double t) {
    const auto basis = [](double x) { return std::array{(1 - x) * (1 - x), 2 * x * (1 - x), x * x}; };
    const auto cubic = [](double x) {
        const double y = 1 - x;
        return std::array{y * y * y, 3 * x * y * y, 3 * x * x * y, x * x * x};
    };
    const auto slope_s = basis(s), slope_t = basis(t);
    const auto at_s = cubic(s), at_t = cubic(t);
    Vector2 result = Vector2::Zero();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) {
            result.x() += 3 * slope_s[i] * at_t[j] * (c[4 * (i + 1) + j] - c[4 * i + j]);
            result.y() += 3 * slope_t[i] * at_s[j] * (c[4 * j + i + 1] - c[4 * j + i]);
        }
    return result;
}

Interval range_of(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {*low, *high};
}

}  // namespace

CurvatureSurfaces::CurvatureSurfaces(const NurbsSurface& surface, const CurvatureSurfaceOptions& options,
                                     const Progress& progress)
    : domain_(surface.domain()) {
    if (options.samples < 2 || options.samples > 2000)
        throw InvalidInput("surfaces of curvature: samples must lie between 2 and 2000");
    std::vector<ParametrisedPoint> points;
    const auto add = [&](double u, double v) {
        const Curvature c = curvature(surface, at_share(u, domain_.u), at_share(v, domain_.v));
        if (c.regular) points.push_back({u, v, Vector3(c.gaussian(), c.mean(), 0.0)});
    };
    for (int i = 0; i < options.samples; ++i)
        for (int j = 0; j < options.samples; ++j)
            add(static_cast<double>(i) / (options.samples - 1), static_cast<double>(j) / (options.samples - 1));
    if (points.empty()) throw InvalidInput("surfaces of curvature: the surface has no regular point");
    const NurbsSurface spline = multilevel_spline(points, {.levels = options.levels}, progress).surface;

    const int cells = options.samples - 1;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            const double u = (i + 0.5) / cells, v = (j + 0.5) / cells;
            const Curvature c = curvature(surface, at_share(u, domain_.u), at_share(v, domain_.v));
            if (!c.regular) continue;
            const Vector3 value = spline.value(u, v);
            gaussian_error_ = std::max(gaussian_error_, std::abs(value.x() - c.gaussian()));
            mean_error_ = std::max(mean_error_, std::abs(value.y() - c.mean()));
        }
    for (const BezierPatch& patch : bezier_patches(spline).patches) {
        Piece piece{.domain = patch.domain};
        for (const Vector4& pole : patch.poles) {
            piece.gaussian.push_back(pole.x() + patch.origin.x());
            piece.mean.push_back(pole.y() + patch.origin.y());
        }
        piece.gaussian_range = range_of(piece.gaussian);
        piece.mean_range = range_of(piece.mean);
        pieces_.push_back(std::move(piece));
    }
}

std::vector<CurvaturePosition> CurvatureSurfaces::find(const CurvatureQuery& query, const Progress& progress) const {
    if (query.gaussian_tolerance != 0.0 || query.mean_tolerance != 0.0)
        throw InvalidInput("surfaces of curvature: the query must not have tolerances");
    std::vector<CurvaturePosition> result;
    for (const bool opposite : {false, true}) {
        const double mean = opposite ? -query.mean : query.mean;
        if (opposite && query.mean == 0.0) continue;
        progress.check();
        for (const Piece& piece : pieces_) {
            if (!piece.gaussian_range.contains(query.gaussian) || !piece.mean_range.contains(mean)) continue;
            std::vector<MultivariatePolynomial> system = {{{3, 3}, piece.gaussian, 0.0}, {{3, 3}, piece.mean, 0.0}};
            for (double& c : system[0].coefficients) c -= query.gaussian;
            for (double& c : system[1].coefficients) c -= mean;
            const SystemRoots roots = solve_projected_polyhedron(system, {.tolerance = same_place}, progress);
            std::vector<Vector2> places;
            for (const SystemRoot& root : roots.roots) places.emplace_back(root.at[0], root.at[1]);
            // What could not be told from a double solution: the middle of each cluster's first box.
            int cluster = -1;
            for (const UndecidedBox& box : roots.undecided) {
                if (box.cluster <= cluster) continue;
                cluster = box.cluster;
                places.emplace_back(0.5 * (box.box[0].low + box.box[0].high), 0.5 * (box.box[1].low + box.box[1].high));
            }
            for (const Vector2& place : places) {
                const Vector2 share(at_share(place.x(), piece.domain.u), at_share(place.y(), piece.domain.v));
                const CurvaturePosition at{
                    .opposite = opposite, .u = at_share(share.x(), domain_.u), .v = at_share(share.y(), domain_.v)};
                const bool known = std::any_of(result.begin(), result.end(), [&](const CurvaturePosition& other) {
                    return other.opposite == opposite && std::abs(other.u - at.u) <= same_place * domain_.u.length() &&
                           std::abs(other.v - at.v) <= same_place * domain_.v.length();
                });
                if (known) continue;
                Matrix2 slope;
                slope << slopes(piece.gaussian, place.x(), place.y()).transpose(),
                    slopes(piece.mean, place.x(), place.y()).transpose();
                const Vector2 off = slope.inverse().cwiseAbs() * Vector2(gaussian_error_, mean_error_);
                result.push_back(at);
                result.back().radius = {off.x() * piece.domain.u.length() * domain_.u.length(),
                                        off.y() * piece.domain.v.length() * domain_.v.length()};
            }
        }
    }
    std::sort(result.begin(), result.end(), [](const CurvaturePosition& a, const CurvaturePosition& b) {
        return std::tuple(a.opposite, a.u, a.v) < std::tuple(b.opposite, b.u, b.v);
    });
    return result;
}

}  // namespace umbilic
