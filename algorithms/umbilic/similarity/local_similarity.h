// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include <umbilic/model/model.h>
#include <umbilic/similarity/assessment.h>
#include <umbilic/similarity/statistics.h>

namespace umbilic {

/// Local similarity of one quantity on the model the nodes belong to (thesis 4.4.4). Cells of side `cell`, in (0, 1]
/// and relative to the face's domain, are marked if one of their nodes exceeds the tolerance; only cells that hold a
/// node with this quantity are counted. The quantities are not divided by their maxima: that would mark cells on any
/// pair of models. Where nothing is counted, both percentages are 0.
LocalSimilarity local_similarity(const Model& model, std::span<const NodeComparison> nodes, Quantity quantity,
                                 double tolerance, double cell);

/// The same of measured points, which have no parameters: cells are cubes of side `side` (mm of the original) in space.
LocalSimilarity local_similarity(std::span<const NodeComparison> nodes, Quantity quantity, double tolerance,
                                 double side);

}  // namespace umbilic
