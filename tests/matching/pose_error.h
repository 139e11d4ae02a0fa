// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>

#include <umbilic/model/model.h>
#include <umbilic/core/similarity_transform.h>

namespace umbilic::support {

/// Greatest displacement, relative to the original's size, between two poses of points around the suspect.
inline double pose_error(const SimilarityTransform& found, const SimilarityTransform& truth, const Model& original) {
    const Vector3 centre = original.box.center();
    const double size = original.size();
    double greatest = 0.0;
    for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}) {
        const Vector3 p = truth.inverse().apply(centre + 0.5 * size * offset);
        greatest = std::max(greatest, (found.apply(p) - truth.apply(p)).norm());
    }
    return greatest / size;
}

}  // namespace umbilic::support
