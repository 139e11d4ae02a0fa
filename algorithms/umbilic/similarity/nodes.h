// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/prepared_model.h>
#include <umbilic/similarity/assessment.h>
#include <umbilic/similarity/wireframe_nodes.h>

namespace umbilic {

/// How a model is brought into the original's frame: the identity for the original itself.
struct PlacedModel {
    const PreparedModel& prepared;
    SimilarityTransform original_model;
    /// The model's normals are reversed (curvatures negated and exchanged) after placing.
    bool flipped = false;
    bool is_original = false;
};

/// A curvature in the original's frame and unit.
Curvature placed(const Curvature& curvature, const PlacedModel& model);

/// Nodes of a model, in the original's frame, and their closest points on the other model (whose `at`, `kind` are as
/// the tree gave them, `point` and `distance` in the original's frame and unit).
struct Feet {
    std::vector<Vector3> nodes;
    std::vector<ClosestPoint> feet;
};

/// Closest points of the nodes of `model`, given in its own frame, on `other`.
Feet find_feet(const PlacedModel& model, const NodeSet& nodes, const PlacedModel& other, const Progress& progress);

/// Area-weighted sum, over nodes within `limit` (mm) of their foot, of the cosine between the normals of node and foot:
/// negative where one of the models is inside out against the other.
double normal_agreement(const PlacedModel& model, const NodeSet& nodes, const PlacedModel& other, const Feet& feet,
                        double limit);

/// Tolerances the comparison of nodes depends on.
struct NodeTolerances {
    double distance = 0.0;  ///< delta_0, mm
    double kappa = 0.0;     ///< delta_1, 1/mm: principal directions are defined where kappa_max - kappa_min exceeds it
    MatchScope scope = MatchScope::global;
};

/// The quantities of the thesis's assessment (4.4.4) at every node, with their statistics. Curvatures are left out
/// where the foot lies on a trimming edge, where node or foot is singular or bends more tightly than the radius delta_0
/// (next to tips and poles, where curvatures grow without bound and places within the tolerance differ in them);
/// directions also where kappa_max - kappa_min is not significant at node or foot.
DirectedComparison compare_nodes(const PlacedModel& model, const NodeSet& nodes, const PlacedModel& other,
                                 const Feet& feet, const NodeTolerances& tolerances);

}  // namespace umbilic
