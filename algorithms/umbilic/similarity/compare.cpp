// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/compare.h>

#include <chrono>

#include <tbb/parallel_invoke.h>

#include <umbilic/similarity/assess.h>

namespace umbilic {

Comparison compare(const PreparedModel& original, const PreparedModel& suspect, const CompareOptions& options,
                   const Progress& progress) {
    Comparison result;
    const auto timed = [&](const char* stage, const auto& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        result.timing.emplace_back(stage,
                                   std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    };
    // Wrong choices must not be found out after minutes of matching.
    result.assessment.tolerances = derive_tolerances(original.model.size(), 0.0, options.tolerances);
    MatchOptions match_options = options.match;
    if (!match_options.tolerance) match_options.tolerance = options.tolerances.distance;

    timed("match", [&] { result.alignment = match(original, suspect, match_options, progress.part(0.0, 0.6)); });
    if (result.alignment.status != AlignmentStatus::not_found) {
        AssessedNodes nodes;
        timed("nodes", [&] {
            const auto of = [&](const PreparedModel& model, const Progress& part) {
                return options.nodes == NodeChoice::wireframe
                           ? wireframe_nodes(model, options.features.samples.count, part)
                           : area_nodes(model);
            };
            tbb::parallel_invoke([&] { nodes.original = of(original, progress.part(0.6, 0.65)); },
                                 [&] { nodes.suspect = of(suspect, progress.part(0.65, 0.7)); });
        });
        timed("assess", [&] {
            result.assessment =
                assess(original, suspect, nodes, result.alignment, options.tolerances, progress.part(0.7, 1.0));
        });
    }
    timed("decide", [&] {
        result.verdict = decide(result.alignment, result.assessment, options.algorithm);
        result.answer = answer(original.model, suspect.model, result.alignment, result.assessment, result.verdict);
    });
    return result;
}

}  // namespace umbilic
