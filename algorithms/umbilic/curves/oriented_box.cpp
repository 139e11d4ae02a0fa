// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/oriented_box.h>

#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace umbilic {

std::array<Vector3, 8> OrientedBox::corners() const {
    std::array<Vector3, 8> result;
    for (int k = 0; k < 8; ++k) {
        const Vector3 sign(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
        result[k] = center + axes.transpose() * half.cwiseProduct(sign);
    }
    return result;
}

OrientedBox box_around(std::span<const Vector3> points, const Matrix3& axes) {
    BoundingBox range;
    for (const Vector3& point : points) range.add(Vector3(axes * point));
    return {axes.transpose() * range.center(), axes, 0.5 * (range.high - range.low)};
}

OrientedBox box_around(std::span<const Vector3> points) {
    Vector3 mean = Vector3::Zero();
    for (const Vector3& point : points) mean += point;
    mean /= static_cast<double>(points.size());
    Matrix3 spread = Matrix3::Zero();
    for (const Vector3& point : points) spread += (point - mean) * (point - mean).transpose();
    const OrientedBox straight = box_around(points, Matrix3::Identity());
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(spread);
    if (solver.info() != Eigen::Success) return straight;
    const OrientedBox turned = box_around(points, solver.eigenvectors().transpose());
    return turned.half_area() < straight.half_area() ? turned : straight;
}

Matrix3 frame_along(const Vector3& x, const Vector3& y) {
    Matrix3 result = Matrix3::Identity();
    const double length = x.norm();
    if (!(length > 0.0)) return y.norm() > 0.0 ? frame_along(y, x) : result;
    const Vector3 first = x / length;
    Vector3 normal = first.cross(y);
    if (!(normal.norm() > std::numeric_limits<double>::epsilon() * y.norm())) normal = first.unitOrthogonal();
    normal -= normal.dot(first) * first;  // what rounding left, if x and y are almost parallel
    normal.normalize();
    result.row(0) = first;
    result.row(1) = normal.cross(first);
    result.row(2) = normal;
    return result;
}

}  // namespace umbilic
