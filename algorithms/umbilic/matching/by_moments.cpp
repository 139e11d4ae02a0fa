// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_moments.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace umbilic {

namespace {

/// Greatest difference of the normalised principal moments (eigenvalues over their sum) of two wholes that may still be
/// copies. Generous: a wrong pose costs a few distance queries.
constexpr double comparable_moments = 0.05;

/// Factor by which the scale of two wholes may leave the user's range and still be tried: the refinement clamps it.
constexpr double scale_slack = 1.05;

/// Steps of a free angle: 15 degrees, below the 20 degrees from which refinement always converges.
constexpr int angle_steps = 24;

/// Rotations that cover the whole group with gaps of about 30 degrees.
constexpr int rotation_samples = 1000;

struct PrincipalAxes {
    Vector3 moments;  ///< increasing
    Matrix3 axes;     ///< columns, det = +1
};

PrincipalAxes principal_axes(const ShapeMoments& moments) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(moments.covariance);
    PrincipalAxes result{solver.eigenvalues(), solver.eigenvectors()};
    if (result.axes.determinant() < 0.0) result.axes.col(2) *= -1.0;
    return result;
}

/// Rotation number `index` of a low-discrepancy sequence over the rotation group (Alexa 2022, "Super-Fibonacci
/// spirals").
Matrix3 sampled_rotation(int index) {
    constexpr double phi = std::numbers::sqrt2, psi = 1.533751168755204288118041;
    const double s = index + 0.5, t = s / rotation_samples;
    const double r = std::sqrt(t), q = std::sqrt(1.0 - t);
    const double a = 2.0 * std::numbers::pi * s / phi, b = 2.0 * std::numbers::pi * s / psi;
    return Eigen::Quaterniond(q * std::cos(b), r * std::sin(a), r * std::cos(a), q * std::sin(b)).toRotationMatrix();
}

/// Orthogonal matrices that may stand between the two principal frames, proper ones first.
std::vector<Matrix3> frame_changes(MomentSymmetry symmetry, MirrorChoice mirror) {
    std::vector<Matrix3> proper;
    const auto turned = [](double x, double y, double z) -> Matrix3 { return Vector3(x, y, z).asDiagonal(); };
    const std::array<Matrix3, 4> half_turns = {turned(1, 1, 1), turned(1, -1, -1), turned(-1, 1, -1),
                                               turned(-1, -1, 1)};
    if (symmetry == MomentSymmetry::none) {
        proper.assign(half_turns.begin(), half_turns.end());
    } else if (symmetry == MomentSymmetry::all_equal) {
        for (int i = 0; i < rotation_samples; ++i) proper.push_back(sampled_rotation(i));
    } else {
        const int axis = symmetry == MomentSymmetry::two_smaller_equal ? 2 : 0;
        for (int i = 0; i < angle_steps; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / angle_steps;
            const Matrix3 turn = Eigen::AngleAxisd(angle, Vector3::Unit(axis)).toRotationMatrix();
            proper.push_back(turn);
            proper.push_back(turn * half_turns[2]);  // turns both the first and the third axis round
        }
    }
    std::vector<Matrix3> all = proper;
    if (mirror == MirrorChoice::automatic)
        for (const Matrix3& change : proper) all.push_back(change * turned(1, -1, 1));
    return all;
}

/// Near the limit only one of the two may count as symmetric, or each in another pair of moments: sample what either
/// leaves open.
MomentSymmetry either(MomentSymmetry a, MomentSymmetry b) {
    if (a == b || b == MomentSymmetry::none) return a;
    return a == MomentSymmetry::none ? b : MomentSymmetry::all_equal;
}

std::string described(MomentSymmetry symmetry) {
    switch (symmetry) {
        case MomentSymmetry::none:
            return "principal axes laid onto each other";
        case MomentSymmetry::two_smaller_equal:
        case MomentSymmetry::two_greater_equal:
            return "two principal moments are equal, so the angle about the third axis was sampled";
        case MomentSymmetry::all_equal:
            return "all principal moments are equal, so all rotations were sampled";
    }
    return {};
}

}  // namespace

ShapeMoments volume_moments(const Model& model) {
    ShapeMoments result;
    for (const Solid& solid : model.solids) {
        result.measure += solid.volume;
        result.centroid += solid.volume * solid.centroid;
    }
    if (!(result.measure > 0.0)) return {};
    result.centroid /= result.measure;
    for (const Solid& solid : model.solids) {
        const Vector3 shift = solid.centroid - result.centroid;
        const Matrix3 about_own = 0.5 * solid.inertia.trace() * Matrix3::Identity() - solid.inertia;
        result.covariance += about_own + solid.volume * shift * shift.transpose();
    }
    result.covariance /= result.measure;
    return result;
}

ShapeMoments area_moments(const Features& features) {
    ShapeMoments result{.dimension = 2};
    for (const AreaSample& sample : features.samples) {
        result.measure += sample.weight;
        result.centroid += sample.weight * sample.curvature.point;
    }
    if (!(result.measure > 0.0)) return result;
    result.centroid /= result.measure;
    for (const AreaSample& sample : features.samples) {
        const Vector3 shift = sample.curvature.point - result.centroid;
        result.covariance += sample.weight * shift * shift.transpose();
    }
    result.covariance /= result.measure;
    return result;
}

MomentSymmetry moment_symmetry(const ShapeMoments& moments, double difference) {
    const Vector3 value = principal_axes(moments).moments;
    const double equal =
        std::max(moments.dimension == 3 ? equal_volume_moments : equal_area_moments, gap_of_difference * difference) *
        value[2];
    const bool smaller = value[1] - value[0] <= equal, greater = value[2] - value[1] <= equal;
    if (smaller && greater) return MomentSymmetry::all_equal;
    return smaller   ? MomentSymmetry::two_smaller_equal
           : greater ? MomentSymmetry::two_greater_equal
                     : MomentSymmetry::none;
}

Proposals poses_by_moments(const PreparedModel& original, const PreparedModel& suspect, const ScaleChoice& scale,
                           MirrorChoice mirror) {
    ShapeMoments a = volume_moments(original.model), b = volume_moments(suspect.model);
    const bool solids = a.measure > 0.0 && b.measure > 0.0;
    if (!solids) {
        a = area_moments(original.features);
        b = area_moments(suspect.features);
    }
    const std::string what = solids ? "moments of volume" : "moments of area";
    if (!(a.measure > 0.0 && b.measure > 0.0)) return {.why = what + ": a model has no measure"};

    const double ratio = solids ? std::cbrt(a.measure / b.measure) : std::sqrt(a.measure / b.measure);
    if (!scale.allows(ratio, scale_slack))
        return {.why = what + ": the sizes of the wholes ask for a scale of " + std::to_string(ratio) +
                       ", which is not allowed"};
    const PrincipalAxes axes_a = principal_axes(a), axes_b = principal_axes(b);
    const Vector3 difference = axes_a.moments / axes_a.moments.sum() - axes_b.moments / axes_b.moments.sum();
    if (!(difference.cwiseAbs().maxCoeff() <= comparable_moments))
        return {.why = what + ": the principal moments of the wholes differ"};

    const double greatest =
        std::min(axes_a.moments[2] / axes_a.moments.sum(), axes_b.moments[2] / axes_b.moments.sum());
    const double apart = difference.cwiseAbs().maxCoeff() / greatest;
    const MomentSymmetry symmetry = either(moment_symmetry(a, apart), moment_symmetry(b, apart));
    Proposals result{.sampled = symmetry != MomentSymmetry::none, .why = what + ": " + described(symmetry)};
    for (const Matrix3& change : frame_changes(symmetry, mirror)) {
        const Matrix3 orthogonal = axes_a.axes * change * axes_b.axes.transpose();
        const double s = scale.clamp(ratio);
        result.poses.push_back({similarity_from_orthogonal(s, orthogonal, a.centroid - s * (orthogonal * b.centroid)),
                                MatchMethod::moments});
    }
    return result;
}

}  // namespace umbilic
