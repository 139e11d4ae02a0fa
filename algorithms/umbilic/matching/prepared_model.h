// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curves/closest_point.h>
#include <umbilic/differential/area_samples.h>
#include <umbilic/matching/analytic_features.h>
#include <umbilic/matching/principal_frame_table.h>
#include <umbilic/model/model.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {

struct FeatureOptions {
    UmbilicOptions umbilics;
    AreaSampleOptions samples;
    int table_samples = 20000;  ///< of the table of principal frames
};

inline constexpr int neighbours_of_sample = 6;

/// Intrinsic features of a model: what matching and assessment need to know of its shape.
struct Features {
    std::vector<FaceUmbilics> umbilics;  ///< one entry a face, in the model's order
    std::vector<AreaSample> samples;
    /// For each sample those nearest to it on its own face (indices into `samples`), `neighbours_of_sample` of them or
    /// all there are.
    std::vector<std::vector<int>> neighbours;
    std::vector<AnalyticFeature> analytic;  ///< planes, cylinders and the like that its faces lie on
};

Features extract_features(const Model& model, const FeatureOptions& options = {}, const Progress& progress = {});

/// A model with everything computed once for it: features, the tree for closest points, and the table in which
/// principal frames and nearest samples are looked up. Keeps a reference to the model.
struct PreparedModel {
    const Model& model;
    Features features;
    ClosestPointTree tree;
    PrincipalFrameTable table;
};

/// Throws InvalidInput, naming the file, if the model has no face.
PreparedModel prepare(const Model& model, const FeatureOptions& options = {}, const Progress& progress = {});

}  // namespace umbilic
