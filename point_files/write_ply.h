// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/model/point_cloud.h>

namespace umbilic {

/// The points, moved, with their normals and triangles, as the text of a PLY file whose numbers read back exactly.
std::string ply_text(const PointCloud& cloud, const SimilarityTransform& transform = {});

}  // namespace umbilic
