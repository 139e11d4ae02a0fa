// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/compare.h>

#include <chrono>

#include <umbilic/similarity/assess.h>
#include <umbilic/similarity/assess_points.h>

namespace umbilic {

namespace {

Assessment assessed(const PreparedShape& original, const PreparedShape& suspect, const Alignment& alignment,
                    const CompareOptions& options, const Progress& progress) {
    return suspect.points() ? assess(original, *suspect.points(), alignment, options.tolerances, progress)
                            : assess(*original.model(), *suspect.model(), alignment, options.tolerances, progress);
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
    if (result.alignment.status != AlignmentStatus::not_found)
        timed("assess", [&] {
            result.assessment = assessed(original, suspect, result.alignment, options, progress.part(0.6, 1.0));
        });
    timed("decide", [&] {
        result.verdict = decide(result.alignment, result.assessment, options.algorithm);
        result.answer = answered(original, suspect, result);
    });
    return result;
}

}  // namespace umbilic
