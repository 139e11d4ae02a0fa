// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/free_motions.h>
#include <umbilic/model/face_adjacency.h>

namespace umbilic {

/// The borders of a model at which its surface ends or has a sharp edge (a bend above default_largest_bend), as points
/// a step apart. Smooth edges and seams, which files place as they like, take no part. Refers to the model.
class BorderSamples {
public:
    struct Sample {
        Vector3 point = Vector3::Zero();
        Vector3 tangent = Vector3::Zero();  ///< unit
        double length = 0.0;                ///< mm of border that it stands for
        int edge = 0;                       ///< index into the adjacency's edges
        double t = 0.0;                     ///< parameter on the edge's first use
    };

    /// `wanted`: about so many samples; every edge gets a few. Throws Cancelled.
    BorderSamples(const Model& model, int wanted, const Progress& progress = {});

    const std::vector<Sample>& samples() const { return samples_; }
    double step() const { return step_; }  ///< mm, greatest distance of neighbours on an edge
    /// The point of the sample's edge nearest to `point`.
    Vector3 foot(const Sample& sample, const Vector3& point) const;

private:
    FaceAdjacency adjacency_;
    std::vector<Sample> samples_;
    double step_ = 0.0;
};

/// Amounts, or places, with at least this part of the longest shared border are as good as the best one.
inline constexpr double as_long_border = 0.9;

/// An amount of a free motion (FreeMotion::by) that lays borders on borders.
struct SharedBorder {
    double amount = 0.0;
    /// mm of the suspect's borders that lie on the original's and would leave them if the motion went on: what runs
    /// along the motion does not count. Nor does the longest cross-section, because any end of a sweep can be laid on
    /// any other.
    double length = 0.0;
};

/// The amounts of a turn or slide at which most of the suspect's borders, placed by `pose`, come to lie on the
/// original's within `tolerance` (mm): the longest one and all within nine tenths of it, longest first. All lengths in
/// mm of the original. Empty for other motions, and where no border is shared. Borders vote for amounts in the space of
/// the motion's orbits (radius and height of a turn), then each amount is refined by least squares.
std::vector<SharedBorder> shared_borders(const FreeMotion& motion, const SimilarityTransform& pose,
                                         const BorderSamples& original, const BorderSamples& suspect, double tolerance,
                                         const Progress& progress = {});

}  // namespace umbilic
