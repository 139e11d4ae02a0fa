// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/prepared_model.h>

#include <map>

#include <umbilic/core/errors.h>
#include <umbilic/points/neighbours.h>

namespace umbilic {

namespace {

/// Parts of the features done after the search for umbilics and after the samples, and of all that features take; for
/// the progress report only.
constexpr double umbilics_share = 0.8, samples_share = 0.95, features_share = 0.8;

std::vector<std::vector<int>> neighbours_on_faces(const std::vector<AreaSample>& samples) {
    std::map<int, std::vector<int>> on_faces;
    for (std::size_t i = 0; i < samples.size(); ++i) on_faces[samples[i].at.face].push_back(static_cast<int>(i));
    std::vector<std::vector<int>> result(samples.size());
    for (const auto& [face, indices] : on_faces) {
        std::vector<Vector3> points;
        for (const int i : indices) points.push_back(samples[i].curvature.point);
        const Neighbours tree(points);
        for (std::size_t k = 0; k < points.size(); ++k)
            for (const Neighbour& near : tree.nearest(points[k], neighbours_of_sample + 1))
                if (near.index != static_cast<int>(k) && result[indices[k]].size() < neighbours_of_sample)
                    result[indices[k]].push_back(indices[near.index]);
    }
    return result;
}

}  // namespace

Features extract_features(const Model& model, const FeatureOptions& options, const Progress& progress) {
    Features features;
    features.umbilics = find_umbilics(model, options.umbilics, progress.part(0.0, umbilics_share));
    features.samples = area_samples(model, options.samples, progress.part(umbilics_share, samples_share));
    features.neighbours = neighbours_on_faces(features.samples);
    features.analytic = analytic_features(model, features.samples, progress.part(samples_share, 1.0));
    return features;
}

PreparedModel prepare(const Model& model, const FeatureOptions& options, const Progress& progress) {
    if (model.faces.empty())
        throw InvalidInput(model.source.path + ": the model has no face to compare; export surfaces or solids");
    return {model, extract_features(model, options, progress.part(0.0, features_share)), ClosestPointTree(model),
            PrincipalFrameTable(model, options.table_samples, progress.part(features_share, 1.0))};
}

}  // namespace umbilic
