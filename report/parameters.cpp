// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/parameters.h>

#include <umbilic/matching/choice_words.h>

namespace umbilic {

namespace {

/// Parameter whose default is a constant of the program.
template <typename Value>
Parameter constant(std::string name, const Value& value, const Value& default_value, std::string unit,
                   std::string meaning) {
    return {std::move(name), value, std::move(unit),
            value == default_value ? ToleranceOrigin::fixed_default : ToleranceOrigin::user, std::move(meaning)};
}

template <class Choice>
Parameter chosen(std::string name, const ChoiceWords<Choice>& words, Choice value, Choice default_value,
                 std::string meaning) {
    return constant(std::move(name), word_of(words, value), word_of(words, default_value), "", std::move(meaning));
}

std::string word(const ScaleChoice& choice) {
    switch (choice.kind) {
        case ScaleChoice::Kind::automatic:
            return "auto";
        case ScaleChoice::Kind::fixed:
            return "fixed";
        case ScaleChoice::Kind::range:
            return number_json(choice.low).dump() + ":" + number_json(choice.high).dump();
    }
    return "auto";
}

}  // namespace

std::vector<Parameter> match_parameters(const FeatureOptions& features, const MatchOptions& options,
                                        const Alignment& alignment) {
    const FeatureOptions feature_defaults;
    const MatchOptions defaults;
    const auto& search = features.umbilics;
    const auto& search_defaults = feature_defaults.umbilics;
    std::vector<Parameter> parameters;
    parameters.push_back(chosen("method", method_words, options.method, defaults.method, "how poses are proposed"));
    parameters.push_back(
        constant("scale", word(options.scale), word(defaults.scale), "", "what is known of the scale"));
    if (options.method == MethodChoice::kh)
        parameters.push_back(chosen("scale_search", scale_search_words, options.scale_search, defaults.scale_search,
                                    "how the method kh searches a scale that is not fixed"));
    if (options.method == MethodChoice::kh || options.method == MethodChoice::umbilic_kh)
        parameters.push_back(chosen("kh_solver", curvature_solver_words, options.curvature_solver,
                                    defaults.curvature_solver, "how points of given curvatures are found"));
    parameters.push_back(
        chosen("mirror", mirror_words, options.mirror, defaults.mirror, "whether mirror images are tried"));
    parameters.push_back(chosen("scope", scope_words, options.scope, defaults.scope, "whole models or parts of them"));
    if (options.initial) {
        parameters.push_back({"initial", "given", "", ToleranceOrigin::user, "a pose to start from"});
    }
    if (!options.pairs.empty()) {
        parameters.push_back(
            {"pairs", options.pairs.size(), "1", ToleranceOrigin::user, "number of known corresponding points"});
    }
    if (options.seconds)
        parameters.push_back({"match_seconds", *options.seconds, "s", ToleranceOrigin::user,
                              "no further pose is tried once the search takes longer"});
    parameters.push_back({"match_tolerance", number_json(alignment.tolerance), "mm",
                          options.tolerance ? ToleranceOrigin::user : ToleranceOrigin::derived,
                          "a sample lies on the other model if its distance <= match_tolerance"});
    parameters.push_back(constant(
        "umbilic_invariant_tolerance", options.umbilic_invariant_tolerance, defaults.umbilic_invariant_tolerance, "1",
        "two umbilics may correspond if their (delta, zeta) differ by <= umbilic_invariant_tolerance"));
    parameters.push_back(constant("samples", features.samples.count, feature_defaults.samples.count, "1",
                                  "points spread over each model by area"));
    parameters.push_back(constant("seed", features.samples.seed, feature_defaults.samples.seed, "1",
                                  "start of the sequence that spreads the points"));
    parameters.push_back(constant("umbilic_resolution", search.resolution, search_defaults.resolution, "1",
                                  "a box of the search is split until it is decided or its side relative to the domain "
                                  "is <= umbilic_resolution"));
    parameters.push_back(constant("umbilic_boxes", search.boxes_per_patch, search_defaults.boxes_per_patch, "1",
                                  "boxes of the search per Bezier patch <= umbilic_boxes"));
    parameters.push_back(constant("umbilic_margin", search.generic_margin, search_defaults.generic_margin, "1",
                                  "relative error assumed of a cubic form on top of rounding: an umbilic is "
                                  "non-generic if a form within its error has another type"));
    parameters.push_back(constant("umbilic_accuracy", search.accuracy, search_defaults.accuracy, "mm",
                                  "displacement of the surfaces' control points whose effect on the cubic forms is "
                                  "counted as their error, on top of rounding and conversion"));
    parameters.push_back(constant("umbilic_recognition", search.recognition, search_defaults.recognition, "1",
                                  "a NURBS face is umbilic everywhere if its distance from a plane or sphere, relative "
                                  "to its size, is <= umbilic_recognition"));
    return parameters;
}

void add_point_parameters(const PointFeatureOptions& options, std::vector<Parameter>& parameters) {
    const PointFeatureOptions defaults;
    parameters.push_back(constant("most_points", options.most_points, defaults.most_points, "1",
                                  "points of a larger cloud that are used, chosen at random"));
    parameters.push_back(constant("point_samples", options.samples, defaults.samples, "1",
                                  "points of a cloud at which jets are fitted and distances are measured"));
}

std::vector<Parameter> compare_parameters(const CompareOptions& options, const Comparison& comparison) {
    MatchOptions match_options = options.match;
    if (!match_options.tolerance) match_options.tolerance = options.tolerances.distance;  // as compare() does
    auto parameters = match_parameters(options.features, match_options, comparison.alignment);
    parameters.push_back(constant("nodes", std::string(name(options.nodes)), std::string(name(CompareOptions().nodes)),
                                  "",
                                  "where the models are compared; faces whose wireframe is too small or incomplete "
                                  "are compared at samples uniform by area"));
    parameters.push_back(constant("algorithm", options.algorithm, CompareOptions().algorithm, "1",
                                  "decision algorithm that gives the level of the verdict"));
    if (comparison.assessment.measured) add_point_parameters(options.points, parameters);
    for (const Tolerance& tolerance : comparison.assessment.tolerances) {
        parameters.push_back(
            {tolerance.name, number_json(tolerance.value), tolerance.unit, tolerance.origin, tolerance.inequality});
    }
    return parameters;
}

Json parameters_json(const std::vector<Parameter>& parameters) {
    Json json = Json::object();
    for (const Parameter& parameter : parameters) {
        json[parameter.name] = {{"value", parameter.value},
                                {"unit", parameter.unit},
                                {"origin", name(parameter.origin)},
                                {"meaning", parameter.meaning}};
    }
    return json;
}

}  // namespace umbilic
