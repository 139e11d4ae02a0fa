// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/compare.h>

#include <chrono>

#include <tbb/parallel_invoke.h>

#include <umbilic/similarity/assess.h>
#include <umbilic/similarity/assess_points.h>

namespace umbilic {

namespace {

/// Where two models are compared; measured points are compared at themselves.
AssessedNodes nodes_of(const PreparedShape& original, const PreparedShape& suspect, const CompareOptions& options,
                       const Progress& progress) {
    AssessedNodes nodes;
    if (!original.model() || !suspect.model()) return nodes;
    const auto of = [&](const PreparedModel& model, const Progress& part) {
        return options.nodes == NodeChoice::wireframe ? wireframe_nodes(model, options.features.samples.count, part)
                                                      : area_nodes(model);
    };
    tbb::parallel_invoke([&] { nodes.original = of(*original.model(), progress.part(0.0, 0.5)); },
                         [&] { nodes.suspect = of(*suspect.model(), progress.part(0.5, 1.0)); });
    return nodes;
}

Assessment assessed(const PreparedShape& original, const PreparedShape& suspect, const AssessedNodes& nodes,
                    const Alignment& alignment, const CompareOptions& options, const Progress& progress) {
    return suspect.points()
               ? assess(original, *suspect.points(), alignment, options.tolerances, progress)
               : assess(*original.model(), *suspect.model(), nodes, alignment, options.tolerances, progress);
}

Answer answered(const PreparedShape& original, const PreparedShape& suspect, const Comparison& comparison) {
    return suspect.points() ? answer(*suspect.points(), comparison.alignment, comparison.assessment)
                            : answer(original.model()->model, suspect.model()->model, comparison.alignment,
                                     comparison.assessment, comparison.verdict);
}

}  // namespace

Comparison compare(const PreparedModel& original, const PreparedModel& suspect, const CompareOptions& options,
                   const Progress& progress) {
    return compare(PreparedShape(original), PreparedShape(suspect), options, progress);
}

Comparison compare(const PreparedShape& original, const PreparedShape& suspect, const CompareOptions& options,
                   const Progress& progress) {
    if (original.points() && suspect.model()) refuse_points_as_original(original);
    Comparison result;
    const auto timed = [&](const char* stage, const auto& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        result.timing.emplace_back(stage,
                                   std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    };
    // Wrong choices must not be found out after minutes of matching.
    result.assessment.tolerances = derive_tolerances(original.size(), 0.0, options.tolerances);
    result.assessment.measured = suspect.points() != nullptr;
    MatchOptions match_options = options.match;
    if (!match_options.tolerance) match_options.tolerance = options.tolerances.distance;

    timed("match", [&] { result.alignment = match(original, suspect, match_options, progress.part(0.0, 0.6)); });
    if (result.alignment.status != AlignmentStatus::not_found) {
        AssessedNodes nodes;
        timed("nodes", [&] { nodes = nodes_of(original, suspect, options, progress.part(0.6, 0.7)); });
        timed("assess", [&] {
            result.assessment = assessed(original, suspect, nodes, result.alignment, options, progress.part(0.7, 1.0));
        });
    }
    timed("decide", [&] {
        result.verdict = decide(result.alignment, result.assessment, options.algorithm);
        result.answer = answered(original, suspect, result);
    });
    return result;
}

}  // namespace umbilic
