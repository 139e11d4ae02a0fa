// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/prepared_points.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <umbilic/core/errors.h>
#include <umbilic/matching/pose_distance.h>
#include <umbilic/points/point_weights.h>

namespace umbilic {

namespace {

/// A jet whose curvatures are less certain than this part of their magnitude proposes nothing.
constexpr double greatest_uncertainty = 0.5;

std::vector<int> chosen_points(std::size_t count, int wanted, std::uint64_t seed) {
    std::vector<int> indices(count);
    std::iota(indices.begin(), indices.end(), 0);
    if (count <= static_cast<std::size_t>(wanted)) return indices;
    std::mt19937_64 random(seed);
    for (int k = 0; k < wanted; ++k) std::swap(indices[k], indices[k + random() % (count - k)]);
    indices.resize(wanted);
    std::sort(indices.begin(), indices.end());
    return indices;
}

PrincipalFrameTable table_of(const std::vector<PointJet>& jets, double area) {
    std::vector<PrincipalFrameTable::Entry> entries;
    for (const PointJet& jet : jets) {
        if (!jet.valid) continue;
        PrincipalFrameTable::Entry entry{jet.frame, shape_signature(jet.derivatives, true)};
        const double uncertainty = std::max(jet.kappa_max_error, jet.kappa_min_error);
        if (!jet.interior || uncertainty > greatest_uncertainty * entry.signature.magnitude)
            entry.signature.magnitude = entry.signature.anisotropy = 0.0;
        entries.push_back(std::move(entry));
    }
    const double step = entries.empty() ? 0.0 : std::sqrt(area / static_cast<double>(entries.size()));
    return {std::move(entries), step};
}

}  // namespace

PreparedPoints prepare(const PointCloud& cloud, const PointFeatureOptions& options, const Progress& progress) {
    if (cloud.points.size() < static_cast<std::size_t>(fewest_points))
        throw InvalidInput(cloud.source.path + ": holds " + std::to_string(cloud.points.size()) + " points, at least " +
                           std::to_string(fewest_points) + " are needed to know a shape");
    progress.report(0.0, "neighbours");
    const Neighbours neighbours(cloud.points);
    const std::vector<double> weights = point_weights(cloud, neighbours);
    const double area = std::accumulate(weights.begin(), weights.end(), 0.0);
    const std::vector<int> chosen = chosen_points(cloud.points.size(), options.samples, options.seed);
    progress.report(0.1, "jets");
    std::vector<PointJet> jets = point_jets(cloud, neighbours, chosen, options.jets, progress.part(0.1, 1.0));
    if (std::none_of(jets.begin(), jets.end(), [](const PointJet& jet) { return jet.valid; }))
        throw InvalidInput(cloud.source.path + ": the points lie on no surface; is it a curve or a volume of points?");

    double chosen_weight = 0.0;
    for (const int i : chosen) chosen_weight += weights[i];
    std::vector<AreaSample> samples;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        AreaSample sample{.curvature = jets[k].frame};
        sample.curvature.regular = jets[k].valid;
        sample.curvature.point = cloud.points[chosen[k]];
        sample.weight = chosen_weight > 0.0 ? weights[chosen[k]] * area / chosen_weight : 0.0;
        samples.push_back(sample);
    }
    PrincipalFrameTable table = table_of(jets, area);
    const double length = shape_size(samples).length;
    const double noise = estimated_noise(jets);
    progress.report(1.0, "points prepared");
    return {cloud,
            std::move(samples),
            std::move(jets),
            std::move(table),
            area,
            length,
            noise,
            cloud.is_mesh() || !cloud.normals.empty()};
}

}  // namespace umbilic
