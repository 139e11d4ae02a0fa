// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/core/similarity_transform.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace umbilic {

namespace {

Matrix3 mirror() {
    return Vector3(-1.0, 1.0, 1.0).asDiagonal();
}

}  // namespace

Matrix3 SimilarityTransform::orthogonal() const {
    return mirrored ? Matrix3(rotation * mirror()) : rotation;
}

Vector3 SimilarityTransform::apply(const Vector3& point) const {
    return scale * (orthogonal() * point) + translation;
}

Vector3 SimilarityTransform::apply_direction(const Vector3& direction) const {
    return orthogonal() * direction;
}

SimilarityTransform SimilarityTransform::inverse() const {
    const Matrix3 transposed = orthogonal().transpose();
    return similarity_from_orthogonal(1.0 / scale, transposed, -(transposed * translation) / scale);
}

SimilarityTransform compose(const SimilarityTransform& outer, const SimilarityTransform& inner) {
    return similarity_from_orthogonal(outer.scale * inner.scale, outer.orthogonal() * inner.orthogonal(),
                                      outer.apply(inner.translation));
}

SimilarityTransform similarity_from_orthogonal(double scale, const Matrix3& orthogonal, const Vector3& translation) {
    SimilarityTransform result;
    result.scale = scale;
    result.mirrored = orthogonal.determinant() < 0.0;
    result.rotation = result.mirrored ? Matrix3(orthogonal * mirror()) : orthogonal;
    result.translation = translation;
    return result;
}

double rotation_angle_between(const Matrix3& a, const Matrix3& b) {
    return Eigen::Quaterniond(a).angularDistance(Eigen::Quaterniond(b));
}

}  // namespace umbilic
