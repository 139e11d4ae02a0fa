// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/match.h>

#include <cmath>
#include <string>

#include <umbilic/core/errors.h>
#include <umbilic/matching/by_moments.h>
#include <umbilic/matching/by_umbilics.h>
#include <umbilic/matching/decision.h>
#include <umbilic/matching/horn.h>
#include <umbilic/matching/pose_search.h>

namespace umbilic {

namespace {

/// Poses of one method that are refined.
constexpr int refined_poses = 16;
/// How far the hypotheses of a method may be off, as a part of the suspect's length: one umbilic of a re-approximated
/// copy turns by a few degrees, sampled rotations are up to 15 degrees off, given pairs and poses may be rough.
constexpr double umbilics_error = 0.08, moments_error = 0.25, given_error = 0.25;

void check(const MatchOptions& options) {
    if (options.tolerance && !(std::isfinite(*options.tolerance) && *options.tolerance > 0.0))
        throw InvalidInput("match: the tolerance must be a positive length in mm");
    if (options.scale.kind == ScaleChoice::Kind::range &&
        !(options.scale.low > 0.0 && std::isfinite(options.scale.high) && options.scale.low <= options.scale.high))
        throw InvalidInput("match: the range of the scale must be LOW:HIGH with 0 < LOW <= HIGH");
    if (!(options.umbilic_invariant_tolerance > 0.0))
        throw InvalidInput("match: the tolerance of umbilic invariants must be positive");
    if (options.initial && !(options.initial->scale > 0.0 && options.initial->translation.allFinite() &&
                             options.initial->rotation.allFinite()))
        throw InvalidInput("match: the initial pose must be finite with a positive scale");
}

Proposals given_poses(const MatchOptions& options) {
    Proposals result;
    if (options.initial) {
        result.poses.push_back({*options.initial, MatchMethod::given});
        result.why = "the initial pose";
    }
    if (options.pairs.empty()) return result;
    std::vector<PointPair> pairs;
    for (const auto& [original, suspect] : options.pairs) pairs.push_back({original, suspect});
    const bool free_scale = options.scale.kind != ScaleChoice::Kind::fixed;
    for (const bool mirrored : {false, true}) {
        if (mirrored && options.mirror == MirrorChoice::never) continue;
        const PointFit fit = fit_points(pairs, {.free_scale = free_scale, .mirrored = mirrored});
        result.poses.push_back({fit.original_suspect, MatchMethod::given});
    }
    result.why += (result.why.empty() ? "" : ", ") + std::to_string(pairs.size()) + " given pairs of points";
    return result;
}

}  // namespace

Alignment match(const PreparedModel& original, const PreparedModel& suspect, const MatchOptions& options,
                const Progress& progress) {
    check(options);
    PoseSearch search(original, suspect, options);
    std::string tried;
    const auto consider = [&](const Proposals& proposals, double error, const Progress& part) {
        tried += (tried.empty() ? "" : "; ") + proposals.why;
        search.consider(proposals, refined_poses, error, part);
    };

    if (options.initial || !options.pairs.empty()) consider(given_poses(options), given_error, progress.part(0.0, 0.1));
    const bool automatic = options.method == MethodChoice::automatic;
    if (!settled(search) && (automatic || options.method == MethodChoice::umbilics))
        consider(poses_by_umbilics(original, suspect, options.scale, options.mirror,
                                   options.umbilic_invariant_tolerance, progress.part(0.1, 0.3)),
                 umbilics_error, progress.part(0.3, 0.6));
    // Moments belong to wholes: they say nothing of a piece.
    const bool wholes = options.scope != ScopeChoice::partial || options.method == MethodChoice::moments;
    if (!settled(search) && wholes && (automatic || options.method == MethodChoice::moments))
        consider(poses_by_moments(original, suspect, options.scale, options.mirror), moments_error,
                 progress.part(0.6, 0.8));
    progress.report(0.9, "comparing poses");
    Alignment alignment = decide_alignment(search, tried, progress.part(0.9, 1.0));
    if (options.scope == ScopeChoice::global && alignment.status == AlignmentStatus::found &&
        alignment.scope == MatchScope::partial) {
        alignment.status = AlignmentStatus::compatible;
        alignment.why = "Only a part coincides, and agreement as wholes was asked for: " + alignment.why;
    }
    progress.report(1.0, "matched");
    return alignment;
}

}  // namespace umbilic
