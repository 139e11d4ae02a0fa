// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/match.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <umbilic/core/errors.h>
#include <umbilic/matching/by_analytic_faces.h>
#include <umbilic/matching/by_curvature_points.h>
#include <umbilic/matching/by_given_pairs.h>
#include <umbilic/matching/by_moments.h>
#include <umbilic/matching/by_principal_frame.h>
#include <umbilic/matching/by_umbilic_lines.h>
#include <umbilic/matching/by_umbilics.h>
#include <umbilic/matching/copies.h>
#include <umbilic/matching/decision.h>
#include <umbilic/matching/fix_by_borders.h>
#include <umbilic/matching/match_points.h>
#include <umbilic/matching/pose_search.h>

namespace umbilic {

namespace {

/// Poses of one method that are refined. Moments and analytic faces: a cube has 48 symmetries. Open: all are as good.
constexpr int refined_poses = 16, refined_moments = 48, refined_analytic = 48, refined_open = 12;
/// The same in the search for further copies.
constexpr int refined_copies = 48;
/// How far the hypotheses of a method may be off, as a part of the suspect's length: one umbilic of a re-approximated
/// copy turns by a few degrees, sampled rotations are up to 15 degrees off, given pairs and poses may be rough, a
/// principal frame comes from the nearest sample, votes of the method kh agree within 0.05; analytic faces are known to
/// rounding or, approximated, to 3e-3.
constexpr double analytic_error = 5e-3, umbilics_error = 0.08, moments_error = 0.25, given_error = 0.25,
                 curvature_error = 0.15, kh_error = 0.1;
/// Seeds looked up first, and those looked up without the third order: on exact and re-approximated surfaces nearly
/// every single seed succeeds.
constexpr int first_seeds = 3, second_order_seeds = 6;
/// Faces of the suspect that propose poses by themselves: the largest ones, from this part of the area on.
constexpr std::size_t most_faces = 8;
constexpr double least_face_share = 0.05;

Proposals given_poses(const MatchOptions& options, const std::vector<ConsistentPointFit>& pairs) {
    Proposals result;
    if (options.initial) {
        result.poses.push_back({*options.initial, MatchMethod::given});
        result.why = "the initial pose";
    }
    if (pairs.empty()) return result;
    for (const ConsistentPointFit& fit : pairs) result.poses.push_back({fit.original_suspect, MatchMethod::given});
    result.why += (result.why.empty() ? "" : ", ") + described(pairs);
    return result;
}

enum class Seeds { first, others, second_order };

/// Poses from single points with their principal frames, seeds on the suspect or (`swapped`) on the original, for a
/// suspect of which only a part comes from the original.
Proposals poses_by_principal_frame(const PreparedModel& original, const PreparedModel& suspect,
                                   const MatchOptions& match, Seeds seeds, bool swapped, const Progress& progress) {
    const bool third_order = seeds != Seeds::second_order;
    PrincipalFrameOptions options{.third_order = third_order,
                                  .flip_normals = !(original.model.oriented() && suspect.model.oriented()),
                                  .scale = swapped ? match.scale.inverse() : match.scale,
                                  .mirror = match.mirror};
    if (seeds == Seeds::first) options.seeds = first_seeds;
    if (seeds == Seeds::others) options.first_seed = first_seeds;
    if (seeds == Seeds::second_order) options.seeds = second_order_seeds;
    Proposals result{.why = third_order ? "curvature: third order" : "curvature: second order"};
    if (seeds == Seeds::others) result.why += " at further points";
    if (swapped) result.why += " from the original's side";
    const auto poses = swapped ? propose_by_principal_frame(suspect.table, original.table, options, progress)
                               : propose_by_principal_frame(original.table, suspect.table, options, progress);
    for (const PoseCandidate& pose : poses)
        result.poses.push_back(
            {swapped ? pose.original_suspect.inverse() : pose.original_suspect, MatchMethod::curvature});
    if (result.poses.empty()) result.why += " proposed no pose";
    return result;
}

/// The same from single faces of the suspect, each tested on itself: what else the suspect holds may be foreign.
Proposals poses_by_faces(const PreparedModel& original, const PreparedModel& suspect, const MatchOptions& match,
                         const Progress& progress) {
    const PrincipalFrameOptions options{.flip_normals = !(original.model.oriented() && suspect.model.oriented()),
                                        .scale = match.scale,
                                        .mirror = match.mirror};
    std::vector<const Face*> faces;
    for (const Face& face : suspect.model.faces)
        if (face.area >= least_face_share * suspect.model.area) faces.push_back(&face);
    std::stable_sort(faces.begin(), faces.end(), [](const Face* a, const Face* b) { return a->area > b->area; });
    if (faces.size() > most_faces) faces.resize(most_faces);
    Proposals result{.why = "curvature: third order, " + std::to_string(faces.size()) + " faces one by one"};
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Progress part = progress.part(double(i) / faces.size(), double(i + 1) / faces.size());
        for (const PoseCandidate& pose :
             propose_by_principal_frame(original.table, suspect.table.of_face(faces[i]->number), options, part))
            result.poses.push_back({pose.original_suspect, MatchMethod::curvature});
    }
    return result;
}

/// Poses from points of equal Gaussian and mean curvature, seeds on the suspect or (`swapped`) on the original, for a
/// suspect of which only a part comes from the original.
Proposals kh_poses(const PreparedModel& original, const PreparedModel& suspect, const MatchOptions& options,
                   bool swapped, const Progress& progress) {
    const CurvaturePointMatching matching{.scale = swapped ? options.scale.inverse() : options.scale,
                                          .scale_search = options.scale_search,
                                          .mirror = options.mirror,
                                          .solver = options.curvature_solver};
    if (!swapped) return poses_by_curvature_points(original, suspect, matching, progress);
    Proposals result = poses_by_curvature_points(suspect, original, matching, progress);
    for (PoseHypothesis& pose : result.poses) pose.original_suspect = pose.original_suspect.inverse();
    result.why += " (the two models exchanged)";
    return result;
}

}  // namespace

void check_options(const MatchOptions& options) {
    if (options.tolerance && !(std::isfinite(*options.tolerance) && *options.tolerance > 0.0))
        throw InvalidInput("match: the tolerance must be a positive length in mm");
    if (options.scale.kind == ScaleChoice::Kind::range &&
        !(options.scale.low > 0.0 && std::isfinite(options.scale.high) && options.scale.low <= options.scale.high))
        throw InvalidInput("match: the range of the scale must be LOW:HIGH with 0 < LOW <= HIGH");
    if (!(options.umbilic_invariant_tolerance > 0.0))
        throw InvalidInput("match: the tolerance of umbilic invariants must be positive");
    if (options.seconds && !(*options.seconds > 0.0))
        throw InvalidInput("match: the time limit must be a positive number of seconds");
    if (options.initial && !(options.initial->scale > 0.0 && options.initial->translation.allFinite() &&
                             options.initial->rotation.allFinite()))
        throw InvalidInput("match: the initial pose must be finite with a positive scale");
}

Alignment match(const PreparedModel& original, const PreparedModel& suspect, const MatchOptions& options,
                const Progress& progress) {
    check_options(options);
    check_method(options.method, false);
    PoseSearch search(original, suspect, options);
    std::string tried;
    const auto consider = [&](const Proposals& proposals, int keep, double error, const Progress& part) {
        tried += (tried.empty() ? "" : "; ") + proposals.why;
        search.consider(proposals, keep, error, part);
    };

    const std::vector<ConsistentPointFit> pairs = fit_given_pairs(options);
    if (options.initial || !pairs.empty())
        consider(given_poses(options, pairs), refined_poses, given_error, progress.part(0.0, 0.05));
    bool conclusive = false;
    const auto wanted = [&](MethodChoice method) {
        return (options.method == MethodChoice::automatic || options.method == method) && !conclusive &&
               !search.out_of_time() && !settled(search);
    };
    if (wanted(MethodChoice::analytic)) {
        const Proposals proposals =
            poses_by_analytic_faces(original, suspect, options.scale, options.mirror, progress.part(0.05, 0.08));
        consider(proposals, proposals.open ? refined_open : refined_analytic, analytic_error, progress.part(0.08, 0.1));
        conclusive = proposals.conclusive;
    }
    if (wanted(MethodChoice::umbilics))
        consider(poses_by_umbilics(original, suspect, options.scale, options.mirror,
                                   options.umbilic_invariant_tolerance, progress.part(0.1, 0.3)),
                 refined_poses, umbilics_error, progress.part(0.3, 0.5));
    if (options.method == MethodChoice::umbilic_lines && wanted(options.method))
        consider(poses_by_umbilic_lines(original, suspect, options.scale, options.mirror,
                                        options.umbilic_invariant_tolerance, progress.part(0.1, 0.3)),
                 refined_poses, umbilics_error, progress.part(0.3, 0.5));
    if (options.method == MethodChoice::umbilic_kh && wanted(options.method))
        consider(poses_by_umbilic_scale(
                     original, suspect,
                     {.scale = options.scale, .mirror = options.mirror, .solver = options.curvature_solver},
                     options.umbilic_invariant_tolerance, progress.part(0.1, 0.7)),
                 refined_poses, kh_error, progress.part(0.7, 0.9));
    // Moments belong to wholes: they say nothing of a piece.
    Proposals turned;
    if (wanted(MethodChoice::moments) &&
        (options.scope != ScopeChoice::partial || options.method == MethodChoice::moments)) {
        Proposals moments = poses_by_moments(original, suspect, options.scale, options.mirror);
        // Sampled turns are many and rough.
        if (moments.sampled && options.method == MethodChoice::automatic)
            turned = std::move(moments);
        else
            consider(moments, refined_moments, moments_error, progress.part(0.5, 0.6));
    }
    if (wanted(MethodChoice::curvature)) {
        const auto look_up = [&](double fraction, const auto& propose) {
            const Progress part = progress.part(fraction, fraction + 0.04);
            if (!search.out_of_time() && !settled(search))
                consider(propose(part.part(0.0, 0.5)), refined_poses, curvature_error, part.part(0.5, 1.0));
        };
        const auto whole = [&](Seeds seeds, bool swapped) {
            return [&, seeds, swapped](const Progress& part) {
                return poses_by_principal_frame(original, suspect, options, seeds, swapped, part);
            };
        };
        look_up(0.6, whole(Seeds::first, false));
        look_up(0.64, whole(Seeds::others, false));
        look_up(0.68, whole(Seeds::first, true));
        look_up(0.72, whole(Seeds::others, true));
        if (suspect.model.faces.size() > 1)
            look_up(0.76, [&](const Progress& part) { return poses_by_faces(original, suspect, options, part); });
        if (!turned.poses.empty() && wanted(MethodChoice::moments))
            consider(turned, refined_moments, moments_error, progress.part(0.8, 0.84));
        // Without the third order there are some hundred times as many hypotheses: last, and on one side.
        look_up(0.84, whole(Seeds::second_order, false));
    }
    if (options.method == MethodChoice::kh) {
        for (const bool swapped : {false, true}) {
            if (search.out_of_time() || settled(search)) break;
            const Progress part = swapped ? progress.part(0.75, 0.9) : progress.part(0.6, 0.75);
            consider(kh_poses(original, suspect, options, swapped, part.part(0.0, 0.8)), refined_poses, kh_error,
                     part.part(0.8, 1.0));
        }
    }
    // An original that was found as a whole may stand in the suspect more than once.
    if (options.method == MethodChoice::automatic && !search.out_of_time() && has_room_for_copies(search)) {
        consider(poses_by_umbilics(original, suspect, options.scale, options.mirror,
                                   options.umbilic_invariant_tolerance, progress.part(0.84, 0.85)),
                 refined_copies, umbilics_error, progress.part(0.85, 0.86));
        consider(poses_by_principal_frame(original, suspect, options, Seeds::first, true, progress.part(0.86, 0.87)),
                 refined_copies, curvature_error, progress.part(0.87, 0.88));
    }
    if (!search.out_of_time()) fix_by_borders(search, progress.part(0.88, 0.9));
    if (search.out_of_time()) tried += tried.empty() ? "nothing in the time allowed" : "; the time allowed was used up";
    progress.report(0.9, "comparing poses");
    Alignment alignment = decide_alignment(search, tried, progress.part(0.9, 1.0));
    alignment.copies = copies(alignment, original, suspect);
    alignment.given_pairs = judged_pairs(pairs, alignment.original_suspect.mirrored);
    if (options.scope == ScopeChoice::global && alignment.status == AlignmentStatus::found &&
        alignment.scope == MatchScope::partial) {
        alignment.status = AlignmentStatus::compatible;
        alignment.why = "Only a part coincides, and agreement as wholes was asked for: " + alignment.why;
    }
    progress.report(1.0, "matched");
    return alignment;
}

}  // namespace umbilic
