// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/pose_search.h>

#include <algorithm>
#include <numeric>
#include <span>

#include <oneapi/tbb/parallel_for.h>

#include <umbilic/matching/tolerances.h>

namespace umbilic {

namespace {

/// Distance at which a sample still adds to the score of an unrefined hypothesis, relative to the smaller length: a few
/// degrees of error at half a length.
constexpr double coarse_tolerance = 0.05;
/// Samples that judge an unrefined hypothesis, and points that refine it.
constexpr int quick_samples = 48;
/// Samples of either model that say whether an approached pose is promising, and points that refine it.
constexpr int judging_samples = 200;
constexpr int refining_points = 400;
/// A refinement starts with the first of them, which suffice to come close.
constexpr std::size_t approaching_points = 100;
constexpr int approaching_steps = 20;
/// ... and ends with a step that moves the points by less than this part of the root mean square of their distances.
constexpr double approaching_part_of_rms = 0.05;
/// Cut-off from which the refinement goes on with all points, relative to the length.
constexpr double near_cutoff = 5e-3;
/// Hypotheses scored between two updates of the score that gives up early. Fixed, so that results do not depend on
/// threads.
constexpr std::size_t batch = 64;
/// The larger model is the ground if it is longer by this factor; otherwise the original is.
constexpr double larger = 1.5;
/// An approached pose whose soft shares, at the tolerance of measured shapes, are below this part of the best ones so
/// far is not worth the exact distances: the best of them is measured on the tables of samples, to be reported.
constexpr double unpromising = 0.25;
/// A refinement on the surfaces ends with a step that moves the points by less than this part of the root mean square
/// of their distances: chance alone moves the pose by more, rms / sqrt(points). A pose that fits has taken far fewer
/// steps than these.
constexpr double sufficient_part_of_rms = 1e-3;
constexpr int refining_steps = 30;
/// ... unless a valley is all but flat, which polishing goes along.
constexpr int polishing_steps = 90;
/// Polishing starts from the cut-off of the first refinement times this.
constexpr double wider = 2.0;
/// A refined pose whose residuals are below this part of the length, the rounding of files, gains nothing from more
/// points.
constexpr double rounding = 1e-10;
/// Of two refined poses in one place the later one is measured only if its residuals are smaller by this factor.
constexpr double closer = 1.1;
/// Longer time limits (a year, s) are none.
constexpr double longest_seconds = 3e7;
/// A refined pose on which fewer of the points than this came to lie is dropped.
constexpr double hopeless_share = 0.05;
/// Models whose lengths differ by more than this factor after scaling are not compared: samples would be too sparse.
constexpr double greatest_length_ratio = 50.0;

std::vector<WeightedPoint> spread_points(const std::vector<AreaSample>& samples, int count) {
    std::vector<WeightedPoint> points;
    for (const int i : spread_samples(samples, count)) points.push_back({samples[i].curvature.point, 1.0});
    return points;
}

std::vector<WeightedPoint> all_points(const std::vector<AreaSample>& samples) {
    std::vector<WeightedPoint> points;
    for (const AreaSample& sample : samples) points.push_back({sample.curvature.point, sample.weight});
    return points;
}

/// True if a pose was refined to a closer fit than another one in the same place.
bool fits_closer(const ScoredPose& pose, const ScoredPose& other) {
    return closer * pose.refinement.rms + rounding * pose.length < other.refinement.rms;
}

/// What a model's file leaves open: the greatest conversion error and stated tolerance of its faces, mm.
double stated(const Model& model) {
    double greatest = 0.0;
    for (const Face& face : model.faces) greatest = std::max(greatest, face.conversion_error + face.tolerance);
    return greatest;
}

}  // namespace

PoseSearch::PoseSearch(const PreparedModel& original, const PreparedModel& suspect, const MatchOptions& options)
    : original_(original),
      suspect_(suspect),
      original_samples_(original.table),
      suspect_samples_(suspect.table),
      options_(options),
      distance_(suspect.features),
      original_length_(shape_size(original.features).length),
      suspect_length_(shape_size(suspect.features).length) {
    if (options.seconds)
        deadline_ = std::chrono::steady_clock::now() +
                    std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                        std::chrono::duration<double>(std::min(*options.seconds, longest_seconds)));
}

bool PoseSearch::out_of_time() const {
    return deadline_ && std::chrono::steady_clock::now() > *deadline_;
}

double PoseSearch::length(double scale) const {
    return std::min(original_length_, scale * suspect_length_);
}

bool PoseSearch::suspect_is_larger(double scale) const {
    return scale * suspect_length_ > larger * original_length_;
}

double PoseSearch::stated_tolerance(double scale) const {
    return std::min(stated(original_.model.model) + scale * stated(suspect_.model.model),
                    greatest_stated_tolerance * length(scale));
}

void PoseSearch::consider(const Proposals& proposals, int keep, double start_cutoff, const Progress& progress) {
    const std::vector<int> original_few = spread_samples(original_.model.features.samples, quick_samples);
    const std::vector<int> suspect_few = spread_samples(suspect_.model.features.samples, quick_samples);
    const bool oriented = original_.model.model.oriented() && suspect_.model.model.oriented();
    const auto& all = proposals.poses;
    std::vector<double> scores(all.size(), 0.0);
    std::vector<double> best;  // scores of the best `keep` so far, for giving up early
    for (std::size_t begin = 0; begin < all.size(); begin += batch) {
        progress.report(0.5 * begin / all.size(), "scoring poses");
        const std::size_t end = std::min(begin + batch, all.size());
        // Near duplicates crowd the best places, so the bar stays well below the worst of them.
        const double bar = static_cast<int>(best.size()) < keep ? 0.0 : 0.5 * best.back();
        tbb::parallel_for(begin, end, [&](std::size_t i) {
            const SimilarityTransform& pose = all[i].original_suspect;
            const double ratio = pose.scale * suspect_length_ / original_length_;
            if (!(ratio < greatest_length_ratio && 1.0 / ratio < greatest_length_ratio)) return;
            const double tolerance = coarse_tolerance * length(pose.scale);
            scores[i] = suspect_is_larger(pose.scale)
                            ? quick_score(suspect_samples_, oriented, original_.model.features.samples, original_few,
                                          pose.inverse(), tolerance / pose.scale, bar)
                            : quick_score(original_samples_, oriented, suspect_.model.features.samples, suspect_few,
                                          pose, tolerance, bar);
        });
        best.insert(best.end(), scores.begin() + begin, scores.begin() + end);
        std::sort(best.rbegin(), best.rend());
        best.resize(std::min<std::size_t>(best.size(), keep));
    }

    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
    std::vector<PoseHypothesis> chosen;
    for (const std::size_t i : order) {
        if (static_cast<int>(chosen.size()) == keep || scores[i] == 0.0) break;
        if (std::none_of(chosen.begin(), chosen.end(), [&](const PoseHypothesis& other) {
                return distance_.relative(all[i].original_suspect, other.original_suspect) < same_hypothesis;
            }))
            chosen.push_back(all[i]);
    }

    const Points points{spread_points(original_.model.features.samples, refining_points),
                        spread_points(suspect_.model.features.samples, refining_points)};
    const Judging judging{spread_samples(original_.model.features.samples, judging_samples),
                          spread_samples(suspect_.model.features.samples, judging_samples)};
    const RefineOptions exactly{
        .start_cutoff = near_cutoff, .maximum_steps = refining_steps, .sufficient_part_of_rms = sufficient_part_of_rms};
    std::optional<ScoredPose> spare;  // the best of those that are not promising
    double spare_shares = 0.0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (out_of_time()) break;
        progress.report(0.5 + 0.5 * i / chosen.size(), "refining poses");
        ScoredPose pose{.hypothesis = chosen[i]};
        if (!approach(pose, points, start_cutoff, proposals.sampled, progress)) continue;
        const auto near = find_same(pose);
        if (near != poses_.end() && !near->approximate) continue;
        const double shares = judged_shares(pose.hypothesis.original_suspect, judging);
        pose.approximate = shares < unpromising * best_shares_;
        best_shares_ = std::max(best_shares_, shares);
        if (pose.approximate) {
            if (shares > spare_shares || !spare) {
                spare = std::move(pose);
                spare_shares = shares;
            }
            continue;
        }
        if (!lay_on_surfaces(pose, points, exactly, progress)) continue;
        const auto same = find_same(pose);
        if (same != poses_.end() && !same->approximate && !fits_closer(pose, *same)) continue;
        measure(pose, original_, suspect_);
        add(std::move(pose));
    }
    if (spare) {
        measure(*spare, original_samples_, suspect_samples_);
        add(std::move(*spare));
    }
    sort_poses();
}

void PoseSearch::add(ScoredPose pose) {
    const auto same = find_same(pose);
    if (same == poses_.end()) {
        poses_.push_back(std::move(pose));
    } else if (same->rank < pose.rank) {
        pose.hypothesis.method = same->hypothesis.method;  // the method that came to it first
        *same = std::move(pose);
    }
}

void PoseSearch::sort_poses() {
    std::stable_sort(poses_.begin(), poses_.end(),
                     [](const ScoredPose& a, const ScoredPose& b) { return a.rank > b.rank; });
}

std::vector<ScoredPose>::iterator PoseSearch::find_same(const ScoredPose& pose) {
    return std::find_if(poses_.begin(), poses_.end(), [&](const ScoredPose& other) {
        return distance_.relative(pose.hypothesis.original_suspect, other.hypothesis.original_suspect) < same_pose;
    });
}

void PoseSearch::fix(std::size_t index, const SimilarityTransform& move, const FreeMotion& motion,
                     double shared_borders) {
    // Not refined again: the surfaces would let it drift along the motion.
    ScoredPose pose = poses_[index];
    pose.hypothesis.original_suspect = compose(move, pose.hypothesis.original_suspect);
    if (!suspect_is_larger(pose.hypothesis.original_suspect.scale))
        pose.refinement.centre = move.apply(pose.refinement.centre);
    pose.fixed_by_borders.push_back(motion);
    pose.shared_borders = shared_borders;
    measure(pose, original_, suspect_);
    poses_.push_back(std::move(pose));
    sort_poses();
}

void PoseSearch::polish(std::size_t index, bool fits, const Progress& progress) {
    const ScoredPose& pose = poses_[index];
    if (!pose.fixed_by_borders.empty()) return;
    if (pose.refinement.converged && pose.refinement.rms <= rounding * pose.length && !pose.approximate) return;
    const Points points{all_points(original_.model.features.samples), all_points(suspect_.model.features.samples)};
    ScoredPose better{.hypothesis = poses_[index].hypothesis};
    const double known_cutoff = pose.approximate ? near_cutoff : wider * pose.refinement.cutoff / pose.length;
    const RefineOptions finely{.start_cutoff = std::clamp(known_cutoff, rounding, near_cutoff),
                               .maximum_steps = fits ? polishing_steps : refining_steps,
                               .sufficient_part_of_rms = sufficient_part_of_rms};
    if (!lay_on_surfaces(better, points, finely, progress)) return;
    measure(better, original_, suspect_);
    if (better.rank >= poses_[index].rank || poses_[index].approximate) poses_[index] = std::move(better);
}

bool PoseSearch::lay(ScoredPose& scored, const GroundSurface& ground, std::span<const WeightedPoint> points,
                     const RefineOptions& options, const Progress& progress) const {
    SimilarityTransform& pose = scored.hypothesis.original_suspect;
    const bool larger_suspect = suspect_is_larger(pose.scale);
    scored.refinement = refine(ground, points, larger_suspect ? pose.inverse() : pose, options, progress);
    if (scored.refinement.share < hopeless_share) return false;
    const SimilarityTransform& ground_points = scored.refinement.original_suspect;
    pose = larger_suspect ? ground_points.inverse() : ground_points;
    scored.length = length(pose.scale);
    return true;
}

bool PoseSearch::approach(ScoredPose& pose, const Points& points, double start_cutoff, bool sampled,
                          const Progress& progress) const {
    const bool larger_suspect = suspect_is_larger(pose.hypothesis.original_suspect.scale);
    const std::span<const WeightedPoint> all(larger_suspect ? points.original : points.suspect);
    const RefineOptions options{.scale = larger_suspect ? options_.scale.inverse() : options_.scale,
                                .start_cutoff = start_cutoff,
                                .maximum_steps = approaching_steps,
                                .sufficient_part_of_rms = approaching_part_of_rms,
                                .hold_determined = sampled};
    // What is near needs no approach: samples would only take it farther away.
    if (start_cutoff > near_cutoff && !lay(pose, larger_suspect ? suspect_samples_ : original_samples_,
                                           all.first(std::min(approaching_points, all.size())), options, progress))
        return false;
    return true;
}

bool PoseSearch::lay_on_surfaces(ScoredPose& pose, const Points& points, RefineOptions options,
                                 const Progress& progress) const {
    const bool larger_suspect = suspect_is_larger(pose.hypothesis.original_suspect.scale);
    options.scale = larger_suspect ? options_.scale.inverse() : options_.scale;
    return lay(pose, larger_suspect ? suspect_ : original_, larger_suspect ? points.original : points.suspect, options,
               progress);
}

void PoseSearch::measure(ScoredPose& scored, const GroundSurface& original, const GroundSurface& suspect) const {
    const SimilarityTransform& pose = scored.hypothesis.original_suspect;
    const bool oriented = original_.model.model.oriented() && suspect_.model.model.oriented();
    scored.length = length(pose.scale);
    const double limit =
        options_.tolerance.value_or(FitTolerance::resembling * scored.length + stated_tolerance(pose.scale));
    scored.suspect_distances = sample_distances(original, oriented, suspect_.model.features.samples, pose, limit);
    scored.original_distances =
        sample_distances(suspect, oriented, original_.model.features.samples, pose.inverse(), limit / pose.scale);
    for (double& d : scored.original_distances) d *= pose.scale;
    scored.rank = soft_shares(scored, FitTolerance::reapproximated);
}

double PoseSearch::judged_shares(const SimilarityTransform& pose, const Judging& judging) const {
    const bool oriented = original_.model.model.oriented() && suspect_.model.model.oriented();
    const double tolerance =
        options_.tolerance.value_or(FitTolerance::measured * length(pose.scale) + stated_tolerance(pose.scale));
    return quick_score(original_samples_, oriented, suspect_.model.features.samples, judging.suspect, pose, tolerance,
                       0.0) +
           quick_score(suspect_samples_, oriented, original_.model.features.samples, judging.original, pose.inverse(),
                       tolerance / pose.scale, 0.0);
}

double PoseSearch::soft_shares(const ScoredPose& pose, double relative_tolerance) const {
    const double stated = stated_tolerance(pose.hypothesis.original_suspect.scale);
    const double tolerance = options_.tolerance.value_or(relative_tolerance * pose.length + stated);
    return coverage(suspect_.model.features.samples, pose.suspect_distances, tolerance).soft +
           coverage(original_.model.features.samples, pose.original_distances, tolerance).soft;
}

}  // namespace umbilic
