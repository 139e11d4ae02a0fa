// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <random>
#include <string>
#include <vector>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/prepared_model.h>
#include <umbilic/model/point_cloud.h>

namespace umbilic::bench {

/// An original with everything that is computed once, and a dense stock of points to cut suspects from.
struct PointOriginal {
    std::string name;
    Model model;
    std::unique_ptr<PreparedModel> prepared;
    std::vector<Vector3> stock;  ///< uniform by area
};

std::unique_ptr<PointOriginal> point_original(const std::string& name, Model model);

/// A scanned piece of an original in an unknown place.
struct PointTrial {
    PointCloud suspect;
    std::vector<Vector3> exact;  ///< the suspect's points without noise
    SimilarityTransform truth;   ///< suspect to original
};

struct TrialKind {
    double coverage = 1.0;      ///< share of `points` that a ball around a random point holds
    double noise = 0.0;         ///< standard deviation in each coordinate, relative to sqrt(area)
    bool unknown_scale = true;  ///< the scale is log-uniform in [0.3, 3], otherwise 1
    int points = 3000;          ///< at full coverage
};

PointTrial point_trial(const PointOriginal& original, const TrialKind& kind, std::mt19937_64& random);

inline constexpr double greatest_distance = 0.01, greatest_scale_error = 0.02;

/// Success: largest distance of the moved exact points from the original / sqrt(area) < 0.01 and the scale
/// within 2 %. `found` is the pose that was found.
struct TrialError {
    double distance = 0.0;  ///< relative to sqrt(area)
    double scale = 0.0;     ///< |s / s_true - 1|

    bool success() const { return distance < greatest_distance && scale < greatest_scale_error; }
};

TrialError trial_error(const PointOriginal& original, const PointTrial& trial, const SimilarityTransform& found);

/// Writes points as a PLY file, so that peers can run on the same trials.
void write_ply(const std::string& path, const std::vector<Vector3>& points);

}  // namespace umbilic::bench
