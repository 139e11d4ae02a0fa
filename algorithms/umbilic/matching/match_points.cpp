// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/match_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <span>

#include <Eigen/Eigenvalues>
#include <oneapi/tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/matching/by_given_pairs.h>
#include <umbilic/matching/by_principal_frame.h>
#include <umbilic/matching/choice_words.h>
#include <umbilic/matching/passed_samples.h>
#include <umbilic/matching/pose_distance.h>
#include <umbilic/matching/quadric.h>
#include <umbilic/matching/refine.h>
#include <umbilic/matching/score.h>
#include <umbilic/matching/table_ground.h>
#include <umbilic/matching/tolerances.h>

namespace umbilic {

namespace {

/// Samples of the original that seeds are compared with: the errors of jets are greater than what changes from one to
/// the next.
constexpr std::size_t compared_samples = 2500;
/// Proposals, those of them that are brought close, that are compared, and that are refined exactly.
constexpr int proposals = 300, rough_poses = 48, near_poses = 12, exact_poses = 4;
/// Proposals nearer to each other than this part of the suspect's length are refined as one: well within the basin.
constexpr double same_proposal = 0.1;
/// Points and steps that do so.
constexpr int rough_points = 80, near_points = 400, exact_points = 1500;
constexpr int rough_steps = 10, near_steps = 12;
/// Steps below these parts of the suspect's radius are enough on the way; at the end, those that are below the standard
/// deviation of a mean of the noise by this factor.
constexpr double rough_step = 3e-3, near_step = 3e-4, noise_step = 0.02;
/// A pose that costs this many times the best on the table of samples is not refined exactly.
constexpr double promising = 2.0;
/// How far a hypothesis may be off, and one refined roughly, as a part of the suspect's length.
constexpr double rough_cutoff = 0.15, near_cutoff = 0.05;
/// Distances beyond this part of the length count as if they were no greater.
constexpr double cost_limit = 0.02;
/// Share of the original that counts as all of it.
constexpr double whole = 0.95;
/// Runners-up that are reported.
constexpr std::size_t most_runners_up = 10;

/// What the search needs of the original, a model or a cloud.
struct Original {
    const GroundSurface& exact;
    const PrincipalFrameTable& table;
    const std::vector<AreaSample>& samples;
    double size = 0.0;    ///< sqrt(area), mm
    double length = 0.0;  ///< mm
    double noise = 0.0;   ///< mm
    bool oriented = false;
};

struct Pose {
    SimilarityTransform original_suspect;
    MatchMethod method = MatchMethod::points;
    Refinement refinement;
    double cost = INFINITY;  ///< root mean square of the limited distances in the suspect's unit, mm
};

std::string printed(const char* format, double a, double b = 0.0) {
    std::array<char, 160> text;
    std::snprintf(text.data(), text.size(), format, a, b);
    return text.data();
}

std::vector<WeightedPoint> spread(const std::vector<AreaSample>& samples, int count) {
    if (static_cast<int>(samples.size()) <= count) {
        std::vector<WeightedPoint> all;
        for (const AreaSample& sample : samples) all.push_back({sample.curvature.point, sample.weight});
        return all;
    }
    std::vector<WeightedPoint> points;
    for (const int i : spread_samples(samples, count)) points.push_back({samples[i].curvature.point, 1.0});
    return points;
}

class PointMatch {
public:
    PointMatch(const Original& original, const PreparedPoints& suspect, const MatchOptions& options)
        : original_(original),
          suspect_(suspect),
          options_(options),
          rough_(original.table),
          bulk_(bulk_samples(suspect)),
          distance_(bulk_),
          pairs_(fit_given_pairs(options)),
          few_(spread(bulk_, rough_points)),
          some_(spread(bulk_, near_points)),
          many_(spread(bulk_, exact_points)) {}

    Alignment run(const Progress& progress) {
        std::vector<Pose> poses = proposed(progress.part(0.0, 0.4));
        refine_all(poses, rough_, few_,
                   {.start_cutoff = rough_cutoff, .maximum_steps = rough_steps, .sufficient_step = rough_step},
                   progress.part(0.4, 0.6));
        keep(poses, near_poses, same_hypothesis);
        refine_all(poses, rough_, some_,
                   {.start_cutoff = near_cutoff, .maximum_steps = near_steps, .sufficient_step = near_step},
                   progress.part(0.6, 0.7));
        keep(poses, near_poses, same_hypothesis);
        const auto unpromising = std::find_if(
            poses.begin(), poses.end(), [&](const Pose& pose) { return pose.cost > promising * poses.front().cost; });
        const std::size_t exact = std::min<std::size_t>(unpromising - poses.begin(), exact_poses);
        const double enough = noise_step * suspect_.noise / (suspect_.length * std::sqrt(exact_points));
        refine_all(std::span(poses).first(exact), original_.exact, many_,
                   {.start_cutoff = near_cutoff, .sufficient_step = enough, .hold_borders = true},
                   progress.part(0.7, 0.95));
        keep(poses, near_poses, same_hypothesis);
        Alignment alignment = decided(poses, progress.part(0.95, 1.0));
        alignment.given_pairs = judged_pairs(pairs_, alignment.original_suspect.mirrored);
        return alignment;
    }

private:
    std::vector<Pose> proposed(const Progress& progress) {
        std::vector<Pose> poses;
        if (options_.initial) poses.push_back({*options_.initial, MatchMethod::given});
        for (const ConsistentPointFit& fit : pairs_) poses.push_back({fit.original_suspect, MatchMethod::given});
        // A known scale leaves few of them, which have to come near to the truth: all are compared.
        const bool known_scale = options_.scale.kind == ScaleChoice::Kind::fixed;
        const std::size_t compared = known_scale ? 1 : original_.table.entries().size() / compared_samples;
        const PrincipalFrameOptions frames{.stride = std::max(1, static_cast<int>(compared)),
                                           .third_order = false,
                                           .keep = proposals,
                                           .flip_normals = !(original_.oriented && suspect_.oriented),
                                           .scale = options_.scale,
                                           .mirror = options_.mirror};
        progress.report(0.0, "looking up principal frames");
        for (const PoseCandidate& pose : propose_by_principal_frame(original_.table, suspect_.table, frames, progress))
            poses.push_back({pose.original_suspect, MatchMethod::points});
        drop_repeated(poses, rough_poses, same_proposal);
        return poses;
    }

    /// Square root of the mean of the limited squared distances, in the suspect's unit.
    double cost(const SimilarityTransform& pose, const GroundSurface& ground,
                const std::vector<WeightedPoint>& points) const {
        const double limit = std::max(cost_limit * suspect_.length, 2.0 * tolerance(1.0)) * pose.scale;
        double square = 0.0, weight = 0.0;
        for (const WeightedPoint& p : points) {
            const auto foot = ground.foot(pose.apply(p.point), limit);
            const double d = (foot ? foot->distance : limit) / pose.scale;
            square += p.weight * d * d;
            weight += p.weight;
        }
        return weight > 0.0 ? std::sqrt(square / weight) : INFINITY;
    }

    void refine_all(std::span<Pose> poses, const GroundSurface& ground, const std::vector<WeightedPoint>& points,
                    RefineOptions options, const Progress& progress) const {
        options.scale = options_.scale;
        tbb::parallel_for(std::size_t{0}, poses.size(), [&](std::size_t i) {
            Pose& pose = poses[i];
            pose.refinement = refine(ground, points, pose.original_suspect, options, progress);
            pose.original_suspect = pose.refinement.original_suspect;
            pose.cost = cost(pose.original_suspect, ground, points);
        });
        progress.report(1.0, "refining poses");
    }

    /// Leaves the first `count` of those that differ by more than `apart`; see PoseDistance::relative().
    void drop_repeated(std::vector<Pose>& poses, int count, double apart) const {
        std::vector<Pose> kept;
        for (Pose& pose : poses) {
            if (static_cast<int>(kept.size()) == count) break;
            if (std::none_of(kept.begin(), kept.end(), [&](const Pose& other) {
                    return distance_.relative(pose.original_suspect, other.original_suspect) < apart;
                }))
                kept.push_back(std::move(pose));
        }
        poses = std::move(kept);
    }

    /// The best of those that differ.
    void keep(std::vector<Pose>& poses, int count, double apart) const {
        std::stable_sort(poses.begin(), poses.end(), [](const Pose& a, const Pose& b) { return a.cost < b.cost; });
        drop_repeated(poses, count, apart);
    }

    /// Noise that the distances must be expected to have, in the suspect's unit.
    double noise(double scale) const { return std::hypot(suspect_.noise, original_.noise / scale); }

    /// Tolerance in mm of the original.
    double tolerance(double scale) const {
        return options_.tolerance.value_or(
            scale * (PointDecision::noise_tolerance * noise(scale) + FitTolerance::reapproximated * suspect_.length));
    }

    std::vector<double> suspect_distances(const Pose& pose, double limit) const {
        std::vector<double> distances(suspect_.samples.size());
        tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t i) {
            const auto foot =
                original_.exact.foot(pose.original_suspect.apply(suspect_.samples[i].curvature.point), limit);
            distances[i] = foot ? foot->distance : INFINITY;
        });
        return distances;
    }

    /// Of the original's samples from the suspect, mm of the original.
    std::vector<double> original_distances(const Pose& pose) const {
        std::vector<double> distances;
        for (const PassedSample& passed : passed_samples(original_.samples, suspect_, pose.original_suspect))
            distances.push_back(passed.past_border ? INFINITY : passed.distance);
        return distances;
    }

    PoseCandidate candidate(const Pose& pose) const {
        const double within = tolerance(pose.original_suspect.scale);
        const Coverage covered = coverage(suspect_.samples, suspect_distances(pose, within), within);
        return {pose.original_suspect, pose.method, covered.share, 0.0, covered.rms, covered.max};
    }

    /// What keeps a pose that fits from being evidence; empty if nothing does.
    std::string doubt(const Pose& pose, bool wholes) const {
        const double scale = pose.original_suspect.scale;
        const int n = options_.scale.kind == ScaleChoice::Kind::fixed ? 6 : 7;
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(pose.refinement.normal_matrix.topLeftCorner(n, n),
                                                                    Eigen::EigenvaluesOnly);
        const double weakest = std::sqrt(std::max(solver.eigenvalues()[0], 0.0));
        if (!wholes && weakest * PointDecision::sliding * scale * suspect_.length < tolerance(scale))
            return "the points can slide along the original within the tolerance, so that the pose is not determined";
        std::vector<Vector3> points;
        for (const AreaSample& sample : bulk_) points.push_back(sample.curvature.point);
        const double least = noise(scale) + FitTolerance::reapproximated * suspect_.length;
        if (departure_from_quadric(points) < PointDecision::departure * least)
            return "the points differ from a quadric by no more than their noise, and so fit many shapes";
        return "";
    }

    Alignment decided(const std::vector<Pose>& poses, const Progress& progress) const {
        Alignment result;
        const std::string tried = (pairs_.empty() ? "" : described(pairs_) + ", ") +
                                  "principal frames of the points' jets, noise " + printed("%.3g mm", suspect_.noise) +
                                  " of the suspect's " + printed("%.3g mm", suspect_.length);
        if (poses.empty()) {
            result.why =
                "No pose was proposed: the points have no well-determined principal frame that the original "
                "has too; tried " +
                tried + ".";
            return result;
        }
        progress.check();
        const Pose& best = poses.front();
        const double scale = best.original_suspect.scale;
        result.tolerance = tolerance(scale);
        const Coverage suspect =
            coverage(suspect_.samples, suspect_distances(best, result.tolerance), result.tolerance);
        const Coverage original = coverage(original_.samples, original_distances(best), result.tolerance);
        std::vector<const Pose*> equals;
        for (std::size_t i = 1; i < poses.size() && result.runners_up.size() < most_runners_up; ++i) {
            if (!distance_.different(best.original_suspect, poses[i].original_suspect)) continue;
            result.runners_up.push_back(candidate(poses[i]));
            // Below the tolerance of exact copies costs are rounding and jets' misfit.
            const double floor = FitTolerance::exact * suspect_.length;
            if (poses[i].cost < PointDecision::runner_up * best.cost + floor) equals.push_back(&poses[i]);
        }
        result.why = printed("%.1f %% of the points lie within %.3g mm", 100.0 * suspect.share, result.tolerance);
        const double greatest_rms =
            PointDecision::greatest_rms * std::max(noise(scale), 0.5 * FitTolerance::reapproximated * suspect_.length);
        if (suspect.share < PointDecision::share) {
            result.why = "No pose lays the points on the original: at best " + result.why + "; tried " + tried + ".";
            result.runners_up.insert(result.runners_up.begin(), candidate(best));
            return result;
        }
        result.method = best.method;
        result.original_suspect = best.original_suspect;
        result.scope = original.share >= whole ? MatchScope::global : MatchScope::partial;
        result.rms = suspect.rms;
        result.max = suspect.max;
        result.relative_max = suspect.max / original_.size;
        result.suspect_coverage = suspect.share;
        result.original_coverage = original.share;
        if (options_.scale.kind != ScaleChoice::Kind::fixed) result.scale_deviation = best.refinement.scale_deviation;
        const std::string doubts = doubt(best, result.scope == MatchScope::global);
        int strangers = 0;
        for (const Pose* other : equals) {
            if (is_symmetry(best, *other, result.tolerance))
                result.symmetries.push_back(other->original_suspect);
            else
                ++strangers;
        }
        if (!options_.tolerance && suspect.rms > greatest_rms * scale) {
            result.status = AlignmentStatus::compatible;
            result.why += printed(", but their rms is %.3g times their noise", suspect.rms / (scale * noise(scale)));
        } else if (!doubts.empty()) {
            result.status = AlignmentStatus::compatible;
            result.why += "; but " + doubts;
        } else if (strangers > 0) {
            result.status = AlignmentStatus::ambiguous;
            result.why += "; but " + std::to_string(strangers) + " different pose" +
                          (strangers > 1 ? "s fit" : " fits") + " as well";
        } else {
            result.status = AlignmentStatus::found;
        }
        result.why += printed("; the scale is known to %.2g %%", 100.0 * best.refinement.scale_deviation) +
                      ". Tried: " + tried + ".";
        return result;
    }

    /// True if the motion between two poses lays the original on itself where the suspect lies, or the suspect on
    /// itself.
    bool is_symmetry(const Pose& a, const Pose& b, double within) const {
        const TableGround original(original_.table), suspect(suspect_.table);
        const SimilarityTransform of_original = compose(b.original_suspect, a.original_suspect.inverse());
        const SimilarityTransform of_suspect = compose(a.original_suspect.inverse(), b.original_suspect);
        const auto laid = [](const GroundSurface& ground, const std::vector<AreaSample>& samples,
                             const SimilarityTransform& motion, double limit) {
            double inside = 0.0, all = 0.0;
            for (const AreaSample& sample : samples) {
                all += sample.weight;
                if (ground.foot(motion.apply(sample.curvature.point), limit)) inside += sample.weight;
            }
            return inside >= PointDecision::share * all;
        };
        return laid(original, original_.samples, of_original, within) ||
               laid(suspect, suspect_.samples, of_suspect, within / a.original_suspect.scale);
    }

    const Original& original_;
    const PreparedPoints& suspect_;
    const MatchOptions& options_;
    TableGround rough_;
    std::vector<AreaSample> bulk_;
    PoseDistance distance_;
    std::vector<ConsistentPointFit> pairs_;
    std::vector<WeightedPoint> few_, some_, many_;
};

Alignment global_only(Alignment alignment, const MatchOptions& options) {
    if (options.scope == ScopeChoice::global && alignment.status == AlignmentStatus::found &&
        alignment.scope == MatchScope::partial) {
        alignment.status = AlignmentStatus::compatible;
        alignment.why = "Only a part coincides, and agreement as wholes was asked for: " + alignment.why;
    }
    return alignment;
}

}  // namespace

void check_method(MethodChoice method, bool measured_suspect) {
    const std::string word = word_of(method_words, method);
    switch (method) {
        case MethodChoice::automatic:
        case MethodChoice::curvature:
            return;
        case MethodChoice::points:
            if (!measured_suspect)
                throw Unsupported("the method points needs measured points as the suspect; use auto");
            return;
        case MethodChoice::analytic:
        case MethodChoice::umbilics:
        case MethodChoice::umbilic_lines:
        case MethodChoice::umbilic_kh:
        case MethodChoice::moments:
        case MethodChoice::kh:
            if (measured_suspect)
                throw Unsupported("the method " + word +
                                  " needs surfaces, and the suspect holds measured points; use auto, or fit a surface "
                                  "first (umbilic fit)");
    }
}

Alignment match(const PreparedModel& original, const PreparedPoints& suspect, const MatchOptions& options,
                const Progress& progress) {
    check_options(options);
    check_method(options.method, true);
    if (original.table.entries().empty())
        throw InvalidInput(original.model.source.path + ": no face has a regular point");
    const Ground ground(original);
    const Original side{.exact = ground,
                        .table = original.table,
                        .samples = original.features.samples,
                        .size = original.model.size(),
                        .length = shape_size(original.features).length,
                        .oriented = original.model.oriented()};
    return global_only(PointMatch(side, suspect, options).run(progress), options);
}

Alignment match(const PreparedPoints& original, const PreparedPoints& suspect, const MatchOptions& options,
                const Progress& progress) {
    check_options(options);
    check_method(options.method, true);
    const TableGround ground(original.table);
    const Original side{.exact = ground,
                        .table = original.table,
                        .samples = original.samples,
                        .size = std::sqrt(original.area),
                        .length = original.length,
                        .noise = original.noise,
                        .oriented = original.oriented};
    return global_only(PointMatch(side, suspect, options).run(progress), options);
}

}  // namespace umbilic
