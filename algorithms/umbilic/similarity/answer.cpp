// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>

#include <umbilic/similarity/control_nets.h>
#include <umbilic/similarity/thresholds.h>
#include <umbilic/similarity/unit_ratio.h>
#include <umbilic/similarity/verdict.h>
#include <umbilic/similarity/wording.h>

namespace umbilic {

namespace {

/// What a pose says was done to the original to get the suspect, told apart within a length (mm of the original).
struct PoseChanges {
    bool mirrored = false, scaled = false, moved = false;

    int count() const { return mirrored + scaled + moved; }
};

/// Greatest distance between a corner of the box and its image.
double displacement(const SimilarityTransform& transform, const BoundingBox& box) {
    double result = 0.0;
    for (int i = 0; i < 8; ++i) {
        const Vector3 corner(i & 1 ? box.high.x() : box.low.x(), i & 2 ? box.high.y() : box.low.y(),
                             i & 4 ? box.high.z() : box.low.z());
        result = std::max(result, (transform.apply(corner) - corner).norm());
    }
    return result;
}

PoseChanges pose_changes(const SimilarityTransform& pose, const BoundingBox& suspect, double tolerance) {
    const double extent = pose.scale * suspect.diagonal();
    PoseChanges result;
    result.mirrored = pose.mirrored;
    result.scaled = std::abs(pose.scale - 1.0) * suspect.diagonal() > tolerance;
    if (!result.mirrored && !result.scaled) {
        result.moved = displacement(pose, suspect) > tolerance;
        return result;
    }
    // A scaling about the origin and a reflection in any plane leave the shape standing as it was. The translation
    // belongs to the origin: errors of angle and scale grow on the way there.
    const double reach = pose.scale * suspect.center().norm();
    const double translation_tolerance = tolerance * (1.0 + reach / extent);
    const Matrix3 linear = pose.orthogonal();
    const Vector3 shift =
        result.mirrored && !result.scaled ? Vector3(linear * pose.translation + pose.translation) : pose.translation;
    const Matrix3 turn = result.mirrored ? Matrix3(linear - linear.transpose()) : Matrix3(linear - Matrix3::Identity());
    const bool point_reflection = result.mirrored && linear.trace() < 0.0;
    result.moved = turn.norm() * extent > tolerance || point_reflection || shift.norm() > translation_tolerance;
    return result;
}

/// The pose that changes least among those that fit equally well: a symmetric shape that stands where it stood is not
/// called moved or mirrored.
SimilarityTransform plainest_pose(const Alignment& alignment, const BoundingBox& suspect, double tolerance) {
    SimilarityTransform best = alignment.original_suspect;
    int least = pose_changes(best, suspect, tolerance).count();
    for (const SimilarityTransform& pose : alignment.symmetries) {
        const int count = pose_changes(pose, suspect, tolerance).count();
        if (count >= least) continue;
        best = pose;
        least = count;
    }
    return best;
}

std::string scaled_in_words(double scale) {
    const double factor = 1.0 / scale;
    std::string result = "scaled by " + in_digits(factor) + " (the suspect is ";
    result += factor >= 1.0 ? in_digits(factor) + " times as large" : in_digits(scale) + " times smaller";
    if (const auto units = mixed_up_units(scale)) result += "; unit mix-up of " + *units + "?";
    return result + ")";
}

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

Answer no_pose(const Alignment& alignment) {
    // Without a single hypothesis nothing was compared, so nothing can be said of the shapes.
    if (alignment.method == MatchMethod::none && alignment.runners_up.empty()) {
        std::string why = alignment.why;
        while (!why.empty() && why.back() == '.') why.pop_back();
        return {AnswerClass::different,
                "nothing could be decided: no method proposes a position of the suspect (" + why + ")"};
    }
    Answer result{AnswerClass::different, "different: no position of the suspect fits the original"};
    if (!alignment.runners_up.empty())
        result.text += "; at best " + in_percent(alignment.runners_up.front().score) + " of its area comes within " +
                       in_mm(alignment.tolerance) + " of it";
    return result;
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

std::string caveat(const Alignment& alignment) {
    switch (alignment.status) {
        case AlignmentStatus::ambiguous:
            return "; it fits in several positions";
        case AlignmentStatus::compatible:
            return "; but this is too little evidence (" + alignment.why + ")";
        default:
            return "";
    }
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
