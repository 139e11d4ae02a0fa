// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/decision.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include <umbilic/matching/copies.h>
#include <umbilic/matching/evidence.h>
#include <umbilic/matching/tolerances.h>

namespace umbilic {

namespace {

constexpr double whole = whole_share;
/// A coarser tolerance must raise the coverage by this factor to be preferred.
constexpr double worthwhile = 1.1;
/// Satisfied equations that a pose uses up, and those that must be left over: if the models agree as wholes, if one
/// lies on the other completely, and otherwise. Of 360 pairs of different mechanical parts and pieces of them with free
/// scale 14 coincided in parts with two or three over, by round numbers, and none completely with two.
constexpr int pose_unknowns = 4, spare_whole = 1, spare_piece = 2, spare_partial = 4;
/// A motion by this part of the length that stays within the tolerance leaves the pose undetermined.
constexpr double sliding = 0.1;
/// Two fits are equally good if the greater rms is within this factor of the smaller one (or below `negligible_rms` of
/// the length, which is rounding in files) and the shares differ by less than `equal_share`.
constexpr double equal_rms = 1.15, negligible_rms = 1e-7, equal_share = 0.02;
/// Of equally good fits one whose rms is smaller by this factor is preferred, down to the rounding of numbers relative
/// to the length.
constexpr double far_closer = 10.0, least_rms = 1e-13;
/// Symmetries that are completed at most; bodies of revolution have no end of them.
constexpr std::size_t most_symmetries = 120;
/// Samples that say whether a pose is worth being measured as a symmetry, and the part of the share that must be seen
/// on them: 48 of them differ from the whole by chance.
constexpr int screening_samples = 48;
constexpr double least_of_few = 0.8;
/// Runners-up that are reported.
constexpr std::size_t most_runners_up = 10;

struct Step {
    double relative = 0.0;        ///< tolerance as a part of the length
    double either_share = 0.0;    ///< needed of suspect or original
    double suspect_share = 0.0;   ///< needed of the suspect
    double original_share = 0.0;  ///< needed of the original
    FitLevel level = FitLevel::found;
};

constexpr std::array<Step, 4> steps = {{{FitTolerance::exact, 0.2, 0.0, 0.0, FitLevel::found},
                                        {FitTolerance::reapproximated, 0.6, 0.0, 0.0, FitLevel::found},
                                        {FitTolerance::measured, whole, whole, 0.3, FitLevel::found},
                                        {FitTolerance::resembling, whole, whole, whole, FitLevel::compatible}}};

/// The step that says how much must coincide at a tolerance.
std::size_t step_of(double relative_tolerance) {
    std::size_t i = 0;
    // The user's tolerance, or what files leave open, may lie a little above a step.
    while (i + 1 < steps.size() && relative_tolerance > 2.0 * steps[i].relative) ++i;
    return i;
}

std::string printed(const char* format, double a, double b = 0.0) {
    std::array<char, 128> text;
    std::snprintf(text.data(), text.size(), format, a, b);
    return text.data();
}

Fit fit_at(const ScoredPose& pose, const PoseSearch& search, double tolerance) {
    Fit fit{.tolerance = tolerance};
    fit.suspect = coverage(search.suspect().model.features.samples, pose.suspect_distances, tolerance);
    fit.original = coverage(search.original().model.features.samples, pose.original_distances, tolerance);
    return fit;
}

bool enough(const Fit& fit, const Step& step) {
    return std::max(fit.suspect.share, fit.original.share) >= step.either_share &&
           fit.suspect.share >= step.suspect_share && fit.original.share >= step.original_share;
}

bool as_wholes(const Fit& fit) {
    return fit.suspect.share >= whole && fit.original.share >= whole;
}

/// True if the models still agree as wholes when the suspect moves by `sliding` of its length.
bool keeps_outline(const FreeMotion& motion, const ScoredPose& pose, const PoseSearch& search, double tolerance) {
    const bool slides = motion.kind == FreeMotionKind::slide || motion.kind == FreeMotionKind::slide_in_plane;
    const double amount = 2.0 * sliding * (slides ? 0.5 * pose.length : 1.0);
    const SimilarityTransform moved = compose(motion.by(amount), pose.hypothesis.original_suspect);
    const auto& samples = search.suspect().model.features.samples;
    return coverage(samples, sample_distances(search.original(), search.suspect().model, moved, tolerance), tolerance)
               .share >= whole;
}

/// Motions by a tenth of the length that stay within the tolerance, in the original's coordinates.
std::vector<FreeMotion> open_motions(const ScoredPose& pose, const PoseSearch& search, const Fit& fit) {
    const bool free_scale = search.options().scale.kind != ScaleChoice::Kind::fixed;
    const Refinement& refinement = pose.refinement;
    std::vector<FreeMotion> motions = free_motions(refinement.normal_matrix, refinement.centre, refinement.radius,
                                                   fit.tolerance / (sliding * pose.length), free_scale);
    const SimilarityTransform& transform = pose.hypothesis.original_suspect;
    if (search.suspect_is_larger(transform.scale))
        for (FreeMotion& motion : motions) motion = motion.seen_through(transform);
    // Compared by kind: a second motion of one kind goes with the first (two slides are named slide_in_plane).
    std::erase_if(motions, [&](const FreeMotion& motion) {
        return std::any_of(pose.fixed_by_borders.begin(), pose.fixed_by_borders.end(),
                           [&](const FreeMotion& fixed) { return fixed.kind == motion.kind; });
    });
    if (as_wholes(fit))
        std::erase_if(motions,
                      [&](const FreeMotion& motion) { return !keeps_outline(motion, pose, search, fit.tolerance); });
    return motions;
}

void demand_evidence(const ScoredPose& pose, const PoseSearch& search, Fit& fit) {
    const double scale = pose.hypothesis.original_suspect.scale;
    const bool larger = search.suspect_is_larger(scale);
    // The smaller model lies on the larger one; its samples say what coincides.
    const int equations =
        larger ? satisfied_equations(search.original().model, pose.original_distances, fit.tolerance, 1.0)
               : satisfied_equations(search.suspect().model, pose.suspect_distances, fit.tolerance, scale);
    // A scale of 1 that nothing demanded is evidence for wholes only: stock and drills have the same sizes everywhere.
    const ScaleChoice& choice = search.options().scale;
    const bool known = choice.kind == ScaleChoice::Kind::fixed || std::abs(scale - 1.0) * pose.length <= fit.tolerance;
    fit.free_motions = open_motions(pose, search, fit);
    // A shared border that fixes a motion is one condition more.
    const int spare =
        equations + static_cast<int>(pose.fixed_by_borders.size()) - pose_unknowns + (known && as_wholes(fit) ? 1 : 0);
    const bool complete = fit.suspect.share >= whole || fit.original.share >= whole;
    if (spare < (as_wholes(fit) ? spare_whole : complete ? spare_piece : spare_partial)) {
        fit.level = FitLevel::compatible;
        fit.why = "what coincides are planes, cylinders, cones, spheres or tori that fit many shapes";
    } else if (!as_wholes(fit) && !fit.free_motions.empty()) {
        fit.level = FitLevel::compatible;
        fit.why = "what coincides can move along itself, so that the pose is not determined";
    }
}

/// The level of a fit that has to satisfy the given step.
Fit judged(const ScoredPose& pose, const PoseSearch& search, Fit fit, std::size_t step) {
    if (!enough(fit, steps[step])) {
        fit.why = "too little coincides";
        return fit;
    }
    fit.exact = step == 0;
    fit.level = steps[step].level;
    if (fit.level == FitLevel::compatible) fit.why = "the shapes resemble each other but do not coincide";
    if (fit.level == FitLevel::found) demand_evidence(pose, search, fit);
    return fit;
}

/// Judges at the tolerance that says most: a coarser step only where the finer one does not suffice or covers much
/// less.
Fit judge_by_steps(const ScoredPose& pose, const PoseSearch& search) {
    const double stated = search.stated_tolerance(pose.hypothesis.original_suspect.scale);
    Fit fit = fit_at(pose, search, FitTolerance::exact * pose.length + stated);
    std::size_t step = 0;
    for (std::size_t coarser = 1; coarser < steps.size(); ++coarser) {
        const bool sufficient = enough(fit, steps[step]);
        if (sufficient && steps[coarser].level != FitLevel::found) break;
        const Fit next = fit_at(pose, search, steps[coarser].relative * pose.length + stated);
        const double gain =
            std::max(next.suspect.share, next.original.share) / std::max(fit.suspect.share, fit.original.share);
        if (sufficient && !(gain > worthwhile && enough(next, steps[coarser]))) continue;
        fit = next;
        step = coarser;
    }
    return judged(pose, search, fit, step);
}

/// Share of a model that its own motion lays on itself.
double self_coverage(const Ground& model, const SimilarityTransform& motion, double tolerance) {
    return coverage(model.model.features.samples, sample_distances(model, model.model, motion, tolerance), tolerance)
        .share;
}

struct Ranked {
    std::size_t index = 0;
    Fit fit;
};

bool equally_good(const ScoredPose& best, const Fit& best_fit, const Fit& other_fit) {
    const double floor = negligible_rms * best.length;
    return other_fit.suspect.share >= best_fit.suspect.share - equal_share &&
           other_fit.original.share >= best_fit.original.share - equal_share &&
           other_fit.suspect.rms <= equal_rms * std::max(best_fit.suspect.rms, floor);
}

/// Order among equals: unmirrored before mirrored, then the one that turns least, then the nearest.
bool plainer(const SimilarityTransform& a, const SimilarityTransform& b) {
    if (a.mirrored != b.mirrored) return !a.mirrored;
    const double angle_a = rotation_angle_between(a.rotation, Matrix3::Identity());
    const double angle_b = rotation_angle_between(b.rotation, Matrix3::Identity());
    constexpr double same_angle = 1e-6;  // radians; only orders equals
    if (std::abs(angle_a - angle_b) > same_angle) return angle_a < angle_b;
    return a.translation.norm() < b.translation.norm();
}

/// Adds the poses that follow from those known: one symmetry after another is one more. Each is measured before it
/// counts.
void complete_symmetries(const PoseSearch& search, const SimilarityTransform& winner, const Fit& fit,
                         std::vector<SimilarityTransform>& symmetries, const Progress& progress) {
    std::vector<SimilarityTransform> known = {winner}, refused;
    known.insert(known.end(), symmetries.begin(), symmetries.end());
    const auto among = [&](const std::vector<SimilarityTransform>& poses, const SimilarityTransform& pose) {
        return std::any_of(poses.begin(), poses.end(),
                           [&](const SimilarityTransform& other) { return !search.distance().different(pose, other); });
    };
    // The model that is covered more says whether a pose is as good: of an assembly little may lie on the original.
    const bool by_original = fit.original.share > fit.suspect.share;
    const Ground &ground = by_original ? search.suspect() : search.original(),
                 &laid = by_original ? search.original() : search.suspect();
    const std::vector<AreaSample>& samples = laid.model.features.samples;
    const std::vector<int> few = spread_samples(samples, screening_samples);
    const bool oriented = ground.model.model.oriented() && laid.model.model.oriented();
    const double share = std::max(fit.suspect.share, fit.original.share);
    const auto as_good = [&](const SimilarityTransform& pose) {
        const SimilarityTransform ground_laid = by_original ? pose.inverse() : pose;
        const double tolerance = by_original ? fit.tolerance / pose.scale : fit.tolerance;
        // Soft shares within twice the tolerance: what lies within the tolerance counts three quarters at least.
        const double least = least_of_few * 0.75 * share;
        if (quick_score(ground, oriented, samples, few, ground_laid, 2.0 * tolerance, least) < least) return false;
        return coverage(samples, sample_distances(ground, laid.model, ground_laid, tolerance), tolerance).share >=
               share - equal_share;
    };
    for (std::size_t i = 1; i < known.size(); ++i)
        for (std::size_t j = 1; j < known.size(); ++j) {
            if (symmetries.size() >= most_symmetries) return;
            progress.check();
            const SimilarityTransform next = compose(compose(known[i], winner.inverse()), known[j]);
            if (among(known, next) || among(refused, next)) continue;
            if (!as_good(next)) {
                refused.push_back(next);
                continue;
            }
            known.push_back(next);
            symmetries.push_back(next);
        }
}

PoseCandidate candidate(const ScoredPose& pose, const Fit& fit) {
    return {pose.hypothesis.original_suspect,
            pose.hypothesis.method,
            fit.suspect.share,
            fit.original.share,
            fit.suspect.rms,
            fit.suspect.max};
}

std::string coverage_text(const Fit& fit) {
    return printed("%.1f %% of the suspect", 100.0 * fit.suspect.share) +
           printed(" and %.1f %% of the original coincide within %.3g mm", 100.0 * fit.original.share, fit.tolerance);
}

}  // namespace

Fit judge(const ScoredPose& pose, const PoseSearch& search) {
    const Fit derived = judge_by_steps(pose, search);
    if (!search.options().tolerance) return derived;
    const double wanted = *search.options().tolerance;
    Fit fit = fit_at(pose, search, wanted);
    if (derived.level == FitLevel::found && derived.tolerance <= wanted) {
        // What is found within a tighter tolerance is found; only the shares are those of the tolerance asked for.
        fit.level = derived.level;
        fit.exact = derived.exact;
        fit.free_motions = derived.free_motions;
        return fit;
    }
    return judged(pose, search, fit, step_of(wanted / pose.length));
}

bool settled(const PoseSearch& search) {
    if (search.poses().empty()) return false;
    const Fit fit = judge(search.poses().front(), search);
    // Standard parts recur within free-form designs: a part that analytic faces found may not be all that is to be
    // found.
    const bool enough_exactly = fit.exact && search.poses().front().hypothesis.method != MatchMethod::analytic;
    return fit.level == FitLevel::found && (enough_exactly || std::max(fit.suspect.share, fit.original.share) >= whole);
}

bool has_room_for_copies(const PoseSearch& search) {
    if (search.poses().empty()) return false;
    const Fit fit = judge(search.poses().front(), search);
    return fit.level == FitLevel::found && fit.original.share >= whole &&
           1.0 - fit.suspect.share >= whole * fit.suspect.share;
}

Alignment decide_alignment(PoseSearch& search, const std::string& tried, const Progress& progress) {
    Alignment alignment;
    if (search.poses().empty()) {
        alignment.why = "No pose lays enough of one model on the other to be refined: " + tried + ".";
        return alignment;
    }
    const auto& poses = search.poses();
    search.polish(0, judge(poses[0], search).level != FitLevel::none, progress);

    // The best pose of the highest level.
    Ranked best{0, judge(poses[0], search)};
    for (std::size_t i = 1; i < poses.size(); ++i) {
        Fit fit = judge(poses[i], search);
        if (fit.level < best.fit.level) continue;
        const bool as_much = fit.suspect.share >= best.fit.suspect.share - equal_share &&
                             fit.original.share >= best.fit.original.share - equal_share;
        const bool more_fixed = as_much && poses[i].fixed_by_borders.size() > poses[best.index].fixed_by_borders.size();
        // Along a valley that is all but flat the shares differ by chance only.
        const bool much_closer =
            as_much && poses[i].fixed_by_borders.size() == poses[best.index].fixed_by_borders.size() &&
            far_closer * std::max(fit.suspect.rms, least_rms * poses[i].length) < best.fit.suspect.rms;
        if (fit.level > best.fit.level || more_fixed || much_closer) best = {i, std::move(fit)};
    }
    // At one tolerance for all: poses that do as well, and the plainest of them as the winner.
    std::vector<Ranked> equals = {best};
    std::vector<Ranked> others;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (i == best.index) continue;
        progress.check();
        Ranked other{i, fit_at(poses[i], search, best.fit.tolerance)};
        // Where borders fix a motion, all that it could run through is equally covered, but not as good.
        const bool equal = best.fit.level != FitLevel::none && equally_good(poses[best.index], best.fit, other.fit) &&
                           poses[i].fixed_by_borders.size() >= poses[best.index].fixed_by_borders.size() &&
                           search.distance().different(poses[best.index].hypothesis.original_suspect,
                                                       poses[i].hypothesis.original_suspect);
        (equal ? equals : others).push_back(std::move(other));
    }
    std::stable_sort(equals.begin(), equals.end(), [&](const Ranked& a, const Ranked& b) {
        return plainer(poses[a.index].hypothesis.original_suspect, poses[b.index].hypothesis.original_suspect);
    });
    if (equals.front().index != best.index) {
        const std::size_t winner = equals.front().index;
        search.polish(winner, best.fit.level != FitLevel::none, progress);
        Fit fit = fit_at(poses[winner], search, best.fit.tolerance);
        fit.level = best.fit.level;
        fit.exact = best.fit.exact;
        fit.why = best.fit.why;
        if (!best.fit.free_motions.empty()) fit.free_motions = open_motions(poses[winner], search, fit);
        best = {winner, std::move(fit)};
    }
    const ScoredPose& winner = poses[best.index];
    const SimilarityTransform& pose = winner.hypothesis.original_suspect;

    const auto reached_from = [&](const SimilarityTransform& known, const SimilarityTransform& other) {
        return std::any_of(best.fit.free_motions.begin(), best.fit.free_motions.end(), [&](const FreeMotion& motion) {
            const std::optional<double> amount = motion.amount_of(compose(other, known.inverse()));
            return amount && !search.distance().different(compose(motion.by(*amount), known), other);
        });
    };
    std::size_t strangers = 0;
    for (std::size_t k = 1; k < equals.size(); ++k) {
        progress.check();
        const SimilarityTransform& other = poses[equals[k].index].hypothesis.original_suspect;
        // The free motion tells these already.
        if (reached_from(pose, other) ||
            std::any_of(alignment.symmetries.begin(), alignment.symmetries.end(),
                        [&](const SimilarityTransform& known) { return reached_from(known, other); }))
            continue;
        const bool symmetry =
            best.fit.exact ||
            self_coverage(search.original(), compose(other, pose.inverse()), best.fit.tolerance) >= whole ||
            self_coverage(search.suspect(), compose(pose.inverse(), other), best.fit.tolerance / pose.scale) >= whole;
        if (symmetry)
            alignment.symmetries.push_back(other);
        else
            ++strangers;
        alignment.runners_up.push_back(candidate(poses[equals[k].index], equals[k].fit));
    }
    // Where a motion is free there is no end of them, and the motion tells them all.
    if (strangers == 0 && best.fit.free_motions.empty())
        complete_symmetries(search, pose, best.fit, alignment.symmetries, progress);
    std::stable_sort(others.begin(), others.end(), [&](const Ranked& a, const Ranked& b) {
        return a.fit.suspect.soft + a.fit.original.soft > b.fit.suspect.soft + b.fit.original.soft;
    });
    for (const Ranked& other : others) {
        const SimilarityTransform& its_pose = poses[other.index].hypothesis.original_suspect;
        if (alignment.runners_up.size() >= most_runners_up) break;
        if (search.distance().different(pose, its_pose))
            alignment.runners_up.push_back(candidate(poses[other.index], other.fit));
    }

    const Fit& fit = best.fit;
    alignment.tolerance = fit.tolerance;
    if (fit.level == FitLevel::none) {
        alignment.why =
            "No pose lays enough of one model on the other: at best " + coverage_text(fit) + "; " + tried + ".";
        alignment.runners_up.insert(alignment.runners_up.begin(), candidate(winner, fit));
        return alignment;
    }
    alignment.method = winner.hypothesis.method;
    alignment.original_suspect = pose;
    alignment.scope = as_wholes(fit) ? MatchScope::global : MatchScope::partial;
    alignment.rms = fit.suspect.rms;
    alignment.max = fit.suspect.max;
    alignment.relative_max = fit.suspect.max / search.original().model.model.size();
    alignment.suspect_coverage = fit.suspect.share;
    alignment.original_coverage = fit.original.share;
    alignment.why = coverage_text(fit);
    if (!winner.fixed_by_borders.empty())
        alignment.why += printed(
                             "; borders that both share, %.3g mm of them, fix the pose where the surfaces alone "
                             "would leave it free: the suspect ",
                             winner.shared_borders) +
                         in_words(winner.fixed_by_borders);
    alignment.free_motions = fit.free_motions;
    const bool open = fit.level == FitLevel::compatible && !fit.free_motions.empty();
    if (strangers > 0 && !open) {
        alignment.status = AlignmentStatus::ambiguous;
        alignment.why +=
            "; but " + std::to_string(strangers) + " different pose" + (strangers > 1 ? "s fit" : " fits") + " as well";
    } else if (fit.level == FitLevel::compatible) {
        alignment.status = AlignmentStatus::compatible;
        alignment.why += "; but " + fit.why;
        if (open) alignment.why += ": the suspect still " + in_words(fit.free_motions);
    } else {
        alignment.status = AlignmentStatus::found;
        if (!alignment.symmetries.empty())
            alignment.why += "; by symmetry or repetition " + std::to_string(alignment.symmetries.size()) +
                             " more pose" + (alignment.symmetries.size() > 1 ? "s fit" : " fits") + " as well";
        if (!fit.free_motions.empty())
            alignment.why += "; on the original the suspect still " + in_words(fit.free_motions);
    }
    alignment.why += ". Tried: " + tried + ".";
    return alignment;
}

}  // namespace umbilic
