// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/differential/recognise.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/differential/curvature.h>
#include <umbilic/differential/elementary_fit.h>
#include <umbilic/differential/sweep_motion.h>

namespace umbilic {

namespace {

/// Candidates are found and fitted on this many points per direction, in the middles of equal parts of the domain.
constexpr int few = 6;
constexpr std::size_t least_points = 12;
/// The sweep of a surface is checked on this many points per direction.
constexpr int sweep_points = 20;
/// Most points per polynomial piece and direction in the check of an elementary kind.
constexpr int most_points_per_piece = 9;
/// Ulps of the largest coordinate: what rounding of control points and evaluation may make of an exact surface.
constexpr double rounding_ulps = 16.0;
/// A deviation of up to this many times the least one (or rounding) is of its order: the simpler kind wins.
constexpr double same_order = 10.0;
/// A start this many tolerances away is not refined.
constexpr double hopeless = 100.0;
/// Normals of a swept surface may be off by this many times the tolerance of positions, relative to the size: ripples
/// of an approximation by some pieces are that steep.
constexpr double steepest_ripple = 300.0;

/// The surface's points relative to its centre, so that rounding depends on its size.
class Recogniser {
public:
    Recogniser(const NurbsSurface& surface, const RecognitionOptions& options) : surface_(surface), options_(options) {
        const BoundingBox box = surface.pole_box();
        centre_ = box.center();
        size_ = box.diagonal();
        const double coordinate = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
        rounding_ = rounding_ulps * std::numeric_limits<double>::epsilon() * coordinate;
    }

    std::optional<RecognisedSurface> run() {
        if (!(size_ > 0.0) || rounding_ > options_.tolerance * size_) return std::nullopt;
        few_ = oriented_points(few);
        if (few_.size() < least_points) return std::nullopt;
        for (const OrientedPoint& point : few_) few_points_.push_back(point.point);

        try_plane();
        if (!exact()) try_sphere();
        if (!exact()) try_cylinder();
        if (!exact()) try_sweep();
        return best();
    }

private:
    double accepted() const { return options_.tolerance * size_; }
    bool exact() const { return !found_.empty() && found_.back().exact; }

    std::vector<OrientedPoint> oriented_points(int per_direction) const {
        const ParameterBox domain = surface_.domain();
        std::vector<OrientedPoint> result;
        for (int i = 0; i < per_direction; ++i)
            for (int j = 0; j < per_direction; ++j) {
                const Vector2 at(domain.u.low + (i + 0.5) / per_direction * domain.u.length(),
                                 domain.v.low + (j + 0.5) / per_direction * domain.v.length());
                const SurfaceDerivatives d = surface_.derivatives(at.x(), at.y(), 1);
                if (regular(d)) result.push_back({d.r() - centre_, unit_normal(d), at});
            }
        return result;
    }

    const std::vector<Vector3>& many_points() {
        if (!many_.empty()) return many_;
        const auto parameters = [](const KnotVector& knots) {
            const int count = std::min(2 * knots.degree() + 1, most_points_per_piece);
            const std::vector<double>& breaks = knots.breaks();
            std::vector<double> result;
            for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
                for (int i = 0; i < count; ++i)
                    result.push_back(breaks[k] + (breaks[k + 1] - breaks[k]) * i / static_cast<double>(count));
            result.push_back(breaks.back());
            return result;
        };
        const std::vector<double> us = parameters(surface_.u_knots()), vs = parameters(surface_.v_knots());
        many_.reserve(us.size() * vs.size());
        for (const double u : us)
            for (const double v : vs) many_.push_back(surface_.value(u, v) - centre_);
        return many_;
    }

    void add(SurfaceKind kind, const ElementarySurface& surface, double deviation, double condition) {
        if (deviation > accepted()) return;
        const double error = condition * std::max(deviation, rounding_);
        if (!(error <= RecognisedSurface::largest_parameter_error * std::max(size_, surface.radius))) return;
        found_.push_back({kind, surface, deviation, deviation <= rounding_, error});
    }

    void try_elementary(SurfaceKind kind, const std::optional<ElementarySurface>& start) {
        if (!start) return;
        double near = 0.0;
        for (const Vector3& point : few_points_)
            near = std::max(near, std::abs(elementary_distance(kind, *start, point).value));
        if (near > hopeless * accepted()) return;
        const ElementaryFit fit = fit_elementary(kind, *start, few_points_);
        if (fit.deviation > accepted() || !valid(kind, fit.surface)) return;
        double deviation = 0.0;
        for (const Vector3& point : many_points())
            deviation = std::max(deviation, std::abs(elementary_distance(kind, fit.surface, point).value));
        add(kind, fit.surface, deviation, fit.condition);
    }

    static bool valid(SurfaceKind kind, const ElementarySurface& surface) {
        switch (kind) {
            case SurfaceKind::cone:
                return surface.radius > 0.0 && surface.semi_angle != 0.0;
            case SurfaceKind::torus:
                return surface.minor_radius > 0.0 && surface.radius > surface.minor_radius;
            default:
                return surface.radius > 0.0;
        }
    }

    void try_plane() {
        const ElementaryFit fit = fit_elementary(SurfaceKind::plane, *plane_through(few_points_), few_points_);
        double deviation = 0.0;
        for (const Vector3& pole : surface_.poles())
            deviation = std::max(deviation, std::abs((pole - centre_ - fit.surface.location).dot(fit.surface.axis)));
        add(SurfaceKind::plane, fit.surface, deviation, fit.condition);
    }

    void try_sphere() { try_elementary(SurfaceKind::sphere, sphere_through(few_points_)); }

    void try_cylinder() {
        Matrix3 sum = Matrix3::Zero();
        for (const OrientedPoint& point : few_) sum += point.normal * point.normal.transpose();
        const Eigen::SelfAdjointEigenSolver<Matrix3> normals(sum / static_cast<double>(few_.size()));
        const double slope = std::sqrt(std::max(0.0, normals.eigenvalues()[0]));
        if (slope <= steepest_ripple * options_.tolerance)
            try_elementary(SurfaceKind::cylinder, cylinder_through(few_points_, normals.eigenvectors().col(0)));
    }

    void try_sweep() {
        const std::optional<SweepMotion> motion = sweep_motion(few_);
        if (!motion || motion->slope > steepest_ripple * options_.tolerance) return;
        ElementarySurface swept;
        swept.location = motion->location;
        swept.axis = motion->axis;
        if (motion->rotation) {
            try_elementary(SurfaceKind::cone, cone_through(few_points_, swept));
            if (!exact()) try_elementary(SurfaceKind::torus, torus_through(few_points_, swept));
        }
        if (exact() || !options_.swept) return;
        std::vector<OrientedPoint> points = oriented_points(sweep_points);
        const double epsilon = std::numeric_limits<double>::epsilon();
        const double error = size_ * std::max(motion->slope, epsilon) / std::max(motion->next_slope, epsilon);
        if (error > RecognisedSurface::largest_parameter_error * size_) return;
        for (OrientedPoint& point : points) point.point += centre_;
        SweepMotion placed = *motion;
        placed.location += centre_;
        const std::optional<double> deviation = sweep_deviation(surface_, placed, points);
        if (!deviation || *deviation > accepted()) return;
        found_.push_back({motion->rotation ? SurfaceKind::revolution : SurfaceKind::extrusion, swept, *deviation,
                          *deviation <= rounding_, error});
    }

    std::optional<RecognisedSurface> best() const {
        if (found_.empty()) return std::nullopt;
        double least = std::numeric_limits<double>::infinity();
        for (const RecognisedSurface& candidate : found_) least = std::min(least, candidate.deviation);
        const auto first = std::find_if(found_.begin(), found_.end(), [&](const RecognisedSurface& candidate) {
            return candidate.deviation <= same_order * std::max(least, rounding_);
        });
        RecognisedSurface result = *first;
        ElementarySurface& surface = result.surface;
        orient(result.kind, surface);
        surface.location += centre_;
        const Vector3 corner = surface_.poles().front() - surface.location;
        const Vector3 across = corner - corner.dot(surface.axis) * surface.axis;
        surface.x_axis = across.norm() > accepted() ? Vector3(across.normalized()) : surface.axis.unitOrthogonal();
        return result;
    }

    void orient(SurfaceKind kind, ElementarySurface& surface) const {
        if (kind == SurfaceKind::cone) {
            if (surface.semi_angle < 0.0) {
                surface.axis = -surface.axis;
                surface.semi_angle = -surface.semi_angle;
            }
            return;
        }
        Eigen::Index largest = 0;
        surface.axis.cwiseAbs().maxCoeff(&largest);
        if (surface.axis[largest] < 0.0) surface.axis = -surface.axis;
    }

    const NurbsSurface& surface_;
    const RecognitionOptions& options_;
    Vector3 centre_ = Vector3::Zero();
    double size_ = 0.0;
    double rounding_ = 0.0;
    std::vector<OrientedPoint> few_;
    std::vector<Vector3> few_points_, many_;
    std::vector<RecognisedSurface> found_;  ///< simplest first, relative to the centre
};

}  // namespace

std::optional<RecognisedSurface> recognise(const NurbsSurface& surface, const RecognitionOptions& options) {
    if (!(options.tolerance > 0.0 && std::isfinite(options.tolerance)))
        throw InvalidInput("recognition: the tolerance must be positive and finite");
    return Recogniser(surface, options).run();
}

std::vector<std::optional<RecognisedSurface>> recognise(const Model& model, const RecognitionOptions& options,
                                                        const Progress& progress) {
    std::vector<std::optional<RecognisedSurface>> result(model.faces.size());
    tbb::parallel_for(std::size_t(0), model.faces.size(), [&](std::size_t k) {
        progress.check();
        if (!elementary(model.faces[k].kind)) result[k] = recognise(model.faces[k].surface, options);
    });
    return result;
}

}  // namespace umbilic
