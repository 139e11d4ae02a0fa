// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/prepared_model.h>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

/// Parts of the features done after the search for umbilics and after the samples, and of all that features take; for
/// the progress report only.
constexpr double umbilics_share = 0.8, samples_share = 0.95, features_share = 0.8;

}  // namespace

Features extract_features(const Model& model, const FeatureOptions& options, const Progress& progress) {
    Features features;
    features.umbilics = find_umbilics(model, options.umbilics, progress.part(0.0, umbilics_share));
    features.samples = area_samples(model, options.samples, progress.part(umbilics_share, samples_share));
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
