// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/pose_distance.h>

#include <algorithm>
#include <cmath>

namespace umbilic {

ShapeSize shape_size(const std::vector<AreaSample>& samples) {
    ShapeSize size;
    double weight = 0.0, square = 0.0;
    for (const AreaSample& sample : samples) {
        size.centroid += sample.weight * sample.curvature.point;
        weight += sample.weight;
    }
    if (!(weight > 0.0)) return size;
    size.centroid /= weight;
    for (const AreaSample& sample : samples)
        square += sample.weight * (sample.curvature.point - size.centroid).squaredNorm();
    size.length = 2.0 * std::sqrt(square / weight);
    return size;
}

double PoseDistance::relative(const SimilarityTransform& a, const SimilarityTransform& b) const {
    double greatest = (a.apply(size_.centroid) - b.apply(size_.centroid)).norm();
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-0.5, 0.5}) {
            const Vector3 p = size_.centroid + sign * size_.length * Vector3::Unit(axis);
            greatest = std::max(greatest, (a.apply(p) - b.apply(p)).norm());
        }
    return greatest / (size_.length * std::max(a.scale, b.scale));
}

bool PoseDistance::different(const SimilarityTransform& a, const SimilarityTransform& b) const {
    const double scale = std::max(a.scale, b.scale);
    return a.mirrored != b.mirrored || scale > DifferentPose::scaled * std::min(a.scale, b.scale) ||
           (a.apply(size_.centroid) - b.apply(size_.centroid)).norm() > DifferentPose::moved * size_.length * scale ||
           rotation_angle_between(a.rotation, b.rotation) > DifferentPose::turned;
}

}  // namespace umbilic
