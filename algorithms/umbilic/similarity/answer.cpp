// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>

#include <umbilic/similarity/control_nets.h>
#include <umbilic/similarity/pose_changes.h>
#include <umbilic/similarity/thresholds.h>
#include <umbilic/similarity/verdict.h>
#include <umbilic/similarity/wording.h>

namespace umbilic {

namespace {

double largest_distance(const DirectedComparison& direction) {
    double result = 0.0;
    for (const NodeComparison& node : direction.nodes) result = std::max(result, node.distance);
    return result;
}

AnswerClass class_of_whole_copy(const PoseChanges& changes, bool exact) {
    if (!exact) return AnswerClass::reapproximated;
    if (changes.mirrored) return AnswerClass::mirrored;
    if (changes.scaled) return AnswerClass::scaled;
    return changes.moved ? AnswerClass::moved : AnswerClass::same;
}

/// "; 2 more copies of the original stand elsewhere in the suspect", if so.
std::string further_copies(const Alignment& alignment, AnswerClass kind) {
    if (alignment.copies.size() < 2) return "";
    const std::size_t more = alignment.copies.size() - 1;
    const std::string count = std::to_string(more) + " more ";
    if (kind == AnswerClass::contains)
        return "; " + count + (more == 1 ? "copy of it stands" : "copies of it stand") + " elsewhere in the suspect";
    if (kind == AnswerClass::piece)
        return "; it fits as well at " + count + (more == 1 ? "place" : "places") + " of the original";
    return "";
}

}  // namespace

Answer answer(const Model& original, const Model& suspect, const Alignment& alignment, const Assessment& assessment,
              const Verdict& verdict) {
    if (alignment.status == AlignmentStatus::not_found) return no_pose(alignment);

    const DirectedComparison& on_original = assessment.suspect_on_original;
    const DirectedComparison& on_suspect = assessment.original_on_suspect;
    const double tolerance = find_tolerance(assessment.tolerances, "distance").value;
    const double exact_distance = find_tolerance(assessment.tolerances, "exact-distance").value;
    const bool suspect_whole = on_original.overlap >= 1.0;
    const bool original_whole = on_suspect.overlap >= 1.0;
    const std::string suspect_share = in_percent(on_original.coverage);
    const std::string original_share = in_percent(on_suspect.coverage);

    const bool passed = verdict.level != Level::none;
    if (!suspect_whole && !original_whole && !passed && !part_coincides(assessment))
        return {AnswerClass::different, "different: in the best position found " + suspect_share +
                                            " of the suspect's area comes within " + in_mm(tolerance) +
                                            " of the original, no more than unrelated shapes may"};

    const double deviation = std::max(suspect_whole ? largest_distance(on_original) : 0.0,
                                      original_whole ? largest_distance(on_suspect) : 0.0);
    const bool whole = suspect_whole || original_whole;
    const bool exact = whole && deviation <= exact_distance;

    // What a deviation makes of scale and place is no change of them: over the model both grow to about twice as much.
    const double pose_tolerance = exact ? exact_distance : std::max(tolerance, 2.0 * deviation);
    const SimilarityTransform pose = plainest_pose(alignment, suspect.box, pose_tolerance);
    const PoseChanges changes = pose_changes(pose, suspect.box, pose_tolerance);
    const ControlNets nets =
        exact ? compare_control_nets(original, suspect, alignment.original_suspect, assessment.faces, exact_distance)
              : ControlNets::none;
    std::vector<std::string> done;
    if (changes.mirrored) done.push_back("mirrored");
    if (changes.moved) done.push_back("moved");
    if (changes.scaled) done.push_back(scaled_in_words(pose.scale));
    if (whole && !exact) done.push_back("re-approximated within " + in_mm(deviation));
    if (nets == ControlNets::different) done.push_back("re-parametrised");
    std::string how = changes.count() == 0 ? " in the same place" : "";
    if (nets == ControlNets::same) how += " with the same control points";
    if (!done.empty()) how += ", " + joined(done);

    Answer result;
    if (suspect_whole && original_whole) {
        result.kind = class_of_whole_copy(changes, exact);
        result.text = "the same shape" + how;
    } else if (suspect_whole) {
        result.kind = AnswerClass::piece;
        result.text = "a piece of the original" + how + ": all of the suspect lies on it and covers " + original_share +
                      " of its area";
    } else if (original_whole) {
        result.kind = AnswerClass::contains;
        result.text = "contains the whole original" + how + ": it makes up " + suspect_share + " of the suspect's area";
    } else {
        result.kind = AnswerClass::partly;
        result.text = "partly the same shape" + how + ": " + suspect_share + " of the suspect's area lies within " +
                      in_mm(tolerance) + " of the original and " + original_share +
                      " of the original's within that of the suspect; the rest of the suspect deviates by up to " +
                      in_mm(largest_distance(on_original));
    }
    result.text += further_copies(alignment, result.kind) + caveat(alignment);
    return result;
}

const char* name(AnswerClass kind) {
    switch (kind) {
        case AnswerClass::same:
            return "same";
        case AnswerClass::moved:
            return "moved";
        case AnswerClass::scaled:
            return "scaled";
        case AnswerClass::mirrored:
            return "mirrored";
        case AnswerClass::piece:
            return "piece";
        case AnswerClass::contains:
            return "contains";
        case AnswerClass::reapproximated:
            return "reapproximated";
        case AnswerClass::partly:
            return "partly";
        case AnswerClass::different:
            return "different";
    }
    return "different";
}

}  // namespace umbilic
