// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/verdict.h>

#include <algorithm>
#include <string_view>

#include <umbilic/core/errors.h>
#include <umbilic/similarity/thresholds.h>
#include <umbilic/similarity/wording.h>

namespace umbilic {

namespace {

using Directions = std::vector<const DirectedComparison*>;

/// Adds the step to the path and returns its answer.
bool ask(Decision& decision, std::string question, bool answer) {
    decision.path.push_back({std::move(question), answer});
    return answer;
}

/// The direction in which a quantity is largest, by a number of its statistics.
Statistics worst(const Directions& directions, Statistics DirectedComparison::*quantity, double Statistics::*number) {
    Statistics result = directions.front()->*quantity;
    for (const DirectedComparison* direction : directions)
        if ((direction->*quantity).*number > result.*number) result = direction->*quantity;
    return result;
}

std::string with_unit(double value, const Tolerance& tolerance) {
    return in_digits(value) + " " + tolerance.unit;
}

struct QuantityTest {
    const char* words;
    Statistics DirectedComparison::*statistics;
    const char* tolerance;
};

constexpr QuantityTest distance_test = {"distance", &DirectedComparison::distance, "distance"};
constexpr QuantityTest intermediate_tests[] = {
    {"difference of the greater principal curvatures", &DirectedComparison::kappa_max, "kappa"},
    {"difference of the smaller principal curvatures", &DirectedComparison::kappa_min, "kappa"},
    {"angle between the principal directions", &DirectedComparison::direction, "direction"},
};

/// One box of Fig. 5-1: the maximum against a tolerance; if it fails, the tolerance may be raised once, unless the user
/// has set it: by spread_factor, which for the distance is still small beside the model's size.
bool passes_by_maximum(Decision& decision, const QuantityTest& test, const Assessment& assessment) {
    const Directions directions = deciding_directions(assessment);
    const Tolerance& tolerance = find_tolerance(assessment.tolerances, test.tolerance);
    const Statistics statistics = worst(directions, test.statistics, &Statistics::max);
    const auto within = [&](double limit) {
        return ask(decision,
                   std::string("Is the largest ") + test.words + ", " + with_unit(statistics.max, tolerance) +
                       ", within " + with_unit(limit, tolerance) + "?",
                   within_maximum(statistics, limit));
    };
    if (within(tolerance.value)) return true;
    const bool may_grow =
        ask(decision, std::string("May the tolerance be raised, as it was not set by the user and stays small?"),
            tolerance.origin != ToleranceOrigin::user);
    return may_grow && within(spread_factor * tolerance.value);
}

bool passes_by_statistics(Decision& decision, const QuantityTest& test, const Assessment& assessment) {
    const Tolerance& tolerance = find_tolerance(assessment.tolerances, test.tolerance);
    return std::ranges::all_of(deciding_directions(assessment), [&](const DirectedComparison* direction) {
        const Statistics& statistics = direction->*test.statistics;
        // Directions may be undefined everywhere, as on planes and spheres: then there is no question.
        if (test.statistics == &DirectedComparison::direction && statistics.count == 0) return true;
        const char* whose = direction == &assessment.suspect_on_original ? "suspect" : "original";
        return ask(decision,
                   std::string("Over the ") + whose + "'s nodes, are mean and spread of the " + test.words + " (mean " +
                       with_unit(statistics.mean, tolerance) + ", standard deviation " +
                       with_unit(statistics.standard_deviation, tolerance) + ") within the thresholds for " +
                       with_unit(tolerance.value, tolerance) + "?",
                   within_thresholds(statistics, tolerance.value));
    });
}

/// What both figures share: can curvatures be compared at all?
bool ask_comparable(Decision& decision, const Assessment& assessment) {
    return ask(decision, "Can curvatures be compared on at least half of the nodes?",
               std::ranges::all_of(deciding_directions(assessment),
                                   [](const DirectedComparison* direction) { return comparable(*direction); }));
}

/// The last two boxes of both figures: without an isolated generic umbilic the process ends at `intermediate`.
Level strong_or_intermediate(Decision& decision, const StrongTest& strong) {
    if (!ask(decision, "Are there isolated generic umbilics to compare?", strong.passed.has_value()))
        return Level::intermediate;
    double sum = 0.0, max = 0.0;
    for (const UmbilicPair& pair : strong.pairs) {
        sum += pair.distance;
        max = std::max(max, pair.distance);
    }
    std::string numbers = std::to_string(strong.pairs.size()) + " pairs";
    if (!strong.pairs.empty())
        numbers += ", mean distance " + in_mm(sum / strong.pairs.size()) + ", largest " + in_mm(max);
    numbers += ", " + std::to_string(strong.unmatched_original.size() + strong.unmatched_suspect.size()) + " unmatched";
    return ask(decision, "Do their places and types agree (" + numbers + ")?", *strong.passed) ? Level::strong
                                                                                               : Level::intermediate;
}

/// Under partial scope, and of measured points, the tests are made on the model of which more lies on the other one:
/// does it as a whole?
bool ask_whole(Decision& decision, const Assessment& assessment) {
    if (assessment.scope == MatchScope::global && !assessment.measured) return true;
    const DirectedComparison& direction = *deciding_directions(assessment).front();
    const char* whose = &direction == &assessment.suspect_on_original ? "suspect" : "original";
    return ask(decision,
               std::string("Does the whole ") + whose + " lie on the other model (" + in_percent(direction.overlap) +
                   " of its surface)?",
               direction.overlap >= needed_share(assessment));
}

std::string level_in_words(Level level) {
    switch (level) {
        case Level::none:
            return "no test";
        case Level::weak:
            return "the weak test (places)";
        case Level::intermediate:
            return "the weak and intermediate tests (places and curvatures)";
        case Level::strong:
            return "the weak, intermediate and strong tests (places, curvatures and umbilical points)";
    }
    return "";
}

/// The sentence of the matching stage, to be put into another one.
std::string as_clause(std::string sentence) {
    while (!sentence.empty() && sentence.back() == '.') sentence.pop_back();
    return sentence;
}

std::string explanation(const Alignment& alignment, const Assessment& assessment, const Verdict& verdict) {
    const std::string why = as_clause(alignment.why);
    if (alignment.status == AlignmentStatus::not_found)
        return "Nothing shows that the suspect is derived from the original, because no position of it fits: " + why +
               ".";
    const std::string evidence =
        "within " + in_mm(find_tolerance(assessment.tolerances, "distance").value) + ", " +
        in_percent(assessment.suspect_on_original.coverage) + " of the suspect's surface lies on the original and " +
        in_percent(assessment.original_on_suspect.coverage) + " of the original's on the suspect";
    if (alignment.status == AlignmentStatus::compatible)
        return "The suspect can be laid on the original (" + evidence +
               "), but that does not show that it is derived: " + why + ".";
    std::string result;
    if (verdict.derived)
        result = "The suspect is derived from the original as far as " + level_in_words(verdict.level) +
                 " can tell: " + evidence + "; umbilical points: " + assessment.strong.why;
    else if (part_coincides(assessment))
        result =
            "As a whole the suspect does not pass the weak test, but a part of it coincides with the original in "
            "place and curvature: " +
            evidence;
    else
        result =
            "Nothing shows that the suspect is derived from the original: the weak test is not passed; " + evidence;
    if (alignment.status == AlignmentStatus::ambiguous) result += "; several positions fit (" + why + ")";
    return result + ".";
}

Decision no_pose() {
    Decision decision;
    ask(decision, "Was a position of the suspect on the original found that is evidence?", false);
    return decision;
}

}  // namespace

Decision decide_by_maxima(const Assessment& assessment) {
    Decision decision;
    if (!ask_whole(decision, assessment)) return decision;
    if (!passes_by_maximum(decision, distance_test, assessment)) return decision;
    decision.level = Level::weak;
    if (!ask_comparable(decision, assessment)) return decision;
    const bool agree = std::ranges::all_of(intermediate_tests, [&](const QuantityTest& test) {
        const bool defined = std::ranges::any_of(
            deciding_directions(assessment),
            [&](const DirectedComparison* direction) { return (direction->*test.statistics).count > 0; });
        return !defined || passes_by_maximum(decision, test, assessment);
    });
    if (agree) decision.level = strong_or_intermediate(decision, assessment.strong);
    return decision;
}

Decision decide_by_statistics(const Assessment& assessment) {
    Decision decision;
    if (!ask_whole(decision, assessment)) return decision;
    if (!passes_by_statistics(decision, distance_test, assessment)) return decision;
    decision.level = Level::weak;
    if (!ask_comparable(decision, assessment)) return decision;
    const bool agree = std::ranges::all_of(
        intermediate_tests, [&](const QuantityTest& test) { return passes_by_statistics(decision, test, assessment); });
    if (agree) decision.level = strong_or_intermediate(decision, assessment.strong);
    return decision;
}

Verdict decide(const Alignment& alignment, const Assessment& assessment, int algorithm) {
    if (algorithm != 1 && algorithm != 2)
        throw InvalidInput("there is no decision algorithm " + std::to_string(algorithm) + ": choose 1 or 2");
    const bool evidence = alignment.status == AlignmentStatus::found || alignment.status == AlignmentStatus::ambiguous;
    Verdict verdict;
    verdict.algorithm_1 = evidence ? decide_by_maxima(assessment) : no_pose();
    verdict.algorithm_2 = evidence ? decide_by_statistics(assessment) : no_pose();
    verdict.chosen_algorithm = algorithm;
    verdict.level = algorithm == 1 ? verdict.algorithm_1.level : verdict.algorithm_2.level;
    verdict.derived = verdict.level != Level::none;
    verdict.explanation = explanation(alignment, assessment, verdict);
    return verdict;
}

const char* name(Level level) {
    switch (level) {
        case Level::none:
            return "none";
        case Level::weak:
            return "weak";
        case Level::intermediate:
            return "intermediate";
        case Level::strong:
            return "strong";
    }
    return "none";
}

}  // namespace umbilic
