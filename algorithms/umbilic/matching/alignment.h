// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/free_motions.h>

namespace umbilic {

/// found: one pose, over-determined and clearly better than any other; ambiguous: several different poses fit;
/// compatible: it fits, but there is too little evidence; not_found: nothing fits.
enum class AlignmentStatus { found, ambiguous, compatible, not_found };

enum class MatchMethod { none, given, analytic, umbilics, umbilic_lines, umbilic_kh, moments, curvature, kh, points };

/// global: suspect and original as wholes; partial: the suspect is (or contains) a part of the original.
enum class MatchScope { global, partial };

/// One pose of the suspect, with how well it fits.
struct PoseCandidate {
    SimilarityTransform original_suspect;
    MatchMethod method = MatchMethod::none;
    double score = 0.0;           ///< area-weighted share of the suspect within tolerance of the original, in [0, 1]
    double original_score = 0.0;  ///< the same of the original within tolerance of the suspect
    double rms = 0.0;  ///< root mean square distance of the samples that count as covered, mm of the original
    double max = 0.0;  ///< largest such distance
};

/// A given pair of corresponding points beside the similarity that the consistent ones among all pairs fix.
struct GivenPair {
    double residual = 0.0;  ///< mm of the original
    bool outlier = false;   ///< does not agree with the others and was left out
};

/// Where the suspect lies with respect to the original.
struct Alignment {
    AlignmentStatus status = AlignmentStatus::not_found;
    std::string why;  ///< one sentence: what was tried and how it ended
    MatchMethod method = MatchMethod::none;
    MatchScope scope = MatchScope::global;
    SimilarityTransform original_suspect;
    double tolerance = 0.0;  ///< mm of the original: distance within which a sample counts as lying on the other model
    double rms = 0.0;
    double max = 0.0;
    double relative_max = 0.0;      ///< max / sqrt(area of the original), the measure of the thesis
    double suspect_coverage = 0.0;  ///< share of the suspect's area that lies on the original
    double scale_deviation = 0.0;  ///< standard deviation of log(scale) that noise leaves; 0 where it was not estimated
    double original_coverage = 0.0;               ///< share of the original's area that the suspect covers
    std::vector<PoseCandidate> runners_up;        ///< other poses, best first
    std::vector<SimilarityTransform> symmetries;  ///< poses that fit equally well: composed with the inverse of the
                                                  ///< winner, symmetries of the original
    std::vector<SimilarityTransform> copies;      ///< one pose a place, see copies.h; more than one where the original
                                                  ///< stands in the suspect, or the suspect in the original, repeatedly
    std::vector<FreeMotion> free_motions;         ///< of the suspect on the original, that no distance tells
    std::vector<GivenPair> given_pairs;           ///< in the order given; empty without pairs

    bool found() const { return status == AlignmentStatus::found; }
};

const char* name(AlignmentStatus status);
const char* name(MatchMethod method);
const char* name(MatchScope scope);

}  // namespace umbilic
