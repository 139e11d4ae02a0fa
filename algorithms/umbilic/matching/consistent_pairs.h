// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/horn.h>

namespace umbilic {

/// Chance that of right pairs with normally distributed errors any is called wrong.
inline constexpr double false_outlier = 1e-3;

struct ConsistentPointFit {
    SimilarityTransform original_suspect;  ///< of the consistent pairs
    std::vector<double> residuals;         ///< of all pairs, in their order, mm of the original
    std::vector<int> outliers;             ///< pairs that were left out, from 0, increasing
    double rms = 0.0;                      ///< weighted, of the consistent pairs
    double max = 0.0;
    double deviation = 0.0;  ///< estimated standard deviation of a coordinate's error, mm of the original
};

/// fit_points() of pairs some of which may be wrong. Starts from the half of the pairs that agree best with one
/// similarity, by least trimmed squares from triples and concentration steps (Rousseeuw and Van Driessen 2006,
/// "Computing LTS regression for large data sets"; all triples if they are few, else a fixed choice of them), and takes
/// in the others one by one, nearest first, as long as the next one's prediction error passes an F test of its three
/// coordinates against the residuals so far (Hadi and Simonoff 1993, "Procedures for the identification of multiple
/// outliers in linear models"); the rest are the outliers. At least three pairs that do not lie on a line stay. Up to
/// half of the pairs may be wrong, if the right ones are more than the half, at least three, and not on a line.
/// Deterministic. Throws as fit_points does.
ConsistentPointFit fit_consistent_points(std::span<const PointPair> pairs, const PointFitOptions& options = {});

}  // namespace umbilic
