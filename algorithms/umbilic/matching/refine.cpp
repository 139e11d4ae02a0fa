// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/refine.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <oneapi/tbb/parallel_for.h>

namespace umbilic {

namespace {

using Vector7 = Eigen::Matrix<double, 7, 1>;

/// Tukey's cut-off in standard deviations, and the standard deviation of a normal distribution in lower quartiles of
/// |r|. The quartile and not the median: up to three quarters of the points may be foreign.
constexpr double tukey = 4.7, quartile_to_deviation = 3.14;
/// A lower quartile above this part of the cut-off means residuals that fill it evenly: there is no noise of a fit to
/// go by (0.07 at the cut-off that suits noise, 0.25 for an even distribution), and the cut-off shrinks by force.
constexpr double filled = 0.12;
/// ... by this factor after every step shorter than itself, until it is this part of the length.
constexpr double close_cutoff = 1e-3, forced_shrink = 0.6;
/// Points beyond a border pull with at most this part of the cut-off, where Tukey's influence is greatest: however far
/// they hang over, they do not lose their pull.
constexpr double strongest_pull = 0.447;
/// The cut-off never falls below this part of the length, far above the rounding of coordinates.
constexpr double least_cutoff = 1e-9;
/// Longest step: radians, log(scale), and part of the length.
constexpr double longest_turn = 0.5, longest_scaling = 0.3, longest_shift = 0.5;
/// A step shorter than this part of the radius ends the refinement; so does one that no longer shrinks once it is below
/// `stagnation`.
constexpr double rounding_step = 1e-14, stagnation = 1e-10;
/// A step that raises the loss by more than this part is taken back and repeated with damping, in parts of the greatest
/// eigenvalue: where motions are hardly determined the surface bends more over the length of a step than it can know.
constexpr double greatest_rise = 1e-4, first_damping = 1e-4, more_damping = 10.0, less_damping = 0.3,
                 greatest_damping = 1.0, least_damping = 1e-8;

struct Foot {
    Vector3 moved, normal;
    double residual = 0.0;  ///< signed distance along the normal, mm of the original
    bool used = false;
    bool beyond = false;    ///< hangs over a border and is drawn back: the normal points away from it
    bool left_out = false;  ///< hangs over a border and is not drawn back
};

double size_of(std::span<const WeightedPoint> points) {
    Vector3 centre = Vector3::Zero();
    double weight = 0.0, square = 0.0;
    for (const WeightedPoint& p : points) {
        centre += p.weight * p.point;
        weight += p.weight;
    }
    centre /= weight;
    for (const WeightedPoint& p : points) square += p.weight * (p.point - centre).squaredNorm();
    return 2.0 * std::sqrt(square / weight);
}

std::vector<Foot> find_feet(const GroundSurface& original, std::span<const WeightedPoint> points,
                            const SimilarityTransform& pose, double cutoff, bool hold_borders) {
    std::vector<Foot> feet(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
        Foot& foot = feet[i];
        foot.moved = pose.apply(points[i].point);
        const auto closest = original.foot(foot.moved, cutoff);
        if (!closest || !closest->normal) return;
        const Vector3 offset = foot.moved - closest->point;
        foot.normal = *closest->normal;
        foot.residual = foot.normal.dot(offset);
        const double beside = (offset - foot.residual * foot.normal).norm();
        foot.used = !closest->at_border || beside <= std::abs(foot.residual);
        foot.left_out = !foot.used && !hold_borders;
        if (foot.used || foot.left_out) return;
        foot.residual = offset.norm();
        foot.normal = offset / foot.residual;
        foot.used = foot.beyond = true;
    });
    return feet;
}

double quartile_residual(const std::vector<Foot>& feet) {
    std::vector<double> residuals;
    for (const Foot& foot : feet)
        if (foot.used) residuals.push_back(std::abs(foot.residual));
    if (residuals.empty()) return 0.0;
    const auto quarter = residuals.begin() + residuals.size() / 4;
    std::nth_element(residuals.begin(), quarter, residuals.end());
    return *quarter;
}

/// Mean of Tukey's loss, in [0, 1] within borders; of points that are drawn back it goes on growing evenly from where
/// their pull is greatest. Points that hang over a border and are left out take no part.
double mean_loss(std::span<const WeightedPoint> points, const std::vector<Foot>& feet, double cutoff) {
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < feet.size(); ++i) {
        if (feet[i].left_out) continue;
        const double ratio = feet[i].used ? std::abs(feet[i].residual) / cutoff : 1.0;
        const double even = feet[i].beyond ? std::max(0.0, ratio - strongest_pull) : 0.0;
        const double inside = std::max(0.0, 1.0 - (ratio - even) * (ratio - even));
        const double slope = 6.0 * (ratio - even) * inside * inside;
        sum += points[i].weight * (1.0 - inside * inside * inside + slope * even);
        weight += points[i].weight;
    }
    return weight > 0.0 ? sum / weight : 1.0;
}

struct NormalEquations {
    Matrix7 matrix = Matrix7::Zero();      ///< mean, Tukey weights included
    Matrix7 unweighted = Matrix7::Zero();  ///< mean of row^T row with the residual's own term left out
    Vector7 gradient = Vector7::Zero();
    Vector3 centre = Vector3::Zero();
    double weight = 0.0;  ///< of the points that take part
    double square = 0.0;  ///< weighted sum of squared residuals
    double effective = 0.0;
};

NormalEquations normal_equations(std::span<const WeightedPoint> points, const std::vector<Foot>& feet, double cutoff,
                                 double radius) {
    NormalEquations equations;
    for (std::size_t i = 0; i < feet.size(); ++i)
        if (feet[i].used) {
            equations.centre += points[i].weight * feet[i].moved;
            equations.weight += points[i].weight;
        }
    if (!(equations.weight > 0.0)) return equations;
    equations.centre /= equations.weight;
    double weights = 0.0, weight_squares = 0.0;
    for (std::size_t i = 0; i < feet.size(); ++i) {
        const Foot& foot = feet[i];
        if (!foot.used) continue;
        const double ratio = foot.residual / cutoff;
        const double inside = std::max(0.0, 1.0 - ratio * ratio);
        const double weight = points[i].weight * inside * inside;
        const Vector3 arm = (foot.moved - equations.centre) / radius;
        Vector7 row;
        row << arm.cross(foot.normal), foot.normal, foot.normal.dot(arm);
        equations.unweighted += points[i].weight * row * row.transpose();
        row[6] -= foot.residual / radius;
        equations.matrix += weight * row * row.transpose();
        equations.gradient += weight * foot.residual * row;
        equations.square += points[i].weight * foot.residual * foot.residual;
        weights += weight;
        weight_squares += weight * weight;
    }
    equations.unweighted /= equations.weight;
    if (weights > 0.0) {
        equations.matrix /= weights;
        equations.gradient /= weights;
        equations.effective = weights * weights / weight_squares;
    }
    return equations;
}

/// Motions that the points with residuals below the cut-off determine.
int determined_motions(std::span<const WeightedPoint> points, std::vector<Foot> feet, double cutoff, double radius,
                       bool free_scale) {
    for (Foot& foot : feet) foot.used = foot.used && std::abs(foot.residual) <= cutoff;
    const NormalEquations equations = normal_equations(points, feet, cutoff, radius);
    const int n = free_scale ? 7 : 6;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> motions(equations.unweighted.topLeftCorner(n, n),
                                                                 Eigen::EigenvaluesOnly);
    const Eigen::VectorXd& values = motions.eigenvalues();
    return static_cast<int>((values.array() > undetermined_motion * values[n - 1]).count());
}

/// Least-squares step in mm within the motions that change distances; the others stay 0. `damping` in parts of the
/// greatest eigenvalue.
Vector7 solve(const NormalEquations& equations, bool free_scale, double damping) {
    const int n = free_scale ? 7 : 6;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> motions(equations.unweighted.topLeftCorner(n, n));
    int determined = 0;
    while (determined < n &&
           motions.eigenvalues()[n - 1 - determined] > undetermined_motion * motions.eigenvalues()[n - 1])
        ++determined;
    const Eigen::MatrixXd basis = motions.eigenvectors().rightCols(determined);
    const Eigen::MatrixXd matrix = basis.transpose() * equations.matrix.topLeftCorner(n, n) * basis;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
    const Eigen::VectorXd along = solver.eigenvectors().transpose() * (basis.transpose() * equations.gradient.head(n));
    Eigen::VectorXd step = Eigen::VectorXd::Zero(determined);
    const double greatest = solver.eigenvalues()[determined - 1];
    for (int k = 0; k < determined; ++k)
        if (solver.eigenvalues()[k] > undetermined_motion * greatest)
            step -= along[k] / (solver.eigenvalues()[k] + damping * greatest) * solver.eigenvectors().col(k);
    Vector7 result = Vector7::Zero();
    result.head(n) = basis * step;
    return result;
}

SimilarityTransform moved_by(const SimilarityTransform& pose, const Vector7& step, const Vector3& centre,
                             double radius) {
    const Vector3 turn = step.head<3>() / radius;
    const double angle = turn.norm();
    const Matrix3 rotation =
        angle > 0.0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Matrix3::Identity();
    const double factor = std::exp(step[6] / radius);
    SimilarityTransform result = pose;
    result.scale *= factor;
    result.rotation = Eigen::Quaterniond(Matrix3(rotation * pose.rotation)).normalized().toRotationMatrix();
    result.translation = centre + step.segment<3>(3) + factor * (rotation * (pose.translation - centre));
    return result;
}

struct Step {
    SimilarityTransform pose;
    double length = 0.0;  ///< relative to the radius
    bool at_end = false;  ///< of the allowed range of scales
};

/// One step of least squares from a pose, no longer than allowed.
Step stepped(const SimilarityTransform& pose, const NormalEquations& equations, double radius, bool free_scale,
             double damping, const ScaleChoice& scale) {
    Vector7 step = solve(equations, free_scale, damping);
    const double excess = std::max({step.head<3>().norm() / (longest_turn * radius),
                                    step.segment<3>(3).norm() / (longest_shift * 2.0 * radius),
                                    std::abs(step[6]) / (longest_scaling * radius), 1.0});
    step /= excess;
    Step result{.pose = moved_by(pose, step, equations.centre, radius), .length = step.norm() / radius};
    if (const double allowed = scale.clamp(result.pose.scale); allowed != result.pose.scale) {
        // At the end of the allowed range the scale stays there and the other motions go on.
        result.pose.translation +=
            (result.pose.scale - allowed) *
            (result.pose.orthogonal() * result.pose.inverse().apply(equations.centre + step.segment<3>(3)));
        result.pose.scale = allowed;
        result.at_end = true;
    }
    return result;
}

double scale_deviation(const NormalEquations& equations) {
    const Eigen::SelfAdjointEigenSolver<Matrix7> solver(equations.unweighted);
    const Vector7& value = solver.eigenvalues();
    double inverse = 0.0;
    for (int k = 0; k < 7; ++k) {
        const double part = solver.eigenvectors()(6, k) * solver.eigenvectors()(6, k);
        if (value[k] <= undetermined_motion * value[6]) {
            if (part > undetermined_motion) return std::numeric_limits<double>::infinity();
            continue;
        }
        inverse += part / value[k];
    }
    return std::sqrt(equations.square / equations.weight * inverse / std::max(equations.effective, 1.0));
}

}  // namespace

Refinement refine(const GroundSurface& original, std::span<const WeightedPoint> points,
                  const SimilarityTransform& start, const RefineOptions& options, const Progress& progress) {
    Refinement result{.original_suspect = start};
    if (points.empty()) return result;
    const double size = size_of(points);
    double total = 0.0;
    for (const WeightedPoint& p : points) total += p.weight;

    SimilarityTransform& pose = result.original_suspect;
    pose.scale = options.scale.clamp(pose.scale);
    bool free_scale = options.scale.kind != ScaleChoice::Kind::fixed;
    double relative_cutoff = options.start_cutoff;
    double last_step = std::numeric_limits<double>::infinity();
    // Where the last step started from, to be taken again with more damping.
    struct {
        SimilarityTransform pose;
        NormalEquations equations;
        double radius = 0.0;
        bool free_scale = false;
        double loss = std::numeric_limits<double>::infinity();
    } last;
    double damping = 0.0;
    for (result.steps = 0; result.steps < options.maximum_steps; ++result.steps) {
        progress.check();
        const double length = size * pose.scale;
        result.radius = 0.5 * length;
        result.cutoff = relative_cutoff * length;
        const double reach = options.hold_borders ? options.start_cutoff * length : result.cutoff;
        std::vector<Foot> feet = find_feet(original, points, pose, reach, options.hold_borders);
        if (last_step > stagnation && damping < greatest_damping &&
            mean_loss(points, feet, result.cutoff) > (1.0 + greatest_rise) * last.loss) {
            damping = std::max(first_damping, more_damping * damping);
            const Step step = stepped(last.pose, last.equations, last.radius, last.free_scale, damping, options.scale);
            pose = step.pose;
            free_scale = last.free_scale && !step.at_end;
            last_step = step.length;
            continue;
        }
        damping = damping > least_damping ? less_damping * damping : 0.0;
        const double quartile = quartile_residual(feet) / length;
        const bool force =
            quartile > filled * relative_cutoff && relative_cutoff > close_cutoff && last_step < relative_cutoff;
        const double wanted =
            force ? std::max(forced_shrink * relative_cutoff, close_cutoff) : tukey * quartile_to_deviation * quartile;
        double next_cutoff = std::max(std::min(wanted, relative_cutoff), least_cutoff);
        const double slow_cutoff = forced_shrink * relative_cutoff;
        const auto determined = [&](double relative) {
            return determined_motions(points, feet, relative * length, result.radius, free_scale);
        };
        if (options.hold_determined && next_cutoff < slow_cutoff && determined(next_cutoff) < determined(slow_cutoff))
            next_cutoff = slow_cutoff;

        const bool settled = !force && next_cutoff >= forced_shrink * relative_cutoff;
        // The new cut-off holds for this step already: a start that is right must not be pulled away by foreign
        // material once.
        relative_cutoff = next_cutoff;
        result.cutoff = relative_cutoff * length;
        const double loss = mean_loss(points, feet, result.cutoff);
        for (Foot& foot : feet) {
            if (foot.beyond) foot.residual = std::min(foot.residual, strongest_pull * result.cutoff);
            foot.used = foot.used && std::abs(foot.residual) <= result.cutoff;
        }
        const NormalEquations equations = normal_equations(points, feet, result.cutoff, result.radius);
        last = {pose, equations, result.radius, free_scale, loss};
        result.share = equations.weight / total;
        if (!(equations.weight > 0.0)) return result;
        result.rms = std::sqrt(equations.square / equations.weight);
        result.normal_matrix = equations.unweighted;
        result.centre = equations.centre;
        result.scale_deviation = scale_deviation(equations) / result.radius;

        const Step step = stepped(pose, equations, result.radius, free_scale, damping, options.scale);
        pose = step.pose;
        free_scale = free_scale && !step.at_end;
        const double sufficient =
            std::max(options.sufficient_step, options.sufficient_part_of_rms * result.rms / result.radius);
        if (settled && (step.length < std::max(rounding_step, sufficient) ||
                        (step.length < stagnation && step.length >= last_step))) {
            result.converged = true;
            break;
        }
        last_step = step.length;
    }
    return result;
}

}  // namespace umbilic
