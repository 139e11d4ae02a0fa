// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/analytic_features.h>
#include <umbilic/matching/choices.h>

namespace umbilic {

/// Sum of row^T row of the equations that a feature sets on small similarities (turn, shift, log of the scale) about
/// `centre`, lengths over `length` (mm): a direction stays parallel, a plane, axis or centre stays where it is, a
/// radius keeps its size. Its null space holds the motions that leave the feature as it is.
Eigen::Matrix<double, 7, 7> feature_constraints(const AnalyticFeature& feature, const Vector3& centre, double length);

/// Features that together fix a similarity, as far as any of their model do.
struct AnalyticBasis {
    std::vector<int> features;  ///< indices, in the order in which they are to be assigned
    bool determined = false;    ///< no motion is left free
};

/// Chooses up to `count` different bases of at most six features each, those first that say most and have the fewest
/// possible partners: features are added while they fix a motion that was free. `partners`: for each feature how many
/// of the other model's are of its kind; features without any are not used. With a known scale its equation is added.
std::vector<AnalyticBasis> choose_bases(const std::vector<AnalyticFeature>& features, const std::vector<int>& partners,
                                        bool known_scale, int count);

/// A feature of the suspect and the one of the original on which it is to lie.
struct FeaturePair {
    const AnalyticFeature* suspect = nullptr;
    const AnalyticFeature* original = nullptr;
    double sense = 1.0;  ///< -1 if the directions run against each other
};

/// A pose from pairs of features, and how far (mm of the original) the worst equation is from being satisfied, what the
/// features may be off by taken off.
struct FeaturePose {
    SimilarityTransform original_suspect;
    double residual = 0.0;
};

/// Orthogonal matrices (one of each hand that is asked for) that lay the pairs' directions onto each other: two that
/// are not parallel, otherwise also the perpendiculars between parallel axes and the lines between centres.
/// `length`: of the suspect, mm. Empty if the directions do not suffice.
std::vector<Matrix3> orthogonal_maps(const std::vector<FeaturePair>& pairs, double length, bool mirrored_too);

/// Least squares of the equations of planes, axes, centres and radii in scale and translation, with the orthogonal map
/// given. What they leave open is the least change from the start: a scale, and where `point` (mm of the suspect)
/// shall go. `length`: of the suspect, mm; a known scale is one more equation. The scale found may be zero or negative
/// where the pairs contradict each other.
struct PlacingStart {
    double scale = 1.0;
    Vector3 point = Vector3::Zero();
    Vector3 image = Vector3::Zero();
};
FeaturePose place(const std::vector<FeaturePair>& pairs, const Matrix3& orthogonal, const PlacingStart& start,
                  double length, const ScaleChoice& scale);

}  // namespace umbilic
