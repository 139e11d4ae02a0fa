// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/prepared_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>

#include <umbilic/core/errors.h>
#include <umbilic/matching/pose_distance.h>
#include <umbilic/points/point_weights.h>

namespace umbilic {

namespace {

/// A jet whose curvatures are less certain than this part of their magnitude proposes nothing.
constexpr double greatest_uncertainty = 0.5;

/// Radii that are tried, as parts of the length, and the points at which they are.
constexpr std::array<double, 5> radii = {default_jet_radius, 0.2, 0.27, 0.36, 0.48};
constexpr std::size_t radius_points = 200;
/// A residual that grows by no more than this factor is still noise.
constexpr double residual_growth = 1.1;

/// The widest radius (mm) over which a polynomial leaves no more than over the narrowest.
double widest_radius(const PointCloud& cloud, const Neighbours& neighbours, const std::vector<int>& chosen,
                     double length, const JetOptions& options, const Progress& progress) {
    std::vector<int> some;
    const std::size_t stride = std::max<std::size_t>(1, chosen.size() / radius_points);
    for (std::size_t k = 0; k < chosen.size(); k += stride) some.push_back(chosen[k]);
    JetOptions with_radius = options;
    double least = 0.0, widest = radii.front() * length;
    for (const double radius : radii) {
        with_radius.radius = radius * length;
        const double residual = estimated_noise(point_jets(cloud, neighbours, some, with_radius, progress));
        if (radius == radii.front())
            least = residual;
        else if (residual > 0.0 && residual <= residual_growth * least)
            widest = radius * length;
        else
            break;
    }
    return widest;
}

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

/// Weights of points; those apart from the bulk count as one of it does.
std::vector<double> weights_of(const PointCloud& cloud, const Neighbours& neighbours, const Bulk& bulk) {
    std::vector<double> weights = point_weights(cloud, neighbours);
    if (cloud.is_mesh()) return weights;
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (bulk.holds(cloud.points[i])) sum += weights[i], ++count;
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (!bulk.holds(cloud.points[i])) weights[i] = sum / static_cast<double>(count);
    return weights;
}

PrincipalFrameTable table_of(const std::vector<PointJet>& jets, const Bulk& bulk, double area, double length) {
    std::vector<PrincipalFrameTable::Entry> entries;
    for (const PointJet& jet : jets) {
        if (!jet.valid) continue;
        PrincipalFrameTable::Entry entry{jet.frame, shape_signature(jet.derivatives, true)};
        const double uncertainty = std::max(jet.kappa_max_error, jet.kappa_min_error);
        if (!bulk.holds(jet.frame.point) || !jet.interior ||
            uncertainty > greatest_uncertainty * entry.signature.magnitude)
            entry.signature.magnitude = entry.signature.anisotropy = 0.0;
        entries.push_back(std::move(entry));
    }
    const double step = entries.empty() ? 0.0 : std::sqrt(area / static_cast<double>(entries.size()));
    return {std::move(entries), step, length};
}

std::vector<AreaSample> inside(const std::vector<AreaSample>& samples, const Bulk& bulk) {
    std::vector<AreaSample> kept;
    std::copy_if(samples.begin(), samples.end(), std::back_inserter(kept),
                 [&](const AreaSample& sample) { return bulk.holds(sample.curvature.point); });
    return kept;
}

}  // namespace

std::vector<AreaSample> bulk_samples(const PreparedPoints& points) {
    return inside(points.samples, points.bulk);
}

PreparedPoints prepare(const PointCloud& cloud, const PointFeatureOptions& options, const Progress& progress) {
    if (cloud.points.size() < static_cast<std::size_t>(fewest_points))
        throw InvalidInput(cloud.source.path + ": holds " + std::to_string(cloud.points.size()) + " points, at least " +
                           std::to_string(fewest_points) + " are needed to know a shape");
    progress.report(0.0, "neighbours");
    const Neighbours neighbours(cloud.points);
    const Bulk bulk = bulk_of(cloud.points);
    const std::vector<double> weights = weights_of(cloud, neighbours, bulk);
    const double area = std::accumulate(weights.begin(), weights.end(), 0.0);
    const std::vector<int> chosen = chosen_points(cloud.points.size(), options.samples, options.seed);
    progress.report(0.1, "jets");
    JetOptions jet_options = options.jets;
    std::vector<Vector3> most;
    std::copy_if(cloud.points.begin(), cloud.points.end(), std::back_inserter(most),
                 [&](const Vector3& p) { return bulk.holds(p); });
    const double spread = cloud_length(most);
    if (!jet_options.radius && spread > 0.0)
        jet_options.radius = widest_radius(cloud, neighbours, chosen, spread, options.jets, progress.part(0.1, 0.4));
    std::vector<PointJet> jets = point_jets(cloud, neighbours, chosen, jet_options, progress.part(0.4, 1.0));
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
    const double length = shape_size(inside(samples, bulk)).length;
    PrincipalFrameTable table = table_of(jets, bulk, area, length);
    const double noise = estimated_noise(jets);
    progress.report(1.0, "points prepared");
    return {cloud,
            std::move(samples),
            std::move(jets),
            std::move(table),
            cloud.is_mesh() ? std::make_unique<const TriangleTree>(cloud) : nullptr,
            area,
            bulk,
            length,
            jet_options.radius.value_or(0.0),
            noise,
            cloud.is_mesh() || !cloud.normals.empty()};
}

double typical_curvature_error(const PreparedPoints& points) {
    std::vector<double> errors;
    for (const PointJet& jet : points.jets)
        if (jet.valid) errors.push_back(std::max(jet.kappa_max_error, jet.kappa_min_error));
    if (errors.empty()) return 0.0;
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    return *middle;
}

}  // namespace umbilic
