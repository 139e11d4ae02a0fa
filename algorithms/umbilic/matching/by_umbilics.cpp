// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_umbilics.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>
#include <oneapi/tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/matching/horn.h>
#include <umbilic/matching/pose_distance.h>

namespace umbilic {

namespace {

/// Greatest relative difference of two cubics that are laid onto each other. Third derivatives jump at simple knots of
/// cubic splines, so re-approximated copies differ; a wrong pair costs only a few distance queries.
constexpr double cubic_misfit = 0.4;

/// A voter's umbilic must come to lie this near to a partner, relative to the moved suspect's length; the rotation from
/// one umbilic of a re-approximated copy is good to a few degrees.
constexpr double vote_distance = 0.05;
/// ... and its normal within 26 degrees.
constexpr double vote_cosine = 0.9;

/// Factor by which the scale from one umbilic may leave the user's range and still be tried.
constexpr double scale_slack = 1.2;

/// Corresponding pairs times hypotheses that voting may look at; hypotheses of one reading that are improved over their
/// voters, those with most votes; and hypotheses handed on.
constexpr double vote_budget = 5e7;
constexpr std::size_t most_improved = 1000, most_proposals = 400;

/// An umbilic about to vanish still counts with this part of the steadiest one's.
constexpr double least_steadiness = 1e-2;

struct Pair {
    int original = 0;
    int suspect = 0;
};

struct Hypothesis {
    SimilarityTransform pose;
    int votes = 0;
    double spread = 0.0;  ///< mean distance of the voters from their partners, in units of the vote's limit
};

/// One choice of hand and orientation for the whole suspect.
struct Reading {
    const std::vector<UmbilicMark>& suspect;
    std::vector<Pair> pairs;  ///< ordered by suspect
    std::vector<Hypothesis> hypotheses;
};

std::vector<Pair> corresponding(const std::vector<UmbilicMark>& original, const std::vector<UmbilicMark>& suspect,
                                double tolerance) {
    std::vector<Pair> pairs;
    for (int j = 0; j < static_cast<int>(suspect.size()); ++j)
        for (int i = 0; i < static_cast<int>(original.size()); ++i)
            if (may_correspond(original[i], suspect[j], tolerance)) pairs.push_back({i, j});
    return pairs;
}

/// Partner of each suspect umbilic under a pose: the nearest corresponding umbilic within `limit`.
std::vector<std::pair<Pair, double>> partners(const std::vector<UmbilicMark>& original, const Reading& reading,
                                              const SimilarityTransform& pose, double limit) {
    const Matrix3 orthogonal = pose.orthogonal();
    std::vector<std::pair<Pair, double>> result;
    for (auto pair = reading.pairs.begin(); pair != reading.pairs.end();) {
        const int suspect = pair->suspect;
        const Vector3 point = pose.scale * (orthogonal * reading.suspect[suspect].point) + pose.translation;
        const Vector3 normal = orthogonal * reading.suspect[suspect].normal;
        double nearest = limit * limit;
        const Pair* partner = nullptr;
        for (; pair != reading.pairs.end() && pair->suspect == suspect; ++pair) {
            const UmbilicMark& mark = original[pair->original];
            const double square = (point - mark.point).squaredNorm();
            if (square > nearest || (partner && square == nearest) || normal.dot(mark.normal) < vote_cosine) continue;
            nearest = square;
            partner = &*pair;
        }
        if (partner) result.emplace_back(*partner, std::sqrt(nearest));
    }
    return result;
}

void vote(const std::vector<UmbilicMark>& original, const Reading& reading, double length, Hypothesis& hypothesis) {
    const double limit = vote_distance * length * hypothesis.pose.scale;
    const auto found = partners(original, reading, hypothesis.pose, limit);
    hypothesis.votes = static_cast<int>(found.size());
    hypothesis.spread = 0.0;
    for (const auto& [pair, distance] : found) hypothesis.spread += distance / (limit * found.size());
}

/// Least squares over all voters.
void improve(const std::vector<UmbilicMark>& original, const Reading& reading, double length, const ScaleChoice& scale,
             Hypothesis& hypothesis) {
    if (hypothesis.votes < 2) return;
    std::vector<std::pair<UmbilicMark, UmbilicMark>> voters;
    for (const auto& [pair, distance] :
         partners(original, reading, hypothesis.pose, vote_distance * length * hypothesis.pose.scale))
        voters.emplace_back(original[pair.original], reading.suspect[pair.suspect]);
    // Umbilics one above the other along their normals lie on a line: then the pose from the single pair stands.
    const auto pose = pose_from_pairs(voters, hypothesis.pose, length, scale.kind != ScaleChoice::Kind::fixed);
    if (!pose) return;
    Hypothesis better{*pose};
    vote(original, reading, length, better);
    if (better.votes > hypothesis.votes || (better.votes == hypothesis.votes && better.spread < hypothesis.spread))
        hypothesis = better;
}

bool better(const Hypothesis& a, const Hypothesis& b) {
    return a.votes != b.votes ? a.votes > b.votes : a.spread < b.spread;
}

}  // namespace

bool may_correspond(const UmbilicMark& a, const UmbilicMark& b, double tolerance) {
    return std::abs(a.delta - b.delta) <= tolerance + a.delta_error + b.delta_error &&
           std::abs(a.zeta - b.zeta) <= tolerance + a.zeta_error + b.zeta_error &&
           std::abs(a.bend() - b.bend()) <= tolerance + a.bend_error + b.bend_error;
}

std::vector<SimilarityTransform> poses_from_pair(const UmbilicMark& original, const UmbilicMark& suspect,
                                                 double misfit) {
    const double norm_a = original.cubic_norm(), norm_b = suspect.cubic_norm();
    const double scale = std::sqrt(norm_b / norm_a);
    // Turning the original's frame by phi makes alpha e^{3 i phi} alpha and beta e^{-i phi} beta. The squared
    // difference of the cubics, both of norm 1, is 2 - 2 (p cos(3 phi - a) + q cos(phi + b)).
    const double p = std::abs(original.alpha) * std::abs(suspect.alpha) / (norm_a * norm_b);
    const double q = 3.0 * std::abs(original.beta) * std::abs(suspect.beta) / (norm_a * norm_b);
    const double a = std::arg(suspect.alpha * std::conj(original.alpha));
    const double b = std::arg(suspect.beta * std::conj(original.beta));
    std::array<double, 4> starts;
    for (int k = 0; k < 3; ++k) starts[k] = (a + 2.0 * std::numbers::pi * k) / 3.0;
    starts[3] = -b;

    std::vector<double> accepted;
    std::vector<SimilarityTransform> poses;
    for (double phi : starts) {
        constexpr int newton_steps = 8;
        double bend = 0.0;
        for (int step = 0; step < newton_steps; ++step) {
            const double slope = 3.0 * p * std::sin(3.0 * phi - a) + q * std::sin(phi + b);
            bend = 9.0 * p * std::cos(3.0 * phi - a) + q * std::cos(phi + b);
            if (!(bend > 0.0)) break;
            phi -= slope / bend;
        }
        const double square = 2.0 - 2.0 * (p * std::cos(3.0 * phi - a) + q * std::cos(phi + b));
        if (!(bend > 0.0) || square > misfit * misfit) continue;
        constexpr double same_angle = 1e-3;
        if (std::any_of(accepted.begin(), accepted.end(),
                        [&](double other) { return std::cos(phi - other) > std::cos(same_angle); }))
            continue;
        accepted.push_back(phi);
        Matrix3 frame_a, frame_b;
        frame_a << std::cos(phi) * original.x + std::sin(phi) * original.y,
            std::cos(phi) * original.y - std::sin(phi) * original.x, original.normal;
        frame_b << suspect.x, suspect.y, suspect.normal;
        const Matrix3 orthogonal = frame_a * frame_b.transpose();
        poses.push_back(
            similarity_from_orthogonal(scale, orthogonal, original.point - scale * (orthogonal * suspect.point)));
    }
    return poses;
}

std::optional<SimilarityTransform> pose_from_pairs(std::span<const std::pair<UmbilicMark, UmbilicMark>> pairs,
                                                   const SimilarityTransform& near, double length, bool free_scale) {
    std::vector<double> steadiness;
    for (const auto& [a, b] : pairs)
        steadiness.push_back(std::min(a.steadiness(), b.steadiness() / (near.scale * near.scale)));
    const double greatest = steadiness.empty() ? 0.0 : *std::max_element(steadiness.begin(), steadiness.end());
    const double tip = 0.5 * length;
    std::vector<PointPair> points;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto& [a, b] = pairs[k];
        const double relative = greatest > 0.0 ? std::max(steadiness[k] / greatest, least_steadiness) : 1.0;
        const double weight = relative * relative;
        points.push_back({a.point, b.point, weight});
        points.push_back({a.point + near.scale * tip * a.normal, b.point + tip * b.normal, weight});
    }
    try {
        return fit_points(points, {.free_scale = free_scale, .mirrored = near.mirrored}).original_suspect;
    } catch (const InvalidInput&) {
        return {};
    }
}

Proposals poses_by_umbilics(const PreparedModel& original, const PreparedModel& suspect, const ScaleChoice& scale,
                            MirrorChoice mirror, double invariant_tolerance, const Progress& progress) {
    const std::vector<UmbilicMark> marks_a = umbilic_marks(original.model, original.features);
    const std::vector<UmbilicMark> marks_b = umbilic_marks(suspect.model, suspect.features);
    if (marks_a.empty() || marks_b.empty())
        return {.why = std::string("umbilics: ") +
                       (marks_a.empty() && marks_b.empty() ? "neither model has"
                        : marks_a.empty()                  ? "the original does not have"
                                                           : "the suspect does not have") +
                       " an isolated one inside its faces"};

    const double length = shape_size(suspect.features).length;
    const bool oriented = original.model.oriented() && suspect.model.oriented();
    const std::vector<UmbilicReading> marks = umbilic_readings(marks_b, oriented, mirror);
    std::vector<Reading> readings;
    for (const UmbilicReading& reading : marks)
        readings.push_back({reading.marks, corresponding(marks_a, reading.marks, invariant_tolerance), {}});
    std::size_t pair_count = 0;
    std::vector<Hypothesis> all;
    for (std::size_t r = 0; r < readings.size(); ++r) {
        progress.report(static_cast<double>(r) / readings.size(), "matching umbilics");
        Reading& reading = readings[r];
        pair_count += reading.pairs.size();
        const std::size_t allowed =
            static_cast<std::size_t>(vote_budget / static_cast<double>(reading.pairs.size() + 1)) + 1;
        const std::size_t stride = reading.pairs.size() / allowed + 1;
        for (std::size_t k = 0; k < reading.pairs.size(); k += stride)
            for (SimilarityTransform pose : poses_from_pair(marks_a[reading.pairs[k].original],
                                                            reading.suspect[reading.pairs[k].suspect], cubic_misfit)) {
                if (!scale.allows(pose.scale, scale_slack)) continue;
                // A clamped scale must leave the matched umbilic where it is.
                const Vector3& anchor = reading.suspect[reading.pairs[k].suspect].point;
                const Vector3 target = pose.apply(anchor);
                pose.scale = scale.clamp(pose.scale);
                pose.translation += target - pose.apply(anchor);
                reading.hypotheses.push_back({pose});
            }
        tbb::parallel_for(std::size_t{0}, reading.hypotheses.size(), [&](std::size_t k) {
            progress.check();
            vote(marks_a, reading, length, reading.hypotheses[k]);
        });
        std::stable_sort(reading.hypotheses.begin(), reading.hypotheses.end(), better);
        tbb::parallel_for(std::size_t{0}, std::min(reading.hypotheses.size(), most_improved), [&](std::size_t k) {
            progress.check();
            improve(marks_a, reading, length, scale, reading.hypotheses[k]);
        });
        all.insert(all.end(), reading.hypotheses.begin(), reading.hypotheses.end());
    }
    std::stable_sort(all.begin(), all.end(), better);

    Proposals result{.why = "umbilics: " + std::to_string(marks_a.size()) + " of the original and " +
                            std::to_string(marks_b.size()) + " of the suspect gave " + std::to_string(pair_count) +
                            " corresponding pairs"};
    const PoseDistance distance(suspect.features);
    for (const Hypothesis& hypothesis : all) {
        if (result.poses.size() == most_proposals) break;
        progress.check();
        const auto near = [&](const PoseHypothesis& other) {
            return distance.relative(hypothesis.pose, other.original_suspect) < same_hypothesis;
        };
        if (std::none_of(result.poses.begin(), result.poses.end(), near))
            result.poses.push_back({hypothesis.pose, MatchMethod::umbilics});
    }
    return result;
}

}  // namespace umbilic
