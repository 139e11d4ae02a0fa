// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/fix_by_borders.h>

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include <umbilic/matching/decision.h>
#include <umbilic/matching/shared_borders.h>

namespace umbilic {

namespace {

/// Samples of all the borders of a model.
constexpr int border_samples = 1500;
/// Shared borders shorter than this part of the length of the smaller model may be crossings and chance.
constexpr double least_border = 0.1;
/// Places that are added for one motion: holes around an axis have as many.
constexpr std::size_t most_places = 12;

/// Index of the pose that stands for `original_suspect`.
std::size_t index_of(const PoseSearch& search, const SimilarityTransform& original_suspect) {
    const auto& poses = search.poses();
    const auto same = std::find_if(poses.begin(), poses.end(), [&](const ScoredPose& pose) {
        return pose.hypothesis.original_suspect.translation == original_suspect.translation &&
               pose.hypothesis.original_suspect.rotation == original_suspect.rotation;
    });
    return static_cast<std::size_t>(same - poses.begin());
}

/// The reflection that a surface with such a motion has: in a plane through the axis of a turn, or across a slide.
SimilarityTransform reflection(const FreeMotion& motion) {
    const Vector3 d = motion.kind == FreeMotionKind::turn ? motion.direction.unitOrthogonal() : motion.direction;
    return similarity_from_orthogonal(1.0, Matrix3::Identity() - 2.0 * d * d.transpose(),
                                      2.0 * d.dot(motion.point) * d);
}

struct FixedPlace {
    SimilarityTransform move;  ///< of the suspect in the original's space
    double length = 0.0;       ///< of the shared borders
};

/// The places with the longest shared borders, of either hand if both are allowed, longest first.
std::vector<FixedPlace> fixed_places(const FreeMotion& motion, const SimilarityTransform& pose,
                                     const BorderSamples& original, const BorderSamples& suspect, double tolerance,
                                     MirrorChoice mirror, const Progress& progress) {
    std::vector<FixedPlace> places;
    const auto add = [&](const SimilarityTransform& hand) {
        for (const SharedBorder& border :
             shared_borders(motion, compose(hand, pose), original, suspect, tolerance, progress))
            places.push_back({compose(motion.by(border.amount), hand), border.length});
    };
    add({});
    if (mirror == MirrorChoice::automatic) add(reflection(motion));
    std::stable_sort(places.begin(), places.end(),
                     [](const FixedPlace& a, const FixedPlace& b) { return a.length > b.length; });
    std::erase_if(places,
                  [&](const FixedPlace& place) { return place.length < as_long_border * places.front().length; });
    if (places.size() > most_places) places.resize(most_places);
    return places;
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
            const std::vector<FixedPlace> places = fixed_places(motion, pose, original, suspect, fit.tolerance,
                                                                search.options().mirror, progress.part(0.6, 1.0));
            if (places.empty() || places.front().length < least_border * search.poses().front().length) continue;
            const SimilarityTransform from = pose;
            pose = compose(places.front().move, from);
            for (const FixedPlace& place : places) search.fix(index_of(search, from), place.move, motion, place.length);
        }
}

}  // namespace umbilic
