// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

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
    double length = 0.0;  ///< of the smaller of the original and the moved suspect, mm of the original
    double rank = 0.0;    ///< soft shares of both models within the re-approximation tolerance, in [0, 2]
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

    /// Refines the pose at `index` of poses() on all samples.
    void polish(std::size_t index, const Progress& progress);

    /// Best first.
    const std::vector<ScoredPose>& poses() const { return poses_; }
    const Ground& original() const { return original_; }
    const Ground& suspect() const { return suspect_; }
    const PoseDistance& distance() const { return distance_; }
    const MatchOptions& options() const { return options_; }
    /// Lengths in mm that the files themselves leave open: conversion errors and stated tolerances of both models, the
    /// suspect's times `scale`.
    double stated_tolerance(double scale) const;
    /// True if the moved suspect is the larger of the two: then the original's samples are laid onto it.
    bool suspect_is_larger(double scale) const;

private:
    ScoredPose refined(const PoseHypothesis& hypothesis, const std::vector<WeightedPoint>& original_points,
                       const std::vector<WeightedPoint>& suspect_points, double start_cutoff,
                       const Progress& progress) const;
    double length(double scale) const;

    Ground original_;
    Ground suspect_;
    TableGround original_samples_;  ///< stands in for the surface while a pose is still rough
    TableGround suspect_samples_;
    MatchOptions options_;
    PoseDistance distance_;
    double original_length_ = 0.0;
    double suspect_length_ = 0.0;
    std::vector<ScoredPose> poses_;
};

}  // namespace umbilic
