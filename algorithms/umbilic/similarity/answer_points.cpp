// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>

#include <umbilic/similarity/pose_changes.h>
#include <umbilic/similarity/thresholds.h>
#include <umbilic/similarity/verdict.h>
#include <umbilic/similarity/wording.h>

namespace umbilic {

namespace {

/// Standard deviations of the scale within which it may still be 1.
constexpr double scale_certainty = 3.0;

AnswerClass class_of_whole_scan(const PoseChanges& changes) {
    if (changes.mirrored) return AnswerClass::mirrored;
    if (changes.scaled) return AnswerClass::scaled;
    return changes.moved ? AnswerClass::moved : AnswerClass::same;
}

}  // namespace

Answer answer(const PreparedPoints& suspect, const Alignment& alignment, const Assessment& assessment) {
    if (alignment.status == AlignmentStatus::not_found) return no_pose(alignment);

    const double tolerance = find_tolerance(assessment.tolerances, "distance").value;
    const double noise = find_tolerance(assessment.tolerances, "noise").value;
    BoundingBox box;
    for (const Vector3& p : suspect.cloud.points)
        if (suspect.bulk.holds(p)) box.add(p);
    const double extent = alignment.original_suspect.scale * box.diagonal();
    const double pose_tolerance = std::max(tolerance, scale_certainty * alignment.scale_deviation * extent);
    const SimilarityTransform pose = plainest_pose(alignment, box, pose_tolerance);
    const PoseChanges changes = pose_changes(pose, box, pose_tolerance);
    std::vector<std::string> done;
    if (changes.mirrored) done.push_back("mirrored");
    if (changes.moved) done.push_back("moved");
    if (changes.scaled) done.push_back(scaled_in_words(pose.scale));
    const std::string how = done.empty() ? ", in the same place" : ", " + joined(done);

    const std::string scan = suspect.cloud.is_mesh() ? "a mesh" : "a scan";
    const std::string chords = suspect.cloud.is_mesh()
                                   ? ", its triangles up to " +
                                         in_mm(find_tolerance(assessment.tolerances, "chord").value) +
                                         " beside the surface as chords"
                                   : "";
    const std::string lies = in_percent(assessment.suspect_on_original.coverage) +
                             " of it lies on the original within " + in_mm(tolerance) + " (rms " +
                             in_mm(alignment.rms) + ", noise of the points " + in_mm(noise) + ") and covers " +
                             in_percent(assessment.original_on_suspect.coverage) + " of its area" + chords;
    if (assessment.suspect_on_original.overlap < needed_share(assessment))
        return {AnswerClass::partly, scan + " that is partly of the original" + how + ": " + lies + caveat(alignment)};
    if (alignment.scope == MatchScope::global)
        return {class_of_whole_scan(changes), scan + " of the whole original" + how + ": " + lies + caveat(alignment)};
    return {AnswerClass::piece, scan + " of a piece of the original" + how + ": " + lies + caveat(alignment)};
}

}  // namespace umbilic
