// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_umbilic_lines.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Geometry>

#include <umbilic/core/errors.h>
#include <umbilic/matching/horn.h>
#include <umbilic/matching/pose_distance.h>

namespace umbilic {

namespace {

/// Pairs of one reading among which triples are formed, nearest in omega first, and poses handed on.
constexpr std::size_t most_pairs = 60, most_proposals = 400;
/// Three pairs form a triple if their scales agree within this factor ...
constexpr double scale_agreement = 1.1;
/// ... and their distances within this part of the moved suspect's length (delta of (4.8)).
constexpr double distance_agreement = 0.05;
/// Factor by which a scale may leave the user's range and still be tried.
constexpr double scale_slack = 1.2;
/// Scales at which the KH method is run, and the factor within which two are one: KH finds its way within some 5 %.
constexpr std::size_t most_scales = 8;
constexpr double same_scale = 1.02;

/// Rotation about the cross product that carries one unit vector onto another; about any normal of it if they are
/// opposite.
Matrix3 aligning(const Vector3& from, const Vector3& to) {
    return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

/// Angle about `axis` from one tangent to another.
double angle_about(const Vector3& axis, const Vector3& from, const Vector3& to) {
    return std::atan2(axis.dot(from.cross(to)), from.dot(to));
}

/// Steps 106 and 112: poses of three pairs at the geometric mean of their scales.
void poses_of_triples(const std::vector<UmbilicMark>& original, const UmbilicReading& reading,
                      const std::vector<OmegaPair>& pairs, double length, std::vector<SimilarityTransform>& poses) {
    const auto n = std::min(pairs.size(), most_pairs);
    const auto fit_together = [&](const OmegaPair& a, const OmegaPair& b) {
        if (a.original == b.original || a.suspect == b.suspect) return false;
        const double ratio = a.scale / b.scale;
        if (ratio > scale_agreement || ratio * scale_agreement < 1.0) return false;
        const double scale = std::sqrt(a.scale * b.scale);
        const double apart = (original[a.original].point - original[b.original].point).norm();
        const double moved = scale * (reading.marks[a.suspect].point - reading.marks[b.suspect].point).norm();
        return std::abs(apart - moved) < distance_agreement * scale * length;
    };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
            if (!fit_together(pairs[i], pairs[j])) continue;
            for (std::size_t k = j + 1; k < n; ++k) {
                if (!fit_together(pairs[i], pairs[k]) || !fit_together(pairs[j], pairs[k])) continue;
                const double scale = std::cbrt(pairs[i].scale * pairs[j].scale * pairs[k].scale);
                std::vector<PointPair> points;
                for (const std::size_t which : {i, j, k})
                    points.push_back(
                        {original[pairs[which].original].point, scale * reading.marks[pairs[which].suspect].point});
                try {
                    SimilarityTransform pose =
                        fit_points(points, {.free_scale = false, .mirrored = reading.mirror}).original_suspect;
                    pose.scale = scale;
                    poses.push_back(pose);
                } catch (const InvalidInput&) {
                    // Three umbilics on a line give no pose by their places.
                }
            }
        }
}

/// Steps 108 and 110: poses of one pair.
void poses_of_pair(const UmbilicMark& original, const UmbilicMark& suspect, double scale, bool mirror,
                   std::vector<SimilarityTransform>& poses) {
    if (original.directions.empty()) return;
    const Matrix3 hand = mirror ? Matrix3(Vector3(-1, 1, 1).asDiagonal()) : Matrix3::Identity();
    const Matrix3 upright = aligning(hand * suspect.normal, original.normal) * hand;
    for (const Vector3& direction : suspect.directions) {
        const double angle = angle_about(original.normal, upright * direction, original.directions.front());
        for (const double half_turn : {0.0, std::numbers::pi}) {
            const Matrix3 orthogonal = Eigen::AngleAxisd(angle + half_turn, original.normal) * upright;
            poses.push_back(
                similarity_from_orthogonal(scale, orthogonal, original.point - scale * (orthogonal * suspect.point)));
        }
    }
}

/// What both methods begin with.
struct Correspondence {
    std::vector<UmbilicMark> original;
    std::vector<UmbilicReading> readings;
    std::vector<std::vector<OmegaPair>> pairs;  ///< of each reading, those with an allowed scale
    std::size_t count = 0;
    std::string why;
};

Correspondence correspond(const PreparedModel& original, const PreparedModel& suspect, const ScaleChoice& scale,
                          MirrorChoice mirror, double omega_tolerance) {
    Correspondence result{.original = umbilic_marks(original.model, original.features)};
    const std::vector<UmbilicMark> marks = umbilic_marks(suspect.model, suspect.features);
    result.readings = umbilic_readings(marks, original.model.oriented() && suspect.model.oriented(), mirror);
    for (const UmbilicReading& reading : result.readings) {
        std::vector<OmegaPair> pairs = pairs_by_omega(result.original, reading.marks, omega_tolerance);
        std::erase_if(pairs, [&](const OmegaPair& pair) { return !scale.allows(pair.scale, scale_slack); });
        for (OmegaPair& pair : pairs) pair.scale = scale.clamp(pair.scale);
        result.count += pairs.size();
        result.pairs.push_back(std::move(pairs));
    }
    result.why = std::to_string(result.original.size()) + " umbilics of the original and " +
                 std::to_string(marks.size()) + " of the suspect gave " + std::to_string(result.count) +
                 " pairs of one type, near omega and allowed scale";
    return result;
}

}  // namespace

std::vector<OmegaPair> pairs_by_omega(const std::vector<UmbilicMark>& original, const std::vector<UmbilicMark>& suspect,
                                      double tolerance) {
    std::vector<OmegaPair> pairs;
    for (int j = 0; j < static_cast<int>(suspect.size()); ++j)
        for (int i = 0; i < static_cast<int>(original.size()); ++i) {
            const UmbilicMark &a = original[i], &b = suspect[j];
            if (a.type == UmbilicType::non_generic || a.type != b.type || !a.omega || !b.omega) continue;
            if (a.flat || b.flat || !(a.kappa * b.kappa > 0.0)) continue;
            const double distance = omega_distance(*a.omega, *b.omega);
            if (distance < tolerance) pairs.push_back({i, j, distance, b.kappa / a.kappa});
        }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const OmegaPair& a, const OmegaPair& b) { return a.distance < b.distance; });
    return pairs;
}

Proposals poses_by_umbilic_lines(const PreparedModel& original, const PreparedModel& suspect, const ScaleChoice& scale,
                                 MirrorChoice mirror, double omega_tolerance, const Progress& progress) {
    const Correspondence found = correspond(original, suspect, scale, mirror, omega_tolerance);
    Proposals result{.why = "umbilics and their lines: " + found.why};
    const double length = shape_size(suspect.features).length;
    std::vector<SimilarityTransform> poses;
    for (std::size_t r = 0; r < found.readings.size(); ++r) {
        progress.check();
        poses_of_triples(found.original, found.readings[r], found.pairs[r], length, poses);
    }
    if (!poses.empty()) {
        result.why += ", " + std::to_string(poses.size()) + " times three of them agree";
    } else {
        std::vector<std::pair<OmegaPair, const UmbilicReading*>> pairs;
        for (std::size_t r = 0; r < found.readings.size(); ++r)
            for (const OmegaPair& pair : found.pairs[r]) pairs.emplace_back(pair, &found.readings[r]);
        std::stable_sort(pairs.begin(), pairs.end(),
                         [](const auto& a, const auto& b) { return a.first.distance < b.first.distance; });
        for (const auto& [pair, reading] : pairs)
            poses_of_pair(found.original[pair.original], reading->marks[pair.suspect], pair.scale, reading->mirror,
                          poses);
    }
    const PoseDistance distance(suspect.features);
    for (const SimilarityTransform& pose : poses) {
        if (result.poses.size() == most_proposals) break;
        progress.check();
        if (std::none_of(result.poses.begin(), result.poses.end(), [&](const PoseHypothesis& other) {
                return distance.relative(pose, other.original_suspect) < same_hypothesis;
            }))
            result.poses.push_back({pose, MatchMethod::umbilic_lines});
    }
    return result;
}

Proposals poses_by_umbilic_scale(const PreparedModel& original, const PreparedModel& suspect,
                                 const CurvaturePointMatching& options, double omega_tolerance,
                                 const Progress& progress) {
    const Correspondence found = correspond(original, suspect, options.scale, options.mirror, omega_tolerance);
    std::vector<OmegaPair> pairs;
    for (const std::vector<OmegaPair>& of_reading : found.pairs)
        pairs.insert(pairs.end(), of_reading.begin(), of_reading.end());
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const OmegaPair& a, const OmegaPair& b) { return a.distance < b.distance; });
    std::vector<double> scales;
    for (const OmegaPair& pair : pairs) {
        if (scales.size() == most_scales) break;
        if (std::none_of(scales.begin(), scales.end(), [&](double other) {
                return pair.scale < other * same_scale && other < pair.scale * same_scale;
            }))
            scales.push_back(pair.scale);
    }
    Proposals result{.why = "scale by umbilics: " + found.why};
    if (scales.empty()) return result;
    const Proposals by_curvature = poses_by_curvature_points_at(original, suspect, scales, options, progress);
    result.why += "; " + by_curvature.why;
    for (const PoseHypothesis& pose : by_curvature.poses)
        result.poses.push_back({pose.original_suspect, MatchMethod::umbilic_kh});
    return result;
}

}  // namespace umbilic
