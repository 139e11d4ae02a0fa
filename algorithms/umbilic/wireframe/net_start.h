// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include <umbilic/umbilics/umbilic.h>
#include <umbilic/wireframe/border_nodes.h>
#include <umbilic/wireframe/face_frame.h>
#include <umbilic/wireframe/line_net.h>

namespace umbilic {

/// Where the net of a face begins, chosen by its shape (thesis 3.7.1, step 14): a star umbilic farther than `step` from
/// the border whose half-lines are all a step long, the one nearest to the face's centroid if no other is as near;
/// otherwise the point of the face nearest to its centroid, or, if it has no principal directions or is on the border,
/// to that of its area; otherwise a point one step inside of the border place nearest to the centroid. The centroid is
/// that of the border's length, or of the area of a surface without border. Where a face is umbilic everywhere, lines
/// along a principal axis of its border take the place of lines of curvature. What is equally near is decided by the
/// face's frame. Nothing if no such point is found: the face is then meshed from its border alone.
std::optional<NetStart> net_start(const Face& face, const FaceBorder& border, const FaceFrame& frame,
                                  const FaceUmbilics& umbilics, double step);

}  // namespace umbilic
