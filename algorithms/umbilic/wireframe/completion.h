// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/wireframe/border_nodes.h>
#include <umbilic/wireframe/face_frame.h>
#include <umbilic/wireframe/line_net.h>
#include <umbilic/wireframe/wireframe.h>

namespace umbilic {

struct CompletionOptions {
    double step = 0.0;
    int most_nodes = 0;
    bool drawn = true;  ///< with points of geodesics and the coverage
};

struct Completion {
    FaceWireframe wireframe;
    /// Edges of the model (FaceAdjacency) whose nodes are too far apart: their chords cross.
    std::vector<int> crossing_edges;
};

/// Joins the nodes of a face's border and net to triangles and quadrilaterals, and adds nodes where the net leaves
/// more than a step open. What is equally good is decided by the face's frame.
Completion complete(const Face& face, const FaceBorder& border, const FaceFrame& frame, const LineNet& net,
                    const LineField& field, const CompletionOptions& options, const Progress& progress = {});

}  // namespace umbilic
