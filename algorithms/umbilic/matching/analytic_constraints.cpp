// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/analytic_constraints.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace umbilic {

namespace {

using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Vector7 = Eigen::Matrix<double, 7, 1>;

constexpr std::size_t largest_basis = 6;
/// A motion is fixed if the equations change by this per unit of motion (angles, lengths over the model's), squared. A
/// hole of a thousandth of the model's length still fixes its scale.
constexpr double fixed_motion = 1e-7;
/// Stands for what is not known yet in the gain of a feature: far below fixed_motion.
constexpr double unknown_motion = 1e-9;
/// A feature used in an earlier basis counts as if this many e-folds of partners stood against it.
constexpr double reuse_penalty = 4.0;
/// Directions are parallel below this sine: far above the noise of recognised faces, far below angles of design.
constexpr double parallel = 1e-2;
/// Two axes closer than this part of the length give no direction between them.
constexpr double least_distance = 1e-2;
/// Weight of the start against the equations; only what they leave open feels it.
constexpr double weight_of_start = 1e-12;

std::array<Vector3, 2> across(const Vector3& direction) {
    const Vector3 first = direction.unitOrthogonal();
    return {first, direction.cross(first)};
}

Vector7 motion_row(const Vector3& arm, const Vector3& normal) {
    Vector7 row;
    row << arm.cross(normal), normal, normal.dot(arm);
    return row;
}

double log_volume(const Matrix7& equations) {
    const Eigen::LDLT<Matrix7> factors(equations + unknown_motion * Matrix7::Identity());
    return factors.vectorD().array().max(unknown_motion).log().sum();
}

Matrix3 frame(const Vector3& first, const Vector3& second, double hand) {
    Matrix3 result;
    result.col(0) = first.normalized();
    result.col(1) = (second - second.dot(result.col(0)) * result.col(0)).normalized();
    result.col(2) = hand * result.col(0).cross(result.col(1));
    return result;
}

bool located(const AnalyticFeature& feature) {
    return feature.has_axis() || feature.has_centre();
}

}  // namespace

Matrix7 feature_constraints(const AnalyticFeature& feature, const Vector3& centre, double length) {
    Matrix7 sum = Matrix7::Zero();
    const auto add = [&](const Vector7& row) { sum += row * row.transpose(); };
    const Vector3 arm = (feature.point - centre) / length;
    if (feature.has_direction())
        for (const Vector3& normal : across(feature.direction)) {
            Vector7 row = Vector7::Zero();
            row.head<3>() = feature.direction.cross(normal);
            add(row);
        }
    if (feature.kind == SurfaceKind::plane) add(motion_row(arm, feature.direction));
    if (feature.has_centre())
        for (int axis = 0; axis < 3; ++axis) add(motion_row(arm, Vector3::Unit(axis)));
    else if (feature.has_axis())
        for (const Vector3& normal : across(feature.direction)) add(motion_row(arm, normal));
    if (feature.has_radius()) {
        Vector7 row = Vector7::Zero();
        row[6] = feature.radius / length;
        add(row);
    }
    return sum;
}

std::vector<AnalyticBasis> choose_bases(const std::vector<AnalyticFeature>& features, const std::vector<int>& partners,
                                        bool known_scale, int count) {
    Vector3 centre = Vector3::Zero();
    double area = 0.0, square = 0.0;
    for (const AnalyticFeature& feature : features) {
        centre += feature.area * feature.middle;
        area += feature.area;
    }
    if (!(area > 0.0)) return {};
    centre /= area;
    for (const AnalyticFeature& feature : features)
        square += feature.area * (feature.extent * feature.extent + (feature.middle - centre).squaredNorm());
    const double length = 2.0 * std::sqrt(square / area);
    if (!(length > 0.0)) return {};

    std::vector<Matrix7> equations;
    for (const AnalyticFeature& feature : features) equations.push_back(feature_constraints(feature, centre, length));
    Matrix7 nothing = Matrix7::Zero();
    if (known_scale) nothing(6, 6) = 1.0;

    std::vector<int> uses(features.size(), 0);
    std::vector<AnalyticBasis> bases;
    while (static_cast<int>(bases.size()) < count) {
        AnalyticBasis basis;
        Matrix7 sum = nothing;
        while (basis.features.size() < largest_basis && !basis.determined) {
            int best = -1;
            double best_value = 0.0;
            const double volume = log_volume(sum);
            for (int i = 0; i < static_cast<int>(features.size()); ++i) {
                if (partners[i] == 0 || std::count(basis.features.begin(), basis.features.end(), i) > 0) continue;
                const double gain = log_volume(sum + equations[i]) - volume;
                // A feature that fixes nothing new is no part of a basis.
                if (gain < std::log(fixed_motion / unknown_motion)) continue;
                const double value = gain - std::log(partners[i]) - reuse_penalty * uses[i];
                if (best < 0 || value > best_value) best = i, best_value = value;
            }
            if (best < 0) break;
            basis.features.push_back(best);
            ++uses[best];
            sum += equations[best];
            const Eigen::SelfAdjointEigenSolver<Matrix7> solver(sum, Eigen::EigenvaluesOnly);
            basis.determined = solver.eigenvalues()[0] > fixed_motion;
        }
        const auto same = [&](const AnalyticBasis& other) { return other.features == basis.features; };
        if (basis.features.empty() || std::any_of(bases.begin(), bases.end(), same)) break;
        bases.push_back(std::move(basis));
    }
    return bases;
}

std::vector<Matrix3> orthogonal_maps(const std::vector<FeaturePair>& pairs, double length, bool mirrored_too) {
    const FeaturePair* first = nullptr;
    std::array<Vector3, 2> of_suspect, of_original;
    bool complete = false;
    for (const FeaturePair& pair : pairs) {
        if (!pair.suspect->has_direction()) continue;
        if (!first) {
            first = &pair;
            of_suspect[0] = pair.suspect->direction;
            of_original[0] = pair.sense * pair.original->direction;
        } else if (pair.suspect->direction.cross(of_suspect[0]).norm() > parallel) {
            of_suspect[1] = pair.suspect->direction;
            of_original[1] = pair.sense * pair.original->direction;
            complete = true;
            break;
        }
    }
    int known = first ? 1 : 0;
    for (std::size_t i = 0; i < pairs.size() && !complete; ++i)
        for (std::size_t j = i + 1; j < pairs.size() && !complete; ++j) {
            if (!located(*pairs[i].suspect) || !located(*pairs[j].suspect)) continue;
            Vector3 a = pairs[j].suspect->point - pairs[i].suspect->point;
            Vector3 b = pairs[j].original->point - pairs[i].original->point;
            if (known > 0) {
                a -= a.dot(of_suspect[0]) * of_suspect[0];
                b -= b.dot(of_original[0]) * of_original[0];
            }
            if (a.norm() < least_distance * length || !(b.norm() > 0.0)) continue;
            of_suspect[known] = a.normalized();
            of_original[known] = b.normalized();
            complete = ++known == 2;
        }
    if (!complete || of_original[0].cross(of_original[1]).norm() < parallel) return {};
    const Matrix3 suspect = frame(of_suspect[0], of_suspect[1], 1.0).transpose();
    std::vector<Matrix3> maps = {frame(of_original[0], of_original[1], 1.0) * suspect};
    if (mirrored_too) maps.push_back(frame(of_original[0], of_original[1], -1.0) * suspect);
    return maps;
}

FeaturePose place(const std::vector<FeaturePair>& pairs, const Matrix3& orthogonal, const PlacingStart& start,
                  double length, const ScaleChoice& scale) {
    // Unknowns: scale times length, and the image of the start's point, all in mm of the original and as differences
    // from the start.
    const Vector3 &origin = start.point, &image = start.image;
    struct Row {
        Vector4 left;
        double right;
        double slack;
    };
    std::array<Row, 4 * largest_basis + 1> rows;
    std::size_t count = 0;
    const auto add = [&](const Vector3& arm, const Vector3& normal, const Vector3& target, double slack) {
        Vector4 left;
        left << normal.dot(arm) / length, normal;
        rows[count++] = {left, normal.dot(target - image - start.scale * arm), slack};
    };
    for (const FeaturePair& pair : pairs) {
        const AnalyticFeature &a = *pair.original, &b = *pair.suspect;
        const double slack = a.error + start.scale * b.error;
        const Vector3 arm = orthogonal * (b.point - origin);
        if (b.has_centre())
            for (int axis = 0; axis < 3; ++axis) add(arm, Vector3::Unit(axis), a.point, slack);
        else if (b.has_axis())
            for (const Vector3& normal : across(a.direction)) add(arm, normal, a.point, slack);
        else if (b.kind == SurfaceKind::plane)
            add(arm, a.direction, a.point, slack);
        if (b.has_radius())
            rows[count++] = {Vector4(b.radius / length, 0, 0, 0), a.radius - start.scale * b.radius, slack};
    }
    if (scale.kind == ScaleChoice::Kind::fixed) rows[count++] = {Vector4(1, 0, 0, 0), (1.0 - start.scale) * length, 0};

    Eigen::Matrix4d matrix = weight_of_start * Eigen::Matrix4d::Identity();
    Vector4 right = Vector4::Zero();
    for (std::size_t i = 0; i < count; ++i) {
        matrix += rows[i].left * rows[i].left.transpose();
        right += rows[i].right * rows[i].left;
    }
    const Vector4 change = matrix.ldlt().solve(right);
    FeaturePose pose;
    for (std::size_t i = 0; i < count; ++i)
        pose.residual = std::max(pose.residual, std::abs(rows[i].left.dot(change) - rows[i].right) - rows[i].slack);
    const double found = start.scale + change[0] / length;
    pose.original_suspect =
        similarity_from_orthogonal(found, orthogonal, image + change.tail<3>() - found * (orthogonal * origin));
    return pose;
}

}  // namespace umbilic
