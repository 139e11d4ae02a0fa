// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

#include <limits>

namespace umbilic {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Vector4 = Eigen::Vector4d;
using Matrix2 = Eigen::Matrix2d;
using Matrix3 = Eigen::Matrix3d;

/// Closed interval of a surface or curve parameter, low <= high.
struct ParameterInterval {
    double low = 0.0;
    double high = 1.0;

    double length() const { return high - low; }
    double middle() const { return 0.5 * (low + high); }
    bool contains(double value) const { return low <= value && value <= high; }
    double clamp(double value) const { return value < low ? low : value > high ? high : value; }
};

/// Axis-parallel box in a surface's parameter plane.
struct ParameterBox {
    ParameterInterval u;
    ParameterInterval v;

    bool contains(double u_value, double v_value) const { return u.contains(u_value) && v.contains(v_value); }
};

/// Point of a model: the number of its face (from 1, in the model's order) and the parameters on that face's
/// NURBS surface.
struct SurfacePoint {
    int face = 0;
    double u = 0.0;
    double v = 0.0;
};

/// Axis-parallel box in space; empty until a point is added.
struct BoundingBox {
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
    Vector3 high = Vector3::Constant(-std::numeric_limits<double>::infinity());

    bool empty() const { return !(low.x() <= high.x()); }
    void add(const Vector3& point) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    void add(const BoundingBox& other) {
        low = low.cwiseMin(other.low);
        high = high.cwiseMax(other.high);
    }
    Vector3 center() const { return 0.5 * (low + high); }
    /// Length of the space diagonal; 0 for an empty box.
    double diagonal() const { return empty() ? 0.0 : (high - low).norm(); }
};

}  // namespace umbilic
