// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/json.h>

#include <report/json_geometry.h>
#include <report/parameters.h>

namespace umbilic {

namespace {

Json transform_json(const SimilarityTransform& transform) {
    Json rotation = Json::array();
    for (int row = 0; row < 3; ++row) rotation.push_back(vector_json(transform.rotation.row(row)));
    return {{"mirrored", transform.mirrored},
            {"scale", number_json(transform.scale)},
            {"rotation", std::move(rotation)},
            {"translation", vector_json(transform.translation)}};
}

Json statistics_json(const Statistics& statistics) {
    const auto known = [&](double value) { return statistics.count > 0 ? number_json(value) : Json(nullptr); };
    return {{"max", known(statistics.max)},
            {"mean", known(statistics.mean)},
            {"std", known(statistics.standard_deviation)},
            {"count", statistics.count}};
}

Json directed_json(const DirectedComparison& comparison) {
    return {{"distance", statistics_json(comparison.distance)},   {"kappa_max", statistics_json(comparison.kappa_max)},
            {"kappa_min", statistics_json(comparison.kappa_min)}, {"direction", statistics_json(comparison.direction)},
            {"coverage", number_json(comparison.coverage)},       {"nodes", comparison.nodes.size()}};
}

Json strong_json(const PreparedShape& original, const PreparedShape& suspect, const StrongTest& strong) {
    const auto umbilics = [](const PreparedShape& prepared) {
        Json json = Json::array();
        for (const auto& [face, umbilic] : isolated_umbilics(prepared)) {
            json.push_back({{"face", face->number}});
            json.back().update(umbilic_json(*face, *umbilic));
        }
        return json;
    };
    Json pairs = Json::array();
    for (const UmbilicPair& pair : strong.pairs) {
        pairs.push_back({{"original", pair.original},
                         {"suspect", pair.suspect},
                         {"type", name(pair.type)},
                         {"distance", number_json(pair.distance)}});
    }
    return {{"passed", strong.passed ? Json(*strong.passed) : Json(nullptr)},
            {"why", strong.why},
            {"pairs", std::move(pairs)},
            {"unmatched", {{"original", strong.unmatched_original}, {"suspect", strong.unmatched_suspect}}},
            {"umbilics", {{"original", umbilics(original)}, {"suspect", umbilics(suspect)}}}};
}

Json tests_json(const PreparedShape& original, const PreparedShape& suspect, const Assessment& assessment) {
    const DirectedComparison& forward = assessment.suspect_on_original;
    const bool assessed = !forward.nodes.empty();
    return {{"weak",
             {{"passed", assessment.weak_passed},
              {"tolerance", assessed ? number_json(assessment.distance.tolerance) : Json(nullptr)},
              {"distance", statistics_json(forward.distance)}}},
            {"intermediate",
             {{"passed", assessment.intermediate_why.empty() ? Json(assessment.intermediate_passed) : Json(nullptr)},
              {"why", assessment.intermediate_why},
              {"kappa_max", statistics_json(forward.kappa_max)},
              {"kappa_min", statistics_json(forward.kappa_min)},
              {"direction", statistics_json(forward.direction)}}},
            {"strong", strong_json(original, suspect, assessment.strong)},
            {"suspect_on_original", directed_json(forward)},
            {"original_on_suspect", directed_json(assessment.original_on_suspect)}};
}

Json similarity_json(const Assessment& assessment) {
    const bool assessed = !assessment.suspect_on_original.nodes.empty();
    const auto known = [&](double value) { return assessed ? number_json(value) : Json(nullptr); };
    const auto local = [&](const LocalSimilarity& similarity) -> Json {
        return {{"tolerance", known(similarity.tolerance)},
                {"percent", known(similarity.percent)},
                {"cell_percent", known(similarity.cell_percent)},
                {"cells", similarity.cells},
                {"marked", similarity.marked}};
    };
    return {{"cell", known(assessment.cell)},
            {"distance", local(assessment.distance)},
            {"kappa_max", local(assessment.kappa_max)},
            {"kappa_min", local(assessment.kappa_min)},
            {"direction", local(assessment.direction)}};
}

/// How many nodes each model was compared at, by where they come from.
Json nodes_json(const Assessment& assessment) {
    const auto counts = [](const DirectedComparison& comparison) -> Json {
        return {{"wireframe", comparison.of_wireframe},
                {"area", static_cast<int>(comparison.nodes.size()) - comparison.of_wireframe}};
    };
    return {{"original", counts(assessment.original_on_suspect)}, {"suspect", counts(assessment.suspect_on_original)}};
}

Json coverage_json(const Alignment& alignment, const Assessment& assessment) {
    const bool assessed = !assessment.suspect_on_original.nodes.empty();
    Json faces = Json::array();
    for (const FaceCoverage& face : assessment.faces) {
        faces.push_back({{"suspect_face", face.suspect_face},
                         {"original_face", face.original_face > 0 ? Json(face.original_face) : Json(nullptr)},
                         {"fraction", number_json(face.fraction)},
                         {"level", face.level}});
    }
    return {
        {"suspect_area", number_json(assessed ? assessment.suspect_on_original.coverage : alignment.suspect_coverage)},
        {"original_area",
         number_json(assessed ? assessment.original_on_suspect.coverage : alignment.original_coverage)},
        {"faces", std::move(faces)}};
}

Json decision_json(const Decision& decision) {
    Json path = Json::array();
    for (const DecisionStep& step : decision.path) {
        path.push_back({{"question", step.question}, {"answer", step.answer}});
    }
    return {{"level", name(decision.level)}, {"path", std::move(path)}};
}

Json verdict_json(const Verdict& verdict) {
    return {
        {"level", name(verdict.level)},
        {"derived", verdict.derived},
        {"chosen_algorithm", verdict.chosen_algorithm},
        {"algorithm_1", name(verdict.algorithm_1.level)},
        {"algorithm_2", name(verdict.algorithm_2.level)},
        {"explanation", verdict.explanation},
        {"decisions",
         {{"algorithm_1", decision_json(verdict.algorithm_1)}, {"algorithm_2", decision_json(verdict.algorithm_2)}}}};
}

}  // namespace

Json alignment_json(const Alignment& alignment) {
    const bool posed = alignment.status != AlignmentStatus::not_found;
    const auto known = [&](double value) { return posed ? number_json(value) : Json(nullptr); };
    Json json = {{"found", alignment.found()},
                 {"status", name(alignment.status)},
                 {"why", alignment.why},
                 {"method", name(alignment.method)},
                 {"scope", name(alignment.scope)}};
    const Json transform = transform_json(alignment.original_suspect);
    for (const auto& [key, value] : transform.items()) json[key] = posed || key == "mirrored" ? value : Json(nullptr);
    json["tolerance"] = number_json(alignment.tolerance);
    json["rms"] = known(alignment.rms);
    json["max"] = known(alignment.max);
    json["relative_max"] = known(alignment.relative_max);
    json["scale_deviation"] = alignment.scale_deviation > 0.0 ? known(alignment.scale_deviation) : Json(nullptr);
    json["suspect_coverage"] = number_json(alignment.suspect_coverage);
    json["original_coverage"] = number_json(alignment.original_coverage);
    json["candidates"] = Json::array();
    for (const PoseCandidate& candidate : alignment.runners_up) {
        Json entry = {{"method", name(candidate.method)},
                      {"score", number_json(candidate.score)},
                      {"original_score", number_json(candidate.original_score)},
                      {"rms", number_json(candidate.rms)},
                      {"max", number_json(candidate.max)}};
        entry.update(transform_json(candidate.original_suspect));
        json["candidates"].push_back(std::move(entry));
    }
    json["symmetries"] = Json::array();
    for (const SimilarityTransform& pose : alignment.symmetries) json["symmetries"].push_back(transform_json(pose));
    json["copies"] = Json::array();
    for (const SimilarityTransform& pose : alignment.copies) json["copies"].push_back(transform_json(pose));
    json["free_motions"] = Json::array();
    for (const FreeMotion& motion : alignment.free_motions) {
        Json entry = {{"kind", name(motion.kind)}, {"point", vector_json(motion.point)}};
        entry["direction"] = motion.direction.isZero() ? Json(nullptr) : vector_json(motion.direction);
        if (motion.pitch != 0.0) entry["pitch"] = number_json(motion.pitch);
        json["free_motions"].push_back(std::move(entry));
    }
    json["pairs"] = Json::array();
    for (const GivenPair& pair : alignment.given_pairs)
        json["pairs"].push_back({{"residual", number_json(pair.residual)}, {"outlier", pair.outlier}});
    return json;
}

Json match_json(const PreparedShape& original, const PreparedShape& suspect, const CompareOptions& options,
                const Alignment& alignment, const Timing& timing) {
    std::vector<Parameter> parameters = match_parameters(options.features, options.match, alignment);
    if (suspect.points()) add_point_parameters(options.points, parameters);
    return {{"schema", "umbilic.match/1"},
            {"tool", tool_json()},
            {"inputs", {{"original", input_json(original)}, {"suspect", input_json(suspect)}}},
            {"parameters", parameters_json(parameters)},
            {"alignment", alignment_json(alignment)},
            {"timing", timing_json(timing)}};
}

Json compare_json(const PreparedShape& original, const PreparedShape& suspect, const CompareOptions& options,
                  const Comparison& comparison, const Timing& timing) {
    Timing stages = timing;
    stages.insert(stages.end(), comparison.timing.begin(), comparison.timing.end());
    return {{"schema", "umbilic.compare/1"},
            {"tool", tool_json()},
            {"inputs", {{"original", input_json(original)}, {"suspect", input_json(suspect)}}},
            {"parameters", parameters_json(compare_parameters(options, comparison))},
            {"alignment", alignment_json(comparison.alignment)},
            {"tests", tests_json(original, suspect, comparison.assessment)},
            {"nodes", nodes_json(comparison.assessment)},
            {"similarity", similarity_json(comparison.assessment)},
            {"coverage", coverage_json(comparison.alignment, comparison.assessment)},
            {"answer", {{"class", name(comparison.answer.kind)}, {"text", comparison.answer.text}}},
            {"verdict", verdict_json(comparison.verdict)},
            {"timing", timing_json(stages)}};
}

}  // namespace umbilic
