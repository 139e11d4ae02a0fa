// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/core/similarity_transform.h>
#include <umbilic/matching/ground_surface.h>
#include <umbilic/matching/outward_normals.h>
#include <umbilic/matching/prepared_model.h>

namespace umbilic {

/// Two normals agree if the cosine of the angle between them is at least this (26 degrees): a foot on the other side of
/// a thin wall, or on a face that crosses the sample, does not count.
inline constexpr double agreeing_cosine = 0.9;

/// One model as the ground on which samples of another one are to lie.
struct Ground : GroundSurface {
    const PreparedModel& model;
    OutwardNormals normals;

    explicit Ground(const PreparedModel& prepared) : model(prepared), normals(prepared.model) {}
    std::optional<GroundFoot> foot(const Vector3& point, double limit) const override;
    std::optional<GroundFoot> foot_on_other_face(const Vector3& point, double limit,
                                                 const GroundFoot& foot) const override;

private:
    std::optional<GroundFoot> foot_without(const Vector3& point, double limit, int face) const;
};

/// Distances (mm of the ground) of all samples of `suspect`, moved by `ground_suspect`, from the ground; infinity where
/// it exceeds `limit` or where the normals at the foot disagree. Normals are compared with their signs if both models
/// are oriented, as lines otherwise, and not at all where the foot lies on an edge or corner of its face.
std::vector<double> sample_distances(const Ground& ground, const PreparedModel& suspect,
                                     const SimilarityTransform& ground_suspect, double limit);

/// The same on any ground; `oriented`: normals are compared with their signs.
std::vector<double> sample_distances(const GroundSurface& ground, bool oriented, const std::vector<AreaSample>& samples,
                                     const SimilarityTransform& ground_suspect, double limit);

/// What distances say at one tolerance; shares are weighted by area.
struct Coverage {
    double share = 0.0;  ///< within the tolerance
    double soft = 0.0;   ///< mean of max(0, 1 - (distance / tolerance)^2): also tells a better fit from a good one
    double rms = 0.0;    ///< of those within the tolerance
    double max = 0.0;    ///< of those within the tolerance
};

Coverage coverage(const std::vector<AreaSample>& samples, const std::vector<double>& distances, double tolerance);

/// `count` indices of samples, each standing for the same area, in an order whose every beginning is spread over the
/// whole model (van der Corput sequence over the accumulated area).
std::vector<int> spread_samples(const std::vector<AreaSample>& samples, int count);

/// The soft share of the given samples, abandoned (returning what was reached) as soon as it can no longer reach
/// `at_least`. `oriented`: normals are compared with their signs.
double quick_score(const GroundSurface& ground, bool oriented, const std::vector<AreaSample>& samples,
                   const std::vector<int>& which, const SimilarityTransform& ground_suspect, double tolerance,
                   double at_least);

}  // namespace umbilic
