// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <report/json.h>

namespace umbilic {

/// One thing that could have been set otherwise, as it was used.
struct Parameter {
    std::string name;  ///< also the name of the command-line option
    Json value;        ///< number or word
    std::string unit;  ///< "mm", "1/mm", "rad", "1", or empty for words
    ToleranceOrigin origin = ToleranceOrigin::fixed_default;
    std::string meaning;  ///< the inequality it enters, or what it chooses
};

/// Parameters of a search for the pose, for options as match() got them. An option counts as the user's where it
/// differs from its default.
std::vector<Parameter> match_parameters(const FeatureOptions& features, const MatchOptions& options,
                                        const Alignment& alignment);

/// Adds those of measured points.
void add_point_parameters(const PointFeatureOptions& options, std::vector<Parameter>& parameters);

/// Parameters of a whole comparison: those of the match, the decision and every tolerance of the tests.
std::vector<Parameter> compare_parameters(const CompareOptions& options, const Comparison& comparison);

/// { NAME: { value, unit, origin, meaning } }.
Json parameters_json(const std::vector<Parameter>& parameters);

}  // namespace umbilic
