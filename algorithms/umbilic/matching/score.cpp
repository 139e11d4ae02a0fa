// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/score.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <oneapi/tbb/parallel_for.h>

namespace umbilic {

namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

double sample_distance(const GroundSurface& ground, const AreaSample& sample, const SimilarityTransform& ground_suspect,
                       double limit, bool oriented) {
    const Vector3 point = ground_suspect.apply(sample.curvature.point);
    const Vector3 normal = ground_suspect.apply_direction(sample.curvature.normal);
    const auto agrees = [&](const GroundFoot& foot) {
        if (foot.at_border || !foot.normal) return true;
        const double cosine = foot.normal->dot(normal);
        return (oriented ? cosine : std::abs(cosine)) >= agreeing_cosine;
    };
    auto foot = ground.foot(point, limit);
    // Where parts of an assembly touch, the face of the other part may have come first.
    if (foot && !agrees(*foot)) foot = ground.foot_on_other_face(point, limit, *foot);
    return foot && agrees(*foot) ? foot->distance : nowhere;
}

double van_der_corput(unsigned index) {
    double value = 0.0, digit = 0.5;
    for (; index > 0; index >>= 1, digit *= 0.5)
        if (index & 1u) value += digit;
    return value;
}

}  // namespace

std::optional<GroundFoot> Ground::foot(const Vector3& point, double limit) const {
    return foot_without(point, limit, 0);
}

std::optional<GroundFoot> Ground::foot_on_other_face(const Vector3& point, double limit, const GroundFoot& foot) const {
    return foot_without(point, limit, foot.at.face);
}

std::optional<GroundFoot> Ground::foot_without(const Vector3& point, double limit, int face) const {
    const auto closest = model.tree.closest(point, limit, face);
    if (!closest || closest->distance > limit) return {};
    return GroundFoot{closest->point, normals.at(closest->at), closest->distance, closest->kind != FootKind::interior,
                      closest->at};
}

std::vector<double> sample_distances(const Ground& ground, const PreparedModel& suspect,
                                     const SimilarityTransform& ground_suspect, double limit) {
    return sample_distances(ground, ground.model.model.oriented() && suspect.model.oriented(), suspect.features.samples,
                            ground_suspect, limit);
}

std::vector<double> sample_distances(const GroundSurface& ground, bool oriented, const std::vector<AreaSample>& samples,
                                     const SimilarityTransform& ground_suspect, double limit) {
    std::vector<double> distances(samples.size());
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
        distances[i] = sample_distance(ground, samples[i], ground_suspect, limit, oriented);
    });
    return distances;
}

Coverage coverage(const std::vector<AreaSample>& samples, const std::vector<double>& distances, double tolerance) {
    Coverage result;
    double total = 0.0, square = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double weight = samples[i].weight, d = distances[i];
        total += weight;
        if (d > tolerance) continue;
        const double ratio = d / tolerance;
        result.share += weight;
        result.soft += weight * (1.0 - ratio * ratio);
        square += weight * d * d;
        result.max = std::max(result.max, d);
    }
    if (result.share > 0.0) result.rms = std::sqrt(square / result.share);
    if (total > 0.0) {
        result.share /= total;
        result.soft /= total;
    }
    return result;
}

std::vector<int> spread_samples(const std::vector<AreaSample>& samples, int count) {
    std::vector<double> until;
    double total = 0.0;
    for (const AreaSample& sample : samples) until.push_back(total += sample.weight);
    std::vector<int> which;
    if (!(total > 0.0)) return which;
    for (int k = 0; k < count; ++k) {
        const double at = total * van_der_corput(k + 1);
        const auto found = std::upper_bound(until.begin(), until.end() - 1, at);
        which.push_back(static_cast<int>(found - until.begin()));
    }
    return which;
}

double quick_score(const GroundSurface& ground, bool oriented, const std::vector<AreaSample>& samples,
                   const std::vector<int>& which, const SimilarityTransform& ground_suspect, double tolerance,
                   double at_least) {
    double sum = 0.0;
    const double needed = at_least * which.size();
    for (std::size_t k = 0; k < which.size(); ++k) {
        if (sum + static_cast<double>(which.size() - k) < needed) break;
        const double d = sample_distance(ground, samples[which[k]], ground_suspect, tolerance, oriented);
        if (d <= tolerance) sum += 1.0 - (d / tolerance) * (d / tolerance);
    }
    return which.empty() ? 0.0 : sum / which.size();
}

}  // namespace umbilic
