// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Dense>
#include <tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/curves/geodesic.h>
#include <umbilic/curves/geodesic_path.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

namespace {

/// Directions of the first fan, and how wide (relative to sqrt(area)) two neighbours may stand apart before another one
/// is put between them; no more than most_rays in all.
constexpr int first_rays = 96;
constexpr double widest_gap = 0.4;
constexpr int most_rays = 1536;
/// Accuracy of the fan, which is refined afterwards, relative to sqrt(area).
constexpr double fan_tolerance = 1e-5;
/// A ray is a candidate if it passes the target within this many times its distance to its neighbour, or within this
/// share of sqrt(area) where neighbours cross.
constexpr double reach = 1.5;
constexpr double capture = 5e-3;
/// Newton's method for direction and length.
constexpr int most_steps = 40;
constexpr double converged = 1e-9;    ///< relative to sqrt(area): distance from the target
constexpr double longest_move = 0.3;  ///< relative to the length, and radians
/// Solutions of equal length and direction are one; a direction differs by more than rounding of the refinement.
constexpr double same_length = 1e-6, same_direction = 1e-5;
constexpr int halvings = 50;
/// Relative size of a pivot below which the target is taken to be conjugate to the start.
constexpr double singular = 1e-9;
/// Points of the target curve at which the fan is asked.
constexpr int curve_samples = 64;
/// First mesh and accuracy (relative to sqrt(area)) of the relaxation from the straight line.
constexpr int mesh_points = 33;
constexpr double relaxed = 1e-4;

struct Ray {
    double angle = 0.0, width = 0.0;  ///< width: angle to the farther neighbour
    SurfacePath path;
};

/// Direction and length of a geodesic from the start, and the parameter of the target curve.
struct Shot {
    double angle = 0.0, length = 0.0, t = 0.0;
};

struct Found {
    Shot shot;
    SurfaceCurve curve;
};

/// Point of the target at the parameter t with two derivatives by it; both zero for a point.
struct TargetPoint {
    Vector3 point = Vector3::Zero(), tangent = Vector3::Zero(), second = Vector3::Zero();
};

struct Search {
    const Model& model;
    const Face& face;
    Vector2 from;
    const GeodesicSearchOptions& options;
    const Progress& progress;
    double size = 0.0, longest = 0.0;
    Vector3 x, y;  ///< orthonormal tangents at the start

    Search(const Model& of, const SurfacePoint& start, const GeodesicSearchOptions& chosen, const Progress& reported)
        : model(of), face(of.face(start.face)), from(start.u, start.v), options(chosen), progress(reported) {
        const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
        if (!positive(options.tolerance)) throw InvalidInput("geodesic: the tolerance must be finite and positive");
        if (!std::isfinite(options.spacing) || options.spacing < 0.0)
            throw InvalidInput("geodesic: the spacing must be finite and not negative");
        if (!std::isfinite(options.longest) || options.longest < 0.0)
            throw InvalidInput("geodesic: the greatest length must be finite and not negative");
        if (options.most < 1) throw InvalidInput("geodesic: at least one solution must be allowed");
        check_on_face(face, from, "geodesic");
        size = extent(face);
        double diagonal = model.box.diagonal();
        if (!(diagonal > 0.0)) diagonal = face.surface.pole_box().diagonal();
        longest = options.longest > 0.0 ? options.longest : 2 * diagonal;
        const SurfaceDerivatives d = face.surface.derivatives(from.x(), from.y(), 1);
        x = d.r_u().normalized();
        y = unit_normal(d).cross(x);
    }

    SurfacePath shoot(double angle, double length, double tolerance) const {
        return geodesic_path(face, from, std::cos(angle) * x + std::sin(angle) * y, length,
                             {.joins = options.joins, .tolerance = tolerance}, progress);
    }

    static double widest(const SurfacePath& path) {
        double most = 0.0;
        for (const PathStep& step : path.steps) most = std::max(most, std::abs(step.end[4]));
        return most;
    }

    /// Geodesics in all directions, dense enough in space.
    std::vector<Ray> fan() const {
        std::vector<double> angles;
        for (int i = 0; i < first_rays; ++i) angles.push_back(2 * std::numbers::pi * i / first_rays);
        double width = 2 * std::numbers::pi / first_rays;
        std::vector<Ray> rays;
        while (true) {
            std::vector<Ray> more(angles.size());
            tbb::parallel_for(std::size_t{0}, angles.size(), [&](std::size_t i) {
                more[i] = {angles[i], width, shoot(angles[i], longest, fan_tolerance)};
            });
            angles.clear();
            for (Ray& ray : more) {
                // A ray that spreads too far is joined by two others halfway to where its neighbours were.
                const double spread = widest(ray.path);
                if (spread * width > widest_gap * size)
                    for (const double sign : {-0.5, 0.5}) angles.push_back(ray.angle + sign * width * 2 / 3);
                rays.push_back(std::move(ray));
            }
            if (angles.empty() || rays.size() + angles.size() > most_rays) return rays;
            width /= 3;
        }
    }

    /// Where the rays of a fan pass a point closely.
    std::vector<Shot> candidates(const std::vector<Ray>& rays, const Vector3& target) const {
        std::vector<Shot> result;
        for (const Ray& ray : rays)
            for (std::size_t i = 0; i < ray.path.steps.size(); ++i) {
                const PathStep& step = ray.path.steps[i];
                const double jacobi = std::max(std::abs(step.start[4]), std::abs(step.end[4]));
                const double near = reach * jacobi * ray.width + capture * size;
                const Vector2 start(step.start[0], step.start[1]);
                if ((step.pieces[0].derivatives(start, 0).r() - target).norm() > 1.5 * (near + step.length)) continue;
                const auto ahead = [&](double x_at) {
                    const GeodesicState state = geodesic_state(step, x_at);
                    return (target - state.point).dot(state.tangent);
                };
                if (!(ahead(0.0) >= 0.0)) continue;
                double low = 0.0, high = 1.0;
                if (ahead(1.0) > 0.0) {
                    // The path may end just before it passes.
                    if (i + 1 < ray.path.steps.size() || ray.path.ended == CurveEnd::length) continue;
                    low = 1.0;
                } else {
                    for (int n = 0; n < halvings; ++n) {
                        const double middle = 0.5 * (low + high);
                        (ahead(middle) >= 0.0 ? low : high) = middle;
                    }
                }
                const GeodesicState state = geodesic_state(step, low);
                const Vector3 offset = target - state.point;
                if (offset.norm() > near) continue;
                const double sideways = offset.dot(state.side());
                double turn = 0.0;
                if (std::abs(state.jacobi) > 0.0)
                    turn = std::clamp(sideways / state.jacobi, -reach * ray.width, reach * ray.width);
                result.push_back({ray.angle + turn, step.s + low * step.length + offset.dot(state.tangent), 0.0});
            }
        return result;
    }

    /// Newton's method; `target` gives the point aimed at, or a curve that is to be met at a right angle.
    std::optional<Found> refine(Shot shot, const std::function<TargetPoint(double)>& target,
                                const ParameterInterval& range, int target_face) const {
        const double enough = converged * size;
        double before = std::numeric_limits<double>::infinity();
        std::optional<std::pair<Shot, SurfacePath>> best;
        for (int i = 0; i < most_steps; ++i) {
            if (!(shot.length > 0.0) || shot.length > longest * (1 + same_length)) break;
            SurfacePath path = shoot(shot.angle, shot.length, options.tolerance);
            if (path.steps.empty()) break;
            const GeodesicState end = geodesic_state(path.steps.back(), 1.0);
            const double lacking = shot.length - path.length;
            if (lacking > longest_move * size) break;
            const TargetPoint aim = target(shot.t);
            // What is missing of a path that a border has cut goes on straight.
            const Vector3 offset = aim.point - end.point - lacking * end.tangent;
            const Vector3 side = end.side();
            const bool curve = aim.tangent.norm() > 0.0;
            const double askew = curve ? end.tangent.dot(aim.tangent) / aim.tangent.norm() : 0.0;
            const double miss = offset.norm() + size * std::abs(askew);
            const int last_face = path.steps.back().pieces[0].face->number;
            const bool there =
                miss <= enough && lacking <= enough && (last_face == target_face || options.joins != nullptr);
            // Steps are taken as long as they bring the end nearer.
            if (there) {
                if (best && miss >= before) break;
                best = {shot, std::move(path)};
                if (miss <= 0.0) break;
            } else if (best) {
                break;
            }
            before = miss;
            Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
            matrix << end.jacobi, 0.0, -aim.tangent.dot(side), 0.0, 1.0, -aim.tangent.dot(end.tangent), 0.0, 0.0, 1.0;
            Eigen::Vector3d right(offset.dot(side), offset.dot(end.tangent), 0.0);
            if (curve) {
                matrix.row(2) << end.jacobi_slope * aim.tangent.dot(side), 0.0, aim.second.dot(end.tangent);
                right[2] = -aim.tangent.dot(end.tangent);
            }
            // Where all directions lead to the target (J = 0) the smallest solution keeps the direction.
            Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> solver;
            Eigen::Matrix3d scaled = matrix;
            scaled.col(0) /= size;
            if (curve) {
                scaled.row(2) *= size / aim.tangent.norm();
                right[2] *= size / aim.tangent.norm();
            }
            solver.setThreshold(singular);
            solver.compute(scaled);
            Eigen::Vector3d move = solver.solve(right);
            move[0] /= size;
            if (!move.allFinite()) break;
            double share = 1.0;
            if (std::abs(move[0]) > longest_move) share = std::min(share, longest_move / std::abs(move[0]));
            const double most = longest_move * std::max(shot.length, 0.1 * size);
            if (std::abs(move[1]) > most) share = std::min(share, most / std::abs(move[1]));
            shot.angle += share * move[0];
            shot.length += share * move[1];
            if (curve) {
                shot.t += share * move[2];
                if (!(shot.t >= range.low && shot.t <= range.high)) break;
            }
        }
        if (!best) return std::nullopt;
        Found found{best->first, sampled(best->second, 0, options.spacing)};
        found.curve.ended = CurveEnd::point;
        found.curve.error += before;
        found.shot.angle -= 2 * std::numbers::pi * std::floor(found.shot.angle / (2 * std::numbers::pi));
        return found;
    }

    GeodesicSearch result(std::vector<Found> all) const {
        std::sort(all.begin(), all.end(), [&](const Found& a, const Found& b) {
            if (std::abs(a.shot.length - b.shot.length) > same_length * size) return a.shot.length < b.shot.length;
            return a.shot.angle < b.shot.angle;
        });
        GeodesicSearch search;
        std::vector<Shot> kept;
        for (Found& found : all) {
            const bool known = std::any_of(kept.begin(), kept.end(), [&](const Shot& other) {
                const double turn = std::abs(std::remainder(other.angle - found.shot.angle, 2 * std::numbers::pi));
                return std::abs(other.length - found.shot.length) <= same_length * size && turn <= same_direction;
            });
            if (known) continue;
            kept.push_back(found.shot);
            search.curves.push_back(std::move(found.curve));
            if (static_cast<int>(search.curves.size()) == options.most) break;
        }
        return search;
    }
};

/// Start direction and length of the relaxed straight line between two points of one face.
std::optional<Shot> from_relaxation(const Search& search, const Vector2& to) {
    BoundaryValueProblem problem = geodesic_problem(search.face, search.from, to);
    const Relaxation relaxation =
        relax(problem, straight_guess(search.from, to, mesh_points),
              {.tolerance = relaxed * search.size, .most_points = 16 * mesh_points}, search.progress);
    if (!relaxation.converged) return std::nullopt;
    const Eigen::VectorXd start = relaxation.states.col(0);
    const SurfaceDerivatives d = search.face.surface.derivatives(search.from.x(), search.from.y(), 1);
    const Vector3 velocity = d.r_u() * start[2] + d.r_v() * start[3];
    return Shot{std::atan2(velocity.dot(search.y), velocity.dot(search.x)), velocity.norm(), 0.0};
}

bool connected(const Search& search, int face) {
    if (face == search.face.number) return true;
    if (!search.options.joins) return false;
    const FaceAdjacency& adjacency = *search.options.joins->adjacency;
    return adjacency.shell_of[adjacency.borders.index[face]] ==
           adjacency.shell_of[adjacency.borders.index[search.face.number]];
}

std::string not_connected(const Search& search, int face) {
    const std::string faces =
        "face " + std::to_string(search.face.number) + " and face " + std::to_string(face) + " are ";
    return faces + (search.options.joins ? "not connected" : "different faces, and no joins between faces were given");
}

std::string none_found(const Search& search) {
    return "no geodesic of at most " + std::to_string(search.longest) + " mm was found that stays inside the surface";
}

}  // namespace

GeodesicSearch geodesics_between(const Model& model, const SurfacePoint& from, const SurfacePoint& to,
                                 const GeodesicSearchOptions& options, const Progress& progress) {
    const Search search(model, from, options, progress);
    const Face& last = model.face(to.face);
    const Vector2 end(to.u, to.v);
    check_on_face(last, end, "geodesic");
    TargetPoint target;
    target.point = last.surface.value(to.u, to.v);
    if ((target.point - search.face.surface.value(from.u, from.v)).norm() <= same_length * search.size &&
        from.face == to.face)
        throw InvalidInput("geodesic: both points are the same");
    if (!connected(search, to.face)) return {{}, not_connected(search, to.face)};

    std::vector<Shot> shots;
    if (from.face == to.face)
        if (const std::optional<Shot> shot = from_relaxation(search, end)) shots.push_back(*shot);
    const std::vector<Ray> rays = search.fan();
    for (const Shot& shot : search.candidates(rays, target.point)) shots.push_back(shot);
    std::vector<std::optional<Found>> found(shots.size());
    tbb::parallel_for(std::size_t{0}, shots.size(), [&](std::size_t i) {
        found[i] = search.refine(
            shots[i], [&](double) { return target; }, {0.0, 0.0}, to.face);
    });
    std::vector<Found> all;
    for (std::optional<Found>& one : found)
        if (one) {
            one->curve.points.back().at = to;
            all.push_back(std::move(*one));
        }
    GeodesicSearch result = search.result(std::move(all));
    if (result.curves.empty()) result.why = none_found(search);
    return result;
}

GeodesicSearch geodesics_to_curve(const Model& model, const SurfacePoint& from, const FaceCurve& to,
                                  const GeodesicSearchOptions& options, const Progress& progress) {
    const Search search(model, from, options, progress);
    const Face& face = model.face(to.face);
    if (!connected(search, to.face)) return {{}, not_connected(search, to.face)};
    const TrimmingRegion identity(face.surface.domain());
    const TrimmingCurve curve{to.curve};
    const auto target = [&](double t) {
        const BoundaryPoint b = boundary_point(face.surface, identity, curve, t);
        return TargetPoint{b.r, b.r_t, b.r_tt};
    };
    const ParameterInterval range = to.curve.domain();
    const std::vector<Ray> rays = search.fan();

    // The lengths of the geodesics to points of the curve, continued from point to point by direction, are stationary
    // where one of them meets the curve at a right angle: there the scalar product of the tangents changes its sign.
    std::vector<Shot> shots;
    std::vector<std::vector<std::pair<Shot, double>>> along(curve_samples + 1);
    for (int i = 0; i <= curve_samples; ++i) {
        const double t = range.low + range.length() * i / curve_samples;
        const TargetPoint aim = target(t);
        for (Shot shot : search.candidates(rays, aim.point)) {
            shot.t = t;
            const SurfacePath path = search.shoot(shot.angle, shot.length, fan_tolerance);
            if (path.steps.empty()) continue;
            along[i].emplace_back(shot, geodesic_state(path.steps.back(), 1.0).tangent.dot(aim.tangent));
        }
    }
    for (int i = 0; i < curve_samples; ++i)
        for (const auto& [shot, slope] : along[i])
            for (const auto& [next, next_slope] : along[i + 1]) {
                const double turn = std::abs(std::remainder(next.angle - shot.angle, 2 * std::numbers::pi));
                if (slope * next_slope > 0.0 || turn > longest_move) continue;
                const double share = slope == next_slope ? 0.5 : slope / (slope - next_slope);
                shots.push_back({shot.angle + share * std::remainder(next.angle - shot.angle, 2 * std::numbers::pi),
                                 shot.length + share * (next.length - shot.length),
                                 shot.t + share * (next.t - shot.t)});
            }
    std::vector<std::optional<Found>> found(shots.size());
    tbb::parallel_for(std::size_t{0}, shots.size(),
                      [&](std::size_t i) { found[i] = search.refine(shots[i], target, range, to.face); });
    std::vector<Found> all;
    for (std::optional<Found>& one : found)
        if (one) all.push_back(std::move(*one));
    GeodesicSearch result = search.result(std::move(all));
    if (result.curves.empty()) result.why = none_found(search) + " and meets the curve at a right angle";
    return result;
}

}  // namespace umbilic
