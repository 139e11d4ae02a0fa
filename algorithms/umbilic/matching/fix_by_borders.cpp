// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/fix_by_borders.h>

#include <algorithm>
#include <array>

#include <umbilic/matching/decision.h>
#include <umbilic/matching/shared_borders.h>

namespace umbilic {

namespace {

/// Samples of all the borders of a model.
constexpr int border_samples = 1500;
/// Shared borders shorter than this part of the length of the smaller model may be crossings and chance.
constexpr double least_border = 0.1;
/// Poses that are added for one motion: holes around an axis have as many.
constexpr std::size_t most_amounts = 12;

/// Index of the pose that stands for `original_suspect`.
std::size_t index_of(const PoseSearch& search, const SimilarityTransform& original_suspect) {
    const auto& poses = search.poses();
    const auto same = std::find_if(poses.begin(), poses.end(), [&](const ScoredPose& pose) {
        return pose.hypothesis.original_suspect.translation == original_suspect.translation &&
               pose.hypothesis.original_suspect.rotation == original_suspect.rotation;
    });
    return static_cast<std::size_t>(same - poses.begin());
}

}  // namespace

void fix_by_borders(PoseSearch& search, const Progress& progress) {
    if (search.poses().empty()) return;
    const Fit fit = judge(search.poses().front(), search);
    if (fit.level == FitLevel::none || fit.free_motions.empty()) return;
    const BorderSamples original(search.original().model.model, border_samples, progress.part(0.0, 0.3));
    const BorderSamples suspect(search.suspect().model.model, border_samples, progress.part(0.3, 0.6));
    SimilarityTransform pose = search.poses().front().hypothesis.original_suspect;
    for (const FreeMotionKind kind : {FreeMotionKind::slide, FreeMotionKind::turn})
        for (const FreeMotion& motion : fit.free_motions) {
            if (motion.kind != kind || search.out_of_time()) continue;
            const std::vector<SharedBorder> borders =
                shared_borders(motion, pose, original, suspect, fit.tolerance, progress.part(0.6, 1.0));
            if (borders.empty() || borders.front().length < least_border * search.poses().front().length) continue;
            const SimilarityTransform from = pose;
            pose = compose(motion.by(borders.front().amount), from);
            for (std::size_t k = 0; k < std::min(borders.size(), most_amounts); ++k)
                search.move_along(index_of(search, from), motion, borders[k].amount, borders[k].length);
        }
}

}  // namespace umbilic
