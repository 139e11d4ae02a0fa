// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <umbilic/matching/match.h>
#include <umbilic/matching/prepared_shape.h>
#include <umbilic/similarity/verdict.h>
#include <umbilic/similarity/wireframe_nodes.h>

namespace umbilic {

struct CompareOptions {
    FeatureOptions features;
    PointFeatureOptions points;  ///< of measured points
    MatchOptions match;
    ToleranceChoices tolerances;
    NodeChoice nodes = NodeChoice::wireframe;
    int algorithm = 2;  ///< decision algorithm that gives the verdict's level, 1 or 2
};

/// Everything one comparison found; the models and their features stay with the caller.
struct Comparison {
    Alignment alignment;
    Assessment assessment;  ///< empty nodes where no pose was found
    Verdict verdict;
    Answer answer;
    std::vector<std::pair<std::string, double>> timing;  ///< stage, seconds
};

/// The whole comparison of two prepared models: match, assess, decide, answer. Throws Cancelled.
Comparison compare(const PreparedModel& original, const PreparedModel& suspect, const CompareOptions& options = {},
                   const Progress& progress = {});

/// The same where either may be measured points. Throws Unsupported for a model as the suspect of points.
Comparison compare(const PreparedShape& original, const PreparedShape& suspect, const CompareOptions& options = {},
                   const Progress& progress = {});

}  // namespace umbilic
