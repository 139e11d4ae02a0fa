// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include <umbilic/core/types.h>
#include <umbilic/nurbs/knot_vector.h>

namespace umbilic {

/// Partial derivatives of a surface r(u, v) at one point, all with du + dv <= order.
class SurfaceDerivatives {
public:
    int order = 0;

    /// The derivative of order k in u and l in v, k + l <= order.
    const Vector3& operator()(int k, int l) const { return values_[index(k, l)]; }
    Vector3& operator()(int k, int l) { return values_[index(k, l)]; }

    const Vector3& r() const { return values_[0]; }
    const Vector3& r_u() const { return (*this)(1, 0); }
    const Vector3& r_v() const { return (*this)(0, 1); }
    const Vector3& r_uu() const { return (*this)(2, 0); }
    const Vector3& r_uv() const { return (*this)(1, 1); }
    const Vector3& r_vv() const { return (*this)(0, 2); }

private:
    static constexpr int index(int k, int l) { return (k + l) * (k + l + 1) / 2 + l; }
    std::array<Vector3, (maximum_derivative + 1) * (maximum_derivative + 2) / 2> values_;
};

}  // namespace umbilic
