// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/closest_point.h>
#include <umbilic/differential/area_samples.h>
#include <umbilic/model/model.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {

struct FeatureOptions {
    UmbilicOptions umbilics;
    AreaSampleOptions samples;
};

/// Intrinsic features of a model: what matching and assessment need to know of its shape.
struct Features {
    std::vector<FaceUmbilics> umbilics;  ///< one entry a face, in the model's order
    std::vector<AreaSample> samples;
};

Features extract_features(const Model& model, const FeatureOptions& options = {}, const Progress& progress = {});

/// A model with everything computed once for it: features and the tree for closest points. Keeps a reference to the
/// model.
struct PreparedModel {
    const Model& model;
    Features features;
    ClosestPointTree tree;
};

/// Throws InvalidInput, naming the file, if the model has no face.
PreparedModel prepare(const Model& model, const FeatureOptions& options = {}, const Progress& progress = {});

}  // namespace umbilic
