// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/differential/area_samples.h>
#include <umbilic/matching/principal_frame_table.h>
#include <umbilic/model/point_cloud.h>
#include <umbilic/points/bulk.h>
#include <umbilic/points/point_jets.h>
#include <umbilic/points/triangle_tree.h>

namespace umbilic {

struct PointFeatureOptions {
    std::size_t most_points = 100'000;  ///< of a larger cloud as many are used; see thin_out()
    int samples = 3000;                 ///< points that stand for the cloud; all points serve as their neighbours
    /// Without a radius the widest neighbourhood is taken over which the residual of the jets is still noise, from
    /// default_jet_radius on: curvatures of noisy points gain from it by the third power.
    JetOptions jets;
    std::uint64_t seed = 0;  ///< chooses the samples where there are more points
};

/// A cloud with everything computed once for it: jets at its samples and their table. Keeps a reference to the cloud.
struct PreparedPoints {
    const PointCloud& cloud;
    std::vector<AreaSample> samples;  ///< `at` without meaning; weights are areas; only the point holds where the
                                      ///< jet is not valid (curvature.regular false)
    std::vector<PointJet> jets;       ///< one a sample
    PrincipalFrameTable table;        ///< of the valid jets; only interior and well-determined ones propose poses
    std::unique_ptr<const TriangleTree> triangles;  ///< of a mesh; null of a cloud
    double area = 0.0;                              ///< mm^2, estimated (see point_weights())
    Bulk bulk;                ///< what lies apart from it counts for the shares, but proposes and refines no pose
    double length = 0.0;      ///< twice the root mean square distance of the bulk from its centroid, mm
    double jet_radius = 0.0;  ///< of the jets' neighbourhoods where points are not sparse, mm
    double noise = 0.0;       ///< standard deviation along the normal, mm (see estimated_noise())
    bool oriented = false;    ///< normals point to the outward side: the cloud had normals or triangles
};

/// The samples in the bulk.
std::vector<AreaSample> bulk_samples(const PreparedPoints& points);

/// Throws InvalidInput, naming the file, if there are fewer than fewest_points points or no jet is valid; Cancelled.
PreparedPoints prepare(const PointCloud& cloud, const PointFeatureOptions& options = {}, const Progress& progress = {});

/// Median of the standard deviations of the curvatures (the greater of the two at each jet), 1/mm; 0 without valid
/// jets.
double typical_curvature_error(const PreparedPoints& points);

/// Points of which nothing can be said are refused.
inline constexpr int fewest_points = 40;

}  // namespace umbilic
