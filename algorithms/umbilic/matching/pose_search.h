// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <vector>

#include <umbilic/matching/free_motions.h>
#include <umbilic/matching/match.h>
#include <umbilic/matching/pose_distance.h>
#include <umbilic/matching/pose_hypothesis.h>
#include <umbilic/matching/refine.h>
#include <umbilic/matching/score.h>
#include <umbilic/matching/table_ground.h>

namespace umbilic {

/// A refined pose with everything the decision needs.
struct ScoredPose {
    PoseHypothesis hypothesis;               ///< pose after refinement
    Refinement refinement;                   ///< of the smaller model on the larger one
    std::vector<double> suspect_distances;   ///< sample by sample, mm of the original
    std::vector<double> original_distances;  ///< of the original's samples from the suspect, mm of the original
    /// Motions that the surfaces would leave open and shared borders do not, and mm of the suspect's borders that show
    /// it.
    std::vector<FreeMotion> fixed_by_borders;
    double shared_borders = 0.0;
    bool approximate = false;  ///< distances are those of the table of samples: the pose was not worth more
    double length = 0.0;       ///< of the smaller of the original and the moved suspect, mm of the original
    double rank = 0.0;         ///< soft shares of both models within the re-approximation tolerance, in [0, 2]
};

/// Collects hypotheses from any method and keeps the best refined poses. Hypotheses are scored by one rule: the share
/// of the smaller model (original or moved suspect) that comes to lie on the larger one, judged on a few samples first.
/// Until a pose is near, distances are taken from the table of samples instead of the surface itself.
/// Results do not depend on the number of threads.
class PoseSearch {
public:
    PoseSearch(const PreparedModel& original, const PreparedModel& suspect, const MatchOptions& options);

    /// Scores the proposals, refines the best `keep` different ones and adds them. `start_cutoff`: how far they may be
    /// off, see RefineOptions. Throws Cancelled.
    void consider(const Proposals& proposals, int keep, double start_cutoff, const Progress& progress);

    /// Refines the pose at `index` of poses() on all samples; one that `fits`, with patience.
    void polish(std::size_t index, bool fits, const Progress& progress);

    /// Adds what becomes of the pose at `index` of poses() when the suspect moves by `move`, in the original's space:
    /// one of the places that a free motion runs through, or its mirror image, where borders of this length (mm) are
    /// shared.
    void fix(std::size_t index, const SimilarityTransform& move, const FreeMotion& motion, double shared_borders);

    /// Best first.
    const std::vector<ScoredPose>& poses() const { return poses_; }
    const Ground& original() const { return original_; }
    const Ground& suspect() const { return suspect_; }
    const PoseDistance& distance() const { return distance_; }
    const MatchOptions& options() const { return options_; }
    /// True once MatchOptions::seconds have passed since the search began.
    bool out_of_time() const;
    /// Lengths in mm that the files themselves leave open: conversion errors and stated tolerances of both models, the
    /// suspect's times `scale`.
    double stated_tolerance(double scale) const;
    /// True if the moved suspect is the larger of the two: then the original's samples are laid onto it.
    bool suspect_is_larger(double scale) const;

private:
    /// Points of either model, of which the smaller one's are laid onto the other.
    struct Points {
        std::vector<WeightedPoint> original, suspect;
    };
    /// Samples of either model that say whether an approached pose is promising.
    struct Judging {
        std::vector<int> original, suspect;
    };
    /// Brings a rough pose near with a few points on the tables of samples; false if too little comes to lie.
    bool approach(ScoredPose& pose, const Points& points, double start_cutoff, bool sampled,
                  const Progress& progress) const;
    /// Soft shares of both models, on the tables of samples, within the tolerance of measured shapes.
    double judged_shares(const SimilarityTransform& pose, const Judging& judging) const;
    /// Refines a near pose on the surfaces themselves; false if too little comes to lie.
    bool lay_on_surfaces(ScoredPose& pose, const Points& points, RefineOptions options, const Progress& progress) const;
    bool lay(ScoredPose& pose, const GroundSurface& ground, std::span<const WeightedPoint> points,
             const RefineOptions& options, const Progress& progress) const;
    /// Adds a measured pose, or lets it take the place of a worse one that is the same.
    void add(ScoredPose pose);
    void sort_poses();
    std::vector<ScoredPose>::iterator find_same(const ScoredPose& pose);
    /// Distances of all samples of both models.
    void measure(ScoredPose& pose, const GroundSurface& original, const GroundSurface& suspect) const;
    double soft_shares(const ScoredPose& pose, double relative_tolerance) const;
    double length(double scale) const;

    Ground original_;
    Ground suspect_;
    TableGround original_samples_;  ///< stands in for the surface while a pose is still rough
    TableGround suspect_samples_;
    MatchOptions options_;
    std::optional<std::chrono::steady_clock::time_point> deadline_;
    PoseDistance distance_;
    double original_length_ = 0.0;
    double suspect_length_ = 0.0;
    double best_shares_ = 0.0;  ///< of approached poses, see unpromising
    std::vector<ScoredPose> poses_;
};

}  // namespace umbilic
