// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <umbilic/matching/ground_surface.h>
#include <umbilic/matching/principal_frame_table.h>

namespace umbilic {

/// A shape known by samples with principal frames: its surface near a point is the osculating paraboloid of the nearest
/// sample. Errors are of the third order in the step; some ten times faster than the closest point of the surface, and
/// all there is of a cloud. Nothing lies on an empty table. Keeps a reference to the table.
class TableGround : public GroundSurface {
public:
    explicit TableGround(const PrincipalFrameTable& table) : table_(table) {}
    std::optional<GroundFoot> foot(const Vector3& point, double limit) const override;

private:
    const PrincipalFrameTable& table_;
};

}  // namespace umbilic
