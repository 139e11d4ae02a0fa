// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/table_ground.h>

#include <cmath>

namespace umbilic {

namespace {

/// The paraboloid is trusted where it departs from its tangent plane by less than it extends, and leans by less than 45
/// degrees: no point within a limit of such a one is farther from its sample than twice limit and border together.
constexpr double reach = 2.0;

}  // namespace

std::optional<GroundFoot> TableGround::foot(const Vector3& point, double limit) const {
    const double border = PrincipalFrameTable::border_steps * table_.step();
    const PrincipalFrameTable::Entry* entry = table_.nearest(point, reach * (limit + border));
    if (!entry) return {};
    const Curvature& frame = entry->frame;
    const Vector3 offset = point - frame.point;
    const double x = offset.dot(frame.direction_max), y = offset.dot(frame.direction_min);
    if (std::hypot(x, y) > border) {
        const double distance = offset.norm();
        if (distance > limit) return {};
        return GroundFoot{frame.point, frame.normal, distance, true};
    }
    // kappa = -II / I: the surface falls away from its normal where kappa is positive.
    const double height = -0.5 * (frame.kappa_max * x * x + frame.kappa_min * y * y);
    const Vector3 rise =
        frame.normal + frame.kappa_max * x * frame.direction_max + frame.kappa_min * y * frame.direction_min;
    const double steepness = rise.norm();
    const double distance = (offset.dot(frame.normal) - height) / steepness;
    if (std::abs(distance) > limit) return {};
    const Vector3 normal = rise / steepness;
    return GroundFoot{point - distance * normal, normal, std::abs(distance), false};
}

}  // namespace umbilic
