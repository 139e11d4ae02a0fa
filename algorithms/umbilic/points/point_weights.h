// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <umbilic/model/point_cloud.h>
#include <umbilic/points/neighbours.h>

namespace umbilic {

/// Of points strewn by chance over a surface the sparsest of a million stands for some five times the median.
inline constexpr double greatest_point_weight = 10.0;

/// Area in mm^2 that each point stands for: a third of its triangles' areas on a mesh; on a cloud that of the disc up
/// to its eighth neighbour, divided by eight, and no more than greatest_point_weight times the median: the disc of a
/// point that lies apart says nothing of an area. Their sum estimates the area (on a cloud it is a little too great at
/// borders and too small where noise lifts points off the surface).
std::vector<double> point_weights(const PointCloud& cloud, const Neighbours& neighbours);

}  // namespace umbilic
