// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/points/fit_points.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/points/low_pass.h>
#include <umbilic/points/multilevel_spline.h>
#include <umbilic/points/point_jets.h>

namespace umbilic {

namespace {

/// Jets that estimate the noise.
constexpr int noise_jets = 400;
/// Weight of the poles' second differences: far below what a point weighs, so that it matters only where there is none.
constexpr double fairness = 1e-9;
/// Re-projection ends when the rms falls by less than this part.
constexpr double reprojection_fall = 1e-3;
constexpr int newton_steps = 12;
/// A net that is grown starts here and grows by this factor; at least this many points stand behind each pole.
constexpr int first_poles = 5;
constexpr double growth = 1.35, points_per_pole = 3.0;
/// Points whose surface is steeper than this over the base plane (cosine) fold over it; that many of them may be noise.
constexpr double steepest_cosine = 0.1, folded_share = 0.02;
constexpr double rounding = 1e-12;
/// Points whose rectangle is narrower than this part of its length lie on a line but for rounding in files.
constexpr double narrowest = 1e-9;

void check(const PointCloud& cloud, const FitOptions& options) {
    const auto wrong = [](const std::string& what) { throw InvalidInput("fit: " + what); };
    if (options.degree < 1 || options.degree > maximum_degree) wrong("the degree must lie between 1 and 25");
    if (options.poles && (options.poles->first <= options.degree || options.poles->second <= options.degree))
        wrong("each direction needs more poles than its degree " + std::to_string(options.degree));
    if (options.tolerance && !(std::isfinite(*options.tolerance) && *options.tolerance > 0.0))
        wrong("the tolerance must be a positive length in mm");
    if (options.most_poles <= options.degree) wrong("the greatest number of poles must exceed the degree");
    if (options.reprojections < 0) wrong("the number of re-projections must not be negative");
    if (options.method == FitMethod::grid && !options.grid) wrong("a grid needs its numbers of rows and columns");
    if (options.method == FitMethod::multilevel && options.degree != 3) wrong("multilevel splines are cubic");
    if (options.grid && cloud.merged + cloud.not_finite > 0)
        wrong("points of the grid were merged or skipped, so that its rows are broken; fit them as scattered points");
    const std::size_t fewest = static_cast<std::size_t>((options.degree + 1) * (options.degree + 1));
    if (cloud.points.size() < fewest)
        wrong("at least " + std::to_string(fewest) + " points are needed, not " + std::to_string(cloud.points.size()));
    if (options.poles && static_cast<std::size_t>(options.poles->first) * options.poles->second > cloud.points.size())
        wrong("more poles were asked for than there are points");
}

std::vector<PointJet> some_jets(const PointCloud& cloud, const Progress& progress) {
    const Neighbours neighbours(cloud.points);
    std::vector<int> indices;
    const std::size_t stride = std::max<std::size_t>(1, cloud.points.size() / noise_jets);
    for (std::size_t i = 0; i < cloud.points.size(); i += stride) indices.push_back(static_cast<int>(i));
    return point_jets(cloud, neighbours, indices, {}, progress);
}

/// Parameters in [0, 1]^2 of the points over the smallest of the rectangles along their main directions in their
/// regression plane; sides of the rectangle.
std::vector<ParametrisedPoint> on_base_plane(const PointCloud& cloud, const std::vector<PointJet>& jets, double& u_side,
                                             double& v_side) {
    Vector3 centre = Vector3::Zero();
    for (const Vector3& p : cloud.points) centre += p / static_cast<double>(cloud.points.size());
    Matrix3 scatter = Matrix3::Zero();
    for (const Vector3& p : cloud.points) scatter += (p - centre) * (p - centre).transpose();
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(scatter);
    const Vector3 normal = solver.eigenvectors().col(0);
    int folded = 0, known = 0;
    for (const PointJet& jet : jets) {
        if (!jet.valid) continue;
        ++known;
        if (std::abs(jet.frame.normal.dot(normal)) < steepest_cosine) ++folded;
    }
    if (folded > folded_share * known)
        throw Unsupported(
            "fit: the points fold over their regression plane; cut them into pieces that project onto a "
            "plane one-to-one, or give them as a grid (--grid ROWSxCOLUMNS)");

    // Of the rectangles turned in steps of a degree the smallest: borders of a patch then run along parameter lines.
    Vector3 best_x = solver.eigenvectors().col(2);
    double best_area = INFINITY;
    const Vector3 first = solver.eigenvectors().col(2), second = normal.cross(first);
    const auto extent = [&](const Vector3& direction) {
        double low = INFINITY, high = -INFINITY;
        for (const Vector3& p : cloud.points) {
            low = std::min(low, direction.dot(p - centre));
            high = std::max(high, direction.dot(p - centre));
        }
        return std::pair(low, high);
    };
    for (int degree = 0; degree < 90; ++degree) {
        const double angle = degree * M_PI / 180.0;
        const Vector3 x = std::cos(angle) * first + std::sin(angle) * second;
        const auto [x_low, x_high] = extent(x);
        const auto [y_low, y_high] = extent(normal.cross(x));
        const double area = (x_high - x_low) * (y_high - y_low);
        if (area < best_area * (1.0 - rounding)) best_area = area, best_x = x;
    }
    const Vector3 best_y = normal.cross(best_x);
    const auto [x_low, x_high] = extent(best_x);
    const auto [y_low, y_high] = extent(best_y);
    u_side = x_high - x_low;
    v_side = y_high - y_low;
    if (!(std::min(u_side, v_side) > narrowest * std::max(u_side, v_side)))
        throw InvalidInput("fit: the points lie on a line; no surface is determined");
    std::vector<ParametrisedPoint> result;
    for (const Vector3& p : cloud.points)
        result.push_back({std::clamp((best_x.dot(p - centre) - x_low) / u_side, 0.0, 1.0),
                          std::clamp((best_y.dot(p - centre) - y_low) / v_side, 0.0, 1.0), p});
    return result;
}

/// Moves the parameters to the foot of the perpendicular near them (Newton's method, each step shortened until the
/// distance falls); they stay in the domain.
void project(const NurbsSurface& surface, ParametrisedPoint& p) {
    const ParameterBox domain = surface.domain();
    double square = (surface.value(p.u, p.v) - p.point).squaredNorm();
    for (int step = 0; step < newton_steps; ++step) {
        const SurfaceDerivatives d = surface.derivatives(p.u, p.v, 2);
        const Vector3 offset = d.r() - p.point;
        const Vector2 gradient(offset.dot(d.r_u()), offset.dot(d.r_v()));
        Matrix2 hessian;
        hessian(0, 0) = d.r_u().squaredNorm() + offset.dot(d.r_uu());
        hessian(1, 1) = d.r_v().squaredNorm() + offset.dot(d.r_vv());
        hessian(0, 1) = hessian(1, 0) = d.r_u().dot(d.r_v()) + offset.dot(d.r_uv());
        if (!(hessian(0, 0) > 0.0 && hessian.determinant() > 0.0)) {
            hessian(0, 0) = d.r_u().squaredNorm();
            hessian(1, 1) = d.r_v().squaredNorm();
            hessian(0, 1) = hessian(1, 0) = d.r_u().dot(d.r_v());
        }
        Vector2 move = -hessian.inverse() * gradient;
        if (!move.allFinite()) return;
        // At an edge of the domain the way goes along it.
        const bool u_held = (p.u <= domain.u.low && move.x() < 0.0) || (p.u >= domain.u.high && move.x() > 0.0);
        const bool v_held = (p.v <= domain.v.low && move.y() < 0.0) || (p.v >= domain.v.high && move.y() > 0.0);
        if (u_held) move = Vector2(0.0, -gradient.y() / hessian(1, 1));
        if (v_held) move = Vector2(u_held ? 0.0 : -gradient.x() / hessian(0, 0), 0.0);
        double part = 1.0;
        bool moved = false;
        for (int halving = 0; halving < 8 && !moved; ++halving, part *= 0.5) {
            const double u = domain.u.clamp(p.u + part * move.x()), v = domain.v.clamp(p.v + part * move.y());
            const double there = (surface.value(u, v) - p.point).squaredNorm();
            if (there < square) {
                p.u = u, p.v = v, square = there;
                moved = true;
            }
        }
        if (!moved || part * move.norm() < rounding) return;
    }
}

void project_all(const NurbsSurface& surface, std::vector<ParametrisedPoint>& points, const Progress& progress) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 256), [&](const auto& range) {
        progress.check();
        for (std::size_t i = range.begin(); i < range.end(); ++i) project(surface, points[i]);
    });
}

double signed_distance(const NurbsSurface& surface, const ParametrisedPoint& p) {
    const SurfaceDerivatives d = surface.derivatives(p.u, p.v, 1);
    const Vector3 offset = p.point - d.r();
    return regular(d) ? std::copysign(offset.norm(), offset.dot(unit_normal(d))) : offset.norm();
}

/// A net, and how well it does.
struct Net {
    NurbsSurface surface;
    std::vector<ParametrisedPoint> points;
    FitStep step;
};

FitStep measured(const NurbsSurface& surface, const std::vector<ParametrisedPoint>& points) {
    FitStep step{surface.u_pole_count(), surface.v_pole_count()};
    double square = 0.0;
    for (const ParametrisedPoint& p : points) {
        const double d = (surface.value(p.u, p.v) - p.point).norm();
        square += d * d;
        step.maximum = std::max(step.maximum, d);
    }
    step.rms = std::sqrt(square / static_cast<double>(points.size()));
    return step;
}

/// Fits, takes foot points, and again, while the rms falls.
template <class Fit>
Net reprojected(const Fit& fit, std::vector<ParametrisedPoint> points, int reprojections, const Progress& progress) {
    NurbsSurface surface = fit(points);
    Net best{surface, points, measured(surface, points)};
    for (int i = 0; i < reprojections; ++i) {
        progress.report(static_cast<double>(i) / reprojections, "foot points");
        project_all(surface, points, progress);
        surface = fit(points);
        const FitStep step = measured(surface, points);
        const bool falls = step.rms < (1.0 - reprojection_fall) * best.step.rms;
        if (step.rms < best.step.rms) best = {surface, points, step};
        if (!falls) break;
    }
    project_all(best.surface, best.points, progress);
    best.step = measured(best.surface, best.points);
    return best;
}

/// What the rms of noise alone would be after poles have taken up their part of it.
bool is_noise(const FitStep& step, double noise, std::size_t points) {
    const double left = 1.0 - static_cast<double>(step.u_poles) * step.v_poles / static_cast<double>(points);
    return step.rms <= noise_reached * noise * std::sqrt(std::max(left, 0.0));
}

/// True if a net need not grow any more.
bool good_enough(const FitStep& step, double noise, std::size_t points, const FitOptions& options) {
    return options.tolerance ? step.maximum <= *options.tolerance : is_noise(step, noise, points);
}

std::pair<int, int> net_size(double poles, double u_side, double v_side, const FitOptions& options) {
    const double aspect = std::sqrt(u_side / v_side);
    const auto limited = [&](double count) {
        return std::clamp(static_cast<int>(std::lround(count)), options.degree + 1, options.most_poles);
    };
    return {limited(poles * aspect), limited(poles / aspect)};
}

/// Nets of growing size until the residual is noise, or larger nets bring no more.
template <class FitSize>
Net grown(const FitSize& fit_size, double u_side, double v_side, std::size_t points, double noise,
          const FitOptions& options, std::vector<FitStep>& steps, const Progress& progress) {
    std::optional<Net> best;
    int idle = 0;
    for (double poles = std::max(first_poles, options.degree + 1);; poles *= growth) {
        const auto [m, n] = net_size(poles, u_side, v_side, options);
        if (best && (m * n * points_per_pole > static_cast<double>(points) ||
                     (m == best->step.u_poles && n == best->step.v_poles)))
            break;
        progress.report(std::min(0.95, poles / options.most_poles), "fitting a larger net");
        Net net = fit_size(m, n, best ? &*best : nullptr);
        steps.push_back(net.step);
        const bool worth = !best || net.step.rms < (1.0 - worthwhile_fall) * best->step.rms ||
                           (options.tolerance && net.step.maximum <= *options.tolerance);
        idle = worth ? 0 : idle + 1;
        if (worth) best = std::move(net);
        if (good_enough(best->step, noise, points, options) || idle == 2 ||
            (m == options.most_poles && n == options.most_poles) ||
            best->step.rms <= rounding * std::max(u_side, v_side))
            break;
    }
    return std::move(*best);
}

FitResult finished(Net net, FitMethod method, double noise, std::vector<FitStep> steps) {
    FitResult result{.surface = std::move(net.surface), .method = method, .points = std::move(net.points)};
    for (const ParametrisedPoint& p : result.points) {
        result.distances.push_back(signed_distance(result.surface, p));
        result.mean += std::abs(result.distances.back()) / static_cast<double>(result.points.size());
    }
    result.rms = net.step.rms;
    result.maximum = net.step.maximum;
    result.noise = noise;
    result.reached_noise = is_noise(net.step, noise, result.points.size());
    result.steps = std::move(steps);
    return result;
}

FitResult fit_as_grid(const PointCloud& cloud, double noise, const FitOptions& options, const Progress& progress) {
    const PointGrid grid{options.grid->first, options.grid->second, cloud.points};
    const std::vector<double> u = chord_length_u(grid), v = chord_length_v(grid);
    std::vector<ParametrisedPoint> points;
    for (int i = 0; i < grid.rows; ++i)
        for (int j = 0; j < grid.columns; ++j) points.push_back({u[i], v[j], grid.points[i * grid.columns + j]});
    const auto fit_size = [&](int m, int n, const Net*) {
        m = std::min(m, grid.rows);
        n = std::min(n, grid.columns);
        const NurbsSurface surface =
            fit_grid(grid, u, v, fitting_knots(options.degree, m, u), fitting_knots(options.degree, n, v));
        Net net{surface, points, {}};
        project_all(net.surface, net.points, progress);
        net.step = measured(net.surface, net.points);
        return net;
    };
    std::vector<FitStep> steps;
    if (options.poles) {
        Net net = fit_size(options.poles->first, options.poles->second, nullptr);
        steps.push_back(net.step);
        return finished(std::move(net), FitMethod::grid, noise, std::move(steps));
    }
    Net net = grown(fit_size, grid.rows, grid.columns, points.size(), noise, options, steps, progress);
    return finished(std::move(net), FitMethod::grid, noise, std::move(steps));
}

FitResult fit_multilevel(std::vector<ParametrisedPoint> points, double u_side, double v_side, double noise,
                         const FitOptions& options, const Progress& progress) {
    const double aspect = u_side / v_side;
    MultilevelOptions levels{.u_start = std::max(1, static_cast<int>(std::lround(aspect))),
                             .v_start = std::max(1, static_cast<int>(std::lround(1.0 / aspect)))};
    std::vector<FitStep> steps;
    std::optional<Net> best;
    for (levels.levels = 1;; ++levels.levels) {
        const int m = (levels.u_start << (levels.levels - 1)) + 3, n = (levels.v_start << (levels.levels - 1)) + 3;
        const int most = options.poles ? std::max(options.poles->first, options.poles->second) : options.most_poles + 3;
        if (best && (std::max(m, n) > most || m * n * points_per_pole > static_cast<double>(points.size()))) break;
        const auto fit = [&](const std::vector<ParametrisedPoint>& at) {
            return multilevel_spline(at, levels).surface;
        };
        Net net = reprojected(fit, points, options.reprojections, progress);
        steps.push_back(net.step);
        points = net.points;
        const bool enough = good_enough(net.step, noise, points.size(), options);
        if (!best || net.step.rms < best->step.rms) best = std::move(net);
        if (!options.poles && enough) break;
    }
    return finished(std::move(*best), FitMethod::multilevel, noise, std::move(steps));
}

}  // namespace

FitResult fit_points(const PointCloud& cloud, const FitOptions& options, const Progress& progress) {
    check(cloud, options);
    PointCloud used = cloud;
    double rms_change = 0.0, max_change = 0.0;
    progress.report(0.0, "noise");
    const std::vector<PointJet> jets = some_jets(cloud, progress.part(0.0, 0.1));
    if (options.smooth) {
        LowPass filtered = low_pass(cloud, *options.smooth, progress.part(0.1, 0.2));
        used.points = std::move(filtered.points);
        rms_change = filtered.rms_change;
        max_change = filtered.max_change;
    }
    // What is left of the noise is seen by jets of the filtered points.
    const double noise =
        options.smooth ? estimated_noise(some_jets(used, progress.part(0.2, 0.25))) : estimated_noise(jets);
    const Progress fitting = progress.part(0.25, 1.0);
    FitResult result = [&] {
        if (options.grid) return fit_as_grid(used, noise, options, fitting);
        double u_side = 0.0, v_side = 0.0;
        std::vector<ParametrisedPoint> base = on_base_plane(used, jets, u_side, v_side);
        if (options.method == FitMethod::multilevel)
            return fit_multilevel(std::move(base), u_side, v_side, noise, options, fitting);
        const auto fit_size = [&](int m, int n, const Net* last) {
            const KnotVector u_knots = uniform_knots(options.degree, m), v_knots = uniform_knots(options.degree, n);
            const auto fit = [&](const std::vector<ParametrisedPoint>& points) {
                return fit_scattered(points, u_knots, v_knots, fairness);
            };
            return reprojected(fit, last ? last->points : base, options.reprojections, fitting);
        };
        std::vector<FitStep> steps;
        if (options.poles) {
            Net net = fit_size(options.poles->first, options.poles->second, nullptr);
            steps.push_back(net.step);
            return finished(std::move(net), FitMethod::scattered, noise, std::move(steps));
        }
        Net net = grown(fit_size, u_side, v_side, base.size(), noise, options, steps, fitting);
        return finished(std::move(net), FitMethod::scattered, noise, std::move(steps));
    }();
    result.within_tolerance = options.tolerance && result.maximum <= *options.tolerance;
    result.filter_rms_change = rms_change;
    result.filter_max_change = max_change;
    progress.report(1.0, "fitted");
    return result;
}

const char* name(FitMethod method) {
    switch (method) {
        case FitMethod::scattered:
            return "scattered";
        case FitMethod::multilevel:
            return "multilevel";
        case FitMethod::grid:
            return "grid";
    }
    return "scattered";
}

}  // namespace umbilic
