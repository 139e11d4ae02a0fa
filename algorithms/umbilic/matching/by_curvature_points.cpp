// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_curvature_points.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <Eigen/Geometry>
#include <oneapi/tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/matching/curvature_finder.h>
#include <umbilic/matching/horn.h>
#include <umbilic/matching/pose_distance.h>
#include <umbilic/matching/scale_search.h>
#include <umbilic/matching/score.h>
#include <umbilic/matching/table_ground.h>

namespace umbilic {

namespace {

/// A voter must come to lie this near to one of its solutions, relative to the moved suspect's length, and its normal
/// within 26 degrees.
constexpr double vote_distance = 0.05, vote_cosine = 0.9;
/// With fewer voters than this the curvatures are looked for within tolerances too, parts of rho^2 and rho: those of a
/// re-approximated copy differ.
constexpr int enough_votes = 2;
constexpr double loose = 0.03;
/// Hypotheses handed on, and looked at for the objective of one scale.
constexpr std::size_t most_proposals = 200, most_scored = 6;
/// The objective: samples, and the distance at which one stops to count, relative to the moved suspect's length.
constexpr int objective_samples = 64;
constexpr double objective_tolerance = 0.05;
/// Scales at which the suspect may be a part of the original, by the ratio of their lengths; step of the scan (seeds
/// find each other within some 5 %), minima searched further, and the relative accuracy they are searched to:
/// refinement does the rest.
constexpr double smallest_part = 0.04, largest_part = 1.3;
constexpr double scan_step = 1.08;
constexpr int most_minima = 3;
constexpr double scale_accuracy = 2e-3;

double rho(const Curvature& c) {
    return std::hypot(c.kappa_max, c.kappa_min);
}

Matrix3 frame_of(const Curvature& c) {
    Matrix3 result;
    result << c.direction_max, c.direction_min, c.normal;
    return result;
}

struct Hypothesis {
    SimilarityTransform pose;
    int votes = 0;
    double spread = 0.0;  ///< mean distance of the voters from their solutions, in units of the vote's limit
    bool flip = false;
    int seed = 0;
    int solution = 0;
};

bool better(const Hypothesis& a, const Hypothesis& b) {
    return a.votes != b.votes ? a.votes > b.votes : a.spread < b.spread;
}

/// Solutions of each seed on the original.
using Solutions = CurvatureSolutions;

class CurvaturePointSearch {
public:
    CurvaturePointSearch(const PreparedModel& original, const PreparedModel& suspect,
                         const CurvaturePointMatching& options, const Progress& progress)
        : original_(original),
          suspect_(suspect),
          options_(options),
          oriented_(original.model.oriented() && suspect.model.oriented()),
          length_(shape_size(suspect.features).length),
          distance_(suspect.features),
          seeds_(choose_curvature_seeds(suspect, options.seeds)),
          samples_(spread_samples(suspect.features.samples, objective_samples)),
          finder_(original.model, options.solver, progress) {}

    const std::vector<CurvatureSeed>& seeds() const { return seeds_; }
    std::size_t faces() const { return finder_.faces(); }
    double length() const { return length_; }

    /// Poses at one scale, most votes first, different ones only.
    std::vector<Hypothesis> poses(double scale, double tolerance, std::size_t most, const Progress& progress) const;
    /// One minus the best soft share of the suspect under those poses: 0 if all of it lies on the original.
    double objective(double scale, const Progress& progress) const;

private:
    Solutions solve(double scale, double tolerance, const Progress& progress) const;
    std::vector<std::pair<int, const Curvature*>> voters(const Hypothesis& hypothesis,
                                                         const Solutions& solutions) const;
    void vote(const Solutions& solutions, Hypothesis& hypothesis) const;
    void improve(const Solutions& solutions, Hypothesis& hypothesis) const;
    Curvature seen(int seed, bool flip) const {
        return flip ? flipped(seeds_[seed].curvature) : seeds_[seed].curvature;
    }

    const PreparedModel& original_;
    const PreparedModel& suspect_;
    CurvaturePointMatching options_;
    bool oriented_;
    double length_;
    PoseDistance distance_;
    std::vector<CurvatureSeed> seeds_;
    std::vector<int> samples_;
    CurvatureFinder finder_;
};

Solutions CurvaturePointSearch::solve(double scale, double tolerance, const Progress& progress) const {
    std::vector<CurvatureQuery> queries;
    for (const CurvatureSeed& seed : seeds_) {
        const double size = rho(seed.curvature) / scale;
        queries.push_back({seed.curvature.gaussian() / (scale * scale), seed.curvature.mean() / scale,
                           tolerance * size * size, tolerance * size});
    }
    return finder_.find(queries, !oriented_, progress);
}

std::vector<std::pair<int, const Curvature*>> CurvaturePointSearch::voters(const Hypothesis& hypothesis,
                                                                           const Solutions& solutions) const {
    std::vector<std::pair<int, const Curvature*>> result;
    const SimilarityTransform& pose = hypothesis.pose;
    const double limit = vote_distance * length_ * pose.scale;
    const Vector3& anchor = solutions[hypothesis.seed][hypothesis.flip][hypothesis.solution].point;
    const Vector3& own = seeds_[hypothesis.seed].curvature.point;
    for (int j = 0; j < static_cast<int>(seeds_.size()); ++j) {
        if (j == hypothesis.seed) continue;
        const Curvature seed = seen(j, hypothesis.flip);
        const Vector3 place = pose.apply(seed.point), normal = pose.apply_direction(seed.normal);
        const double apart = pose.scale * (seed.point - own).norm();
        const Curvature* nearest = nullptr;
        double least = limit;
        for (const Curvature& solution : solutions[j][hypothesis.flip]) {
            if (std::abs((solution.point - anchor).norm() - apart) > limit) continue;
            const double distance = (solution.point - place).norm();
            if (distance > least || solution.normal.dot(normal) < vote_cosine) continue;
            nearest = &solution;
            least = distance;
        }
        if (nearest) result.emplace_back(j, nearest);
    }
    return result;
}

void CurvaturePointSearch::vote(const Solutions& solutions, Hypothesis& hypothesis) const {
    const auto found = voters(hypothesis, solutions);
    const double limit = vote_distance * length_ * hypothesis.pose.scale;
    hypothesis.votes = static_cast<int>(found.size());
    hypothesis.spread = 0.0;
    for (const auto& [j, solution] : found)
        hypothesis.spread += (hypothesis.pose.apply(seeds_[j].curvature.point) - solution->point).norm() /
                             (limit * static_cast<double>(found.size()));
}

/// Least squares over all voters at the same scale; each stands for its point and the tip of its normal.
void CurvaturePointSearch::improve(const Solutions& solutions, Hypothesis& hypothesis) const {
    if (hypothesis.votes < 1) return;
    auto all = voters(hypothesis, solutions);
    all.emplace_back(hypothesis.seed, &solutions[hypothesis.seed][hypothesis.flip][hypothesis.solution]);
    const double scale = hypothesis.pose.scale, tip = 0.5 * length_;
    std::vector<PointPair> pairs;
    for (const auto& [j, solution] : all) {
        const Curvature seed = seen(j, hypothesis.flip);
        pairs.push_back({solution->point, scale * seed.point});
        pairs.push_back({solution->point + scale * tip * solution->normal, scale * (seed.point + tip * seed.normal)});
    }
    try {
        Hypothesis improved = hypothesis;
        improved.pose = fit_points(pairs, {.free_scale = false, .mirrored = hypothesis.pose.mirrored}).original_suspect;
        improved.pose.scale = scale;
        vote(solutions, improved);
        if (better(improved, hypothesis)) hypothesis = improved;
    } catch (const InvalidInput&) {
        // Points one above the other along their normals lie on a line: the pose from the single pair stands.
    }
}

std::vector<Hypothesis> CurvaturePointSearch::poses(double scale, double tolerance, std::size_t most,
                                                    const Progress& progress) const {
    const Solutions solutions = solve(scale, tolerance, progress);
    std::vector<Hypothesis> all;
    for (int i = 0; i < static_cast<int>(seeds_.size()); ++i)
        for (const bool flip : {false, true}) {
            const Curvature seed = seen(i, flip);
            const std::vector<Curvature>& found = solutions[i][flip];
            for (int k = 0; k < static_cast<int>(found.size()); ++k)
                for (const bool mirrored : {false, true}) {
                    if (mirrored && options_.mirror == MirrorChoice::never) continue;
                    for (const double half_turn : {1.0, -1.0}) {
                        const Matrix3 hand = Vector3(half_turn, mirrored ? -half_turn : half_turn, 1).asDiagonal();
                        const Matrix3 orthogonal = frame_of(found[k]) * hand * frame_of(seed).transpose();
                        all.push_back({.pose = similarity_from_orthogonal(
                                           scale, orthogonal, found[k].point - scale * (orthogonal * seed.point)),
                                       .flip = flip,
                                       .seed = i,
                                       .solution = k});
                    }
                }
        }
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
        progress.check();
        vote(solutions, all[k]);
        improve(solutions, all[k]);
    });
    std::stable_sort(all.begin(), all.end(), better);
    std::vector<Hypothesis> result;
    for (const Hypothesis& hypothesis : all) {
        if (result.size() == most) break;
        if (std::none_of(result.begin(), result.end(), [&](const Hypothesis& other) {
                return distance_.relative(hypothesis.pose, other.pose) < same_hypothesis;
            }))
            result.push_back(hypothesis);
    }
    return result;
}

double CurvaturePointSearch::objective(double scale, const Progress& progress) const {
    const TableGround ground(original_.table);
    double best = 0.0;
    for (const Hypothesis& hypothesis : poses(scale, 0.0, most_scored, progress))
        best = std::max(best, quick_score(ground, oriented_, suspect_.features.samples, samples_, hypothesis.pose,
                                          objective_tolerance * scale * length_, best));
    return 1.0 - best;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

Proposals first_words(const CurvaturePointSearch& search) {
    if (search.seeds().empty() || search.faces() == 0)
        return {.why = std::string("kh: ") + (search.faces() == 0 ? "the original" : "the suspect") +
                       " has no face on which Gaussian and mean curvature together tell the place"};
    return {.why = "kh: " + std::to_string(search.seeds().size()) + " points of the suspect"};
}

void hand_on(const std::vector<Hypothesis>& poses, Proposals& result) {
    for (const Hypothesis& hypothesis : poses) result.poses.push_back({hypothesis.pose, MatchMethod::kh});
}

}  // namespace

Proposals poses_by_curvature_points_at(const PreparedModel& original, const PreparedModel& suspect,
                                       std::span<const double> scales, const CurvaturePointMatching& options,
                                       const Progress& progress) {
    const CurvaturePointSearch search(original, suspect, options, progress);
    Proposals result = first_words(search);
    if (search.seeds().empty() || search.faces() == 0) return result;
    std::vector<Hypothesis> all;
    for (const double scale : scales) {
        std::vector<Hypothesis> poses = search.poses(scale, 0.0, most_proposals, progress);
        if (poses.empty() || poses.front().votes < enough_votes) {
            const std::vector<Hypothesis> more = search.poses(scale, loose, most_proposals, progress);
            poses.insert(poses.end(), more.begin(), more.end());
        }
        all.insert(all.end(), poses.begin(), poses.end());
    }
    std::stable_sort(all.begin(), all.end(), better);
    hand_on(all, result);
    if (result.poses.empty()) result.why += " have no counterpart on the original";
    return result;
}

Proposals poses_by_curvature_points(const PreparedModel& original, const PreparedModel& suspect,
                                    const CurvaturePointMatching& options, const Progress& progress) {
    if (options.scale.kind == ScaleChoice::Kind::fixed) {
        const double one = 1.0;
        return poses_by_curvature_points_at(original, suspect, {&one, 1}, options, progress);
    }
    const CurvaturePointSearch search(original, suspect, options, progress);
    Proposals result = first_words(search);
    if (search.seeds().empty() || search.faces() == 0) return result;

    double low = options.scale.low, high = options.scale.high;
    if (options.scale.kind == ScaleChoice::Kind::automatic) {
        const double ratio = shape_size(original.features).length / search.length();
        low = smallest_part * ratio;
        high = largest_part * ratio;
    }
    const double from = std::log(low), to = std::log(high);
    const int count = 2 + static_cast<int>((to - from) / std::log(scan_step));
    int evaluated = 0;
    const auto objective = [&](double log_scale) {
        const double value = search.objective(std::exp(log_scale), progress);
        // The number of evaluations of the minima's search is not known before.
        progress.report(std::min(1.0, ++evaluated / (count + 10.0 * most_minima)), "searching the scale");
        return value;
    };
    const std::vector<Minimum> minima =
        scanned_minima(objective, from, to, count, most_minima, [&](double a, double b) {
            return options.scale_search == ScaleSearch::brent ? brent_minimum(objective, a, b, scale_accuracy)
                                                              : golden_section_minimum(objective, a, b, scale_accuracy);
        });
    for (const Minimum& minimum : minima)
        hand_on(search.poses(std::exp(minimum.at), 0.0, most_proposals / most_minima, progress), result);
    result.why += ", scale searched in " + number(low) + ":" + number(high) + " by " +
                  (options.scale_search == ScaleSearch::brent ? "Brent's method" : "the golden section") + ", " +
                  std::to_string(evaluated) + " times";
    if (!minima.empty()) result.why += ", best near " + number(std::exp(minima.front().at));
    return result;
}

}  // namespace umbilic
