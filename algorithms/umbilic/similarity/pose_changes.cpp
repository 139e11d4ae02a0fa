// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/pose_changes.h>

#include <algorithm>
#include <cmath>

#include <umbilic/similarity/unit_ratio.h>
#include <umbilic/similarity/wording.h>

namespace umbilic {

namespace {

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

}  // namespace

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

}  // namespace umbilic
