// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/thresholds.h>

#include <algorithm>
#include <utility>

#include <umbilic/similarity/statistics.h>

namespace umbilic {

namespace {

bool curvatures_agree(const DirectedComparison& direction, const Assessment& assessment) {
    const double kappa = find_tolerance(assessment.tolerances, "kappa").value;
    return comparable(direction) && within_thresholds(direction.kappa_max, kappa) &&
           within_thresholds(direction.kappa_min, kappa) &&
           (direction.direction.count == 0 ||
            within_thresholds(direction.direction, find_tolerance(assessment.tolerances, "direction").value));
}

const DirectedComparison& better_covered(const Assessment& assessment) {
    const DirectedComparison& suspect = assessment.suspect_on_original;
    const DirectedComparison& original = assessment.original_on_suspect;
    if (assessment.measured) return suspect;
    return std::pair(original.overlap, original.coverage) > std::pair(suspect.overlap, suspect.coverage) ? original
                                                                                                         : suspect;
}

}  // namespace

bool within_thresholds(const Statistics& statistics, double tolerance) {
    return statistics.count > 0 && statistics.mean <= tolerance &&
           statistics.mean + 2.0 * statistics.standard_deviation <= spread_factor * tolerance;
}

bool within_maximum(const Statistics& statistics, double tolerance) {
    return statistics.count > 0 && statistics.max <= tolerance;
}

std::vector<const DirectedComparison*> deciding_directions(const Assessment& assessment) {
    if (assessment.scope == MatchScope::partial || assessment.measured) return {&better_covered(assessment)};
    return {&assessment.suspect_on_original, &assessment.original_on_suspect};
}

double needed_share(const Assessment& assessment) {
    return assessment.measured ? measured_share : whole_share;
}

bool comparable(const DirectedComparison& direction) {
    return direction.kappa_max.count > 0 && direction.kappa_max.count >= comparable_share * direction.distance.count;
}

bool passes_weak(const Assessment& assessment) {
    const double distance = find_tolerance(assessment.tolerances, "distance").value;
    return std::ranges::all_of(deciding_directions(assessment), [&](const DirectedComparison* direction) {
        const bool asked = assessment.scope == MatchScope::partial || assessment.measured;
        if (asked && direction->overlap < needed_share(assessment)) return false;
        return within_thresholds(direction->distance, distance);
    });
}

bool passes_intermediate(const Assessment& assessment) {
    return std::ranges::all_of(deciding_directions(assessment), [&](const DirectedComparison* direction) {
        return curvatures_agree(*direction, assessment);
    });
}

bool part_coincides(const Assessment& assessment) {
    const double distance = find_tolerance(assessment.tolerances, "distance").value;
    const double limit = spread_factor * distance;
    DirectedComparison part = better_covered(assessment);
    part.distance = statistics(part.nodes, Quantity::distance, limit);
    part.kappa_max = statistics(part.nodes, Quantity::kappa_max, limit);
    part.kappa_min = statistics(part.nodes, Quantity::kappa_min, limit);
    part.direction = statistics(part.nodes, Quantity::direction, limit);
    return part.coverage >= least_part && within_thresholds(part.distance, distance) &&
           part.distance.mean <= partial_mean * distance && curvatures_agree(part, assessment);
}

}  // namespace umbilic
