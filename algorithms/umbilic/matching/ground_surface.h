// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include <umbilic/core/types.h>

namespace umbilic {

/// Where a point comes to lie on a shape.
struct GroundFoot {
    Vector3 point = Vector3::Zero();
    std::optional<Vector3> normal;  ///< unit, towards the outward side; nothing at singular points
    double distance = 0.0;          ///< mm
    bool at_border = false;         ///< the foot lies on an edge or corner of the shape
    SurfacePoint at;                ///< of a model; face 0 on measured points
};

/// A shape that points can be laid onto: a model or a cloud. Queries may come from any number of threads.
class GroundSurface {
public:
    virtual ~GroundSurface() = default;
    /// Closest point of the shape; nothing if it is farther than `limit` (mm).
    virtual std::optional<GroundFoot> foot(const Vector3& point, double limit) const = 0;
    /// The same on another face than the foot's, where faces touch; nothing on shapes without faces.
    virtual std::optional<GroundFoot> foot_on_other_face(const Vector3&, double /*limit*/, const GroundFoot&) const {
        return {};
    }
};

}  // namespace umbilic
