// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

/// Where a comparison takes its nodes from.
enum class NodeChoice {
    wireframe,  ///< inner nodes of the shape-intrinsic wireframe (thesis 4.4.4)
    area        ///< the samples uniform by area
};

/// Nodes of one model. Their weights sum to the area of each face.
struct NodeSet {
    std::vector<AreaSample> nodes;
    int of_wireframe = 0;  ///< so many are nodes of the wireframe; the others are area samples
    int area_faces = 0;    ///< faces whose nodes are area samples
};

/// Inner nodes of the wireframe of a model with a step that makes about `count` of them, each with the area nearest to
/// it. Nodes on borders are left out: there the foot may lie on either of two faces. A face without inner nodes, whose
/// wireframe is incomplete, or whose inner nodes are too few to stand for its area, keeps its area samples. Throws
/// Cancelled.
NodeSet wireframe_nodes(const PreparedModel& prepared, int count, const Progress& progress = {});

/// The area samples of a model.
NodeSet area_nodes(const PreparedModel& prepared);

/// Lower-case words of options and results.
const char* name(NodeChoice choice);

}  // namespace umbilic
