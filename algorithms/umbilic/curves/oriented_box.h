// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <span>

#include <umbilic/core/types.h>

namespace umbilic {

/// Box in space with sides along the rows of an orthogonal matrix.
struct OrientedBox {
    Vector3 center = Vector3::Zero();
    Matrix3 axes = Matrix3::Identity();
    Vector3 half = Vector3::Zero();  ///< half side lengths

    std::array<Vector3, 8> corners() const;
    /// Half the area of the surface.
    double half_area() const { return half.x() * half.y() + half.y() * half.z() + half.z() * half.x(); }
};

/// Smallest box of the points with the given axes (rows).
OrientedBox box_around(std::span<const Vector3> points, const Matrix3& axes);

/// Smaller, by area, of the boxes along the coordinate axes and along the principal axes of the points.
OrientedBox box_around(std::span<const Vector3> points);

/// Orthogonal rows, the first along x, the third normal to x and y as far as they are independent.
Matrix3 frame_along(const Vector3& x, const Vector3& y);

}  // namespace umbilic
