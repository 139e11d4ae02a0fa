// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

/// Where a shape is and how long: measured on its area samples.
struct ShapeSize {
    Vector3 centroid = Vector3::Zero();
    double length = 0.0;  ///< twice the root mean square distance from the centroid, mm
};

ShapeSize shape_size(const std::vector<AreaSample>& samples);
inline ShapeSize shape_size(const Features& features) {
    return shape_size(features.samples);
}

/// Two hypotheses that displace the suspect by less than this part of its length lead to the same refined pose.
inline constexpr double same_hypothesis = 0.02;

/// Two poses are different answers if they move the suspect's centroid by more than `moved` of its length, turn it by
/// more than `turned` radians, or change its scale by more than the factor `scaled`; or differ in hand.
struct DifferentPose {
    static constexpr double moved = 0.15;
    static constexpr double turned = 0.4363323129985824;  // 25 degrees
    static constexpr double scaled = 1.15;
};

/// Compares poses of one suspect by what they do to it.
class PoseDistance {
public:
    explicit PoseDistance(const Features& suspect) : size_(shape_size(suspect)) {}
    explicit PoseDistance(const std::vector<AreaSample>& suspect) : size_(shape_size(suspect)) {}

    /// Greatest displacement between the two poses of the centroid and of points half a length away from it along the
    /// axes, relative to the moved suspect's length (of the larger pose).
    double relative(const SimilarityTransform& a, const SimilarityTransform& b) const;
    bool different(const SimilarityTransform& a, const SimilarityTransform& b) const;

private:
    ShapeSize size_;
};

}  // namespace umbilic
