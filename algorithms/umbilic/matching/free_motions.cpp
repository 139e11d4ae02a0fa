// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/free_motions.h>

#include <array>
#include <cmath>
#include <cstdio>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace umbilic {

namespace {

using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;
/// Columns are motions: rotation, translation, log(scale), lengths over the radius.
using Motions = Eigen::Matrix<double, 7, Eigen::Dynamic>;

/// Parts of a motion smaller than this, relative to the whole, are zero: an axis a hundred radii away turns like a line
/// slides.
constexpr double vanishing = 0.01;

struct Split {
    Motions without;  ///< orthonormal motions whose given rows vanish
    Motions with;     ///< orthonormal complement
};

/// Splits a space of motions by whether the rows [first, first + count) vanish.
Split split(const Motions& motions, int first, int count) {
    if (motions.cols() == 0) return {motions, motions};
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(motions.middleRows(first, count),
                                                Eigen::ComputeThinU | Eigen::ComputeFullV);
    Eigen::Index rank = 0;
    while (rank < svd.singularValues().size() && svd.singularValues()[rank] > vanishing) ++rank;
    const Motions turned = motions * svd.matrixV();
    return {turned.rightCols(motions.cols() - rank), turned.leftCols(rank)};
}

Vector3 signed_direction(const Vector3& direction) {
    const Vector3 unit = direction.normalized();
    Eigen::Index largest = 0;
    unit.cwiseAbs().maxCoeff(&largest);
    return unit[largest] < 0.0 ? Vector3(-unit) : unit;
}

/// Names a space of motions in coordinates relative to the centre, in radii.
class Naming {
public:
    explicit Naming(const Motions& motions) {
        const Split by_scale = split(motions, 6, 1);
        const Split by_turn = split(by_scale.without, 0, 3);
        slides_ = by_turn.without.middleRows(3, 3);
        turns_ = by_turn.with;
        name_turns();
        name_slides();
        for (Eigen::Index k = 0; k < by_scale.with.cols(); ++k) name_scaling(by_scale.with.col(k));
    }

    std::vector<FreeMotion> motions;

private:
    Vector3 without_slides(const Vector3& translation) const {
        return translation - slides_ * (slides_.transpose() * translation);
    }

    void name_turns() {
        if (turns_.cols() == 3) {
            Eigen::Matrix<double, 9, 3> matrix;
            Eigen::Matrix<double, 9, 1> right;
            for (int k = 0; k < 3; ++k) {
                // turn x point + translation = 0
                const Vector3 turn = turns_.col(k).head<3>();
                matrix.middleRows<3>(3 * k) << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(), 0;
                right.segment<3>(3 * k) = -turns_.col(k).segment<3>(3);
            }
            motions.push_back({FreeMotionKind::turn_about_point, matrix.colPivHouseholderQr().solve(right)});
            return;
        }
        for (Eigen::Index k = 0; k < turns_.cols(); ++k) {
            const double angle = turns_.col(k).head<3>().norm();
            const Vector3 axis = turns_.col(k).head<3>() / angle;
            const Vector3 translation = without_slides(turns_.col(k).segment<3>(3) / angle);
            const double pitch = translation.dot(axis);
            const bool screw = std::abs(pitch) > vanishing;
            motions.push_back({screw ? FreeMotionKind::screw : FreeMotionKind::turn, axis.cross(translation),
                               signed_direction(axis), screw ? pitch : 0.0});
        }
    }

    void name_slides() {
        if (slides_.cols() == 2) {
            motions.push_back({FreeMotionKind::slide_in_plane, Vector3::Zero(),
                               signed_direction(Vector3(slides_.col(0)).cross(Vector3(slides_.col(1))))});
            return;
        }
        for (Eigen::Index k = 0; k < slides_.cols(); ++k)
            motions.push_back({FreeMotionKind::slide, Vector3::Zero(), signed_direction(slides_.col(k))});
    }

    void name_scaling(const Vector7& motion) {
        Vector3 turn = motion.head<3>() / motion[6], translation = motion.segment<3>(3) / motion[6];
        if (turns_.cols() > 0) {
            // Of the scalings that differ by free turns the one that turns least.
            const Eigen::VectorXd part = turns_.topRows(3).colPivHouseholderQr().solve(turn);
            turn -= turns_.topRows(3) * part;
            translation -= turns_.middleRows(3, 3) * part;
        }
        translation = without_slides(translation);
        if (turn.norm() <= vanishing) {
            motions.push_back({FreeMotionKind::size, -translation});
            return;
        }
        Matrix3 matrix;
        matrix << 1, -turn.z(), turn.y(), turn.z(), 1, -turn.x(), -turn.y(), turn.x(), 1;
        const Vector3 axis = signed_direction(turn);
        motions.push_back(
            {FreeMotionKind::spiral, matrix.partialPivLu().solve(Vector3(-translation)), axis, turn.dot(axis)});
    }

    Eigen::Matrix<double, 3, Eigen::Dynamic> slides_;
    Motions turns_;
};

std::string printed(const Vector3& v) {
    std::array<char, 128> text;
    const auto tidy = [](double x) { return std::abs(x) < 5e-7 ? 0.0 : x; };
    std::snprintf(text.data(), text.size(), "(%.6g, %.6g, %.6g)", tidy(v.x()), tidy(v.y()), tidy(v.z()));
    return text.data();
}

}  // namespace

FreeMotion FreeMotion::seen_through(const SimilarityTransform& transform) const {
    FreeMotion result = *this;
    result.point = transform.apply(point);
    if (!direction.isZero()) result.direction = signed_direction(transform.apply_direction(direction));
    if (kind == FreeMotionKind::screw) result.pitch *= transform.scale;
    if (transform.mirrored) result.pitch = -result.pitch;
    return result;
}

std::optional<double> FreeMotion::amount_of(const SimilarityTransform& motion) const {
    switch (kind) {
        case FreeMotionKind::turn:
        case FreeMotionKind::screw: {
            const Eigen::AngleAxisd turn(motion.rotation);
            return turn.angle() * turn.axis().dot(direction);
        }
        case FreeMotionKind::slide:
            return (motion.apply(point) - point).dot(direction);
        case FreeMotionKind::size:
        case FreeMotionKind::spiral:
            return std::log(motion.scale);
        case FreeMotionKind::slide_in_plane:
        case FreeMotionKind::turn_about_point:
            return {};
    }
    return {};
}

SimilarityTransform FreeMotion::by(double amount) const {
    SimilarityTransform result;
    Vector3 axis = direction;
    double angle = 0.0;
    switch (kind) {
        case FreeMotionKind::turn:
        case FreeMotionKind::screw:
            angle = amount;
            result.translation = amount * pitch * direction;
            break;
        case FreeMotionKind::turn_about_point:
            angle = amount;
            axis = Vector3::UnitX();
            break;
        case FreeMotionKind::slide:
            result.translation = amount * direction;
            break;
        case FreeMotionKind::slide_in_plane:
            result.translation = amount * direction.unitOrthogonal();
            break;
        case FreeMotionKind::spiral:
            angle = amount * pitch;
            [[fallthrough]];
        case FreeMotionKind::size:
            result.scale = std::exp(amount);
            break;
    }
    if (angle != 0.0) result.rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    result.translation += point - result.scale * (result.rotation * point);
    return result;
}

std::vector<FreeMotion> free_motions(const Matrix7& normal_matrix, const Vector3& centre, double radius,
                                     double sensitivity, bool free_scale) {
    const int n = free_scale ? 7 : 6;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(normal_matrix.topLeftCorner(n, n));
    int free = 0;
    while (free < n && solver.eigenvalues()[free] < sensitivity * sensitivity) ++free;
    Motions space = Motions::Zero(7, free);
    space.topRows(n) = solver.eigenvectors().leftCols(free);
    std::vector<FreeMotion> result = Naming(space).motions;
    for (FreeMotion& motion : result) {
        motion.point = centre + radius * motion.point;
        if (motion.kind == FreeMotionKind::screw) motion.pitch *= radius;
    }
    return result;
}

const char* name(FreeMotionKind kind) {
    switch (kind) {
        case FreeMotionKind::turn:
            return "turn";
        case FreeMotionKind::slide:
            return "slide";
        case FreeMotionKind::slide_in_plane:
            return "slide_in_plane";
        case FreeMotionKind::turn_about_point:
            return "turn_about_point";
        case FreeMotionKind::screw:
            return "screw";
        case FreeMotionKind::size:
            return "size";
        case FreeMotionKind::spiral:
            return "spiral";
    }
    return "turn";
}

std::string in_words(const FreeMotion& motion) {
    const std::string axis = "the axis through " + printed(motion.point) + " along " + printed(motion.direction);
    switch (motion.kind) {
        case FreeMotionKind::turn:
            return "turns about " + axis;
        case FreeMotionKind::slide:
            return "slides along the direction " + printed(motion.direction);
        case FreeMotionKind::slide_in_plane:
            return "slides in the plane normal to " + printed(motion.direction);
        case FreeMotionKind::turn_about_point:
            return "turns in every way about the point " + printed(motion.point);
        case FreeMotionKind::screw:
            return "screws along " + axis;
        case FreeMotionKind::size:
            return "takes any size about the point " + printed(motion.point);
        case FreeMotionKind::spiral:
            return "takes any size while it turns about " + axis;
    }
    return {};
}

std::string in_words(const std::vector<FreeMotion>& motions) {
    std::string text;
    for (std::size_t i = 0; i < motions.size(); ++i)
        text += (i == 0 ? "" : i + 1 == motions.size() ? " and " : ", ") + in_words(motions[i]);
    return text;
}

}  // namespace umbilic
