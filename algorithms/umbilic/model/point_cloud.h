// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Measured points, with the triangles between them if a mesh was given. Lengths in mm: point files state no unit, so
/// their numbers are taken for millimetres, which source.unit says.
struct PointCloud {
    Source source;       ///< format "points"
    std::string layout;  ///< how the file held them, e.g. "PLY binary little-endian"
    std::vector<Vector3> points;
    std::vector<Vector3> normals;               ///< unit vectors, one a point, or none
    std::vector<std::array<int, 3>> triangles;  ///< indices of points, counter-clockwise seen from outside; or none

    // What clean() took away.
    std::uint64_t not_finite = 0;            ///< points with a coordinate that is NaN or infinite
    std::uint64_t merged = 0;                ///< points whose coordinates repeat those of an earlier one
    std::uint64_t degenerate_triangles = 0;  ///< with two equal corners, or a corner that was dropped
    std::uint64_t thinned_out = 0;           ///< what thin_out() took away
    std::vector<std::string> warnings;

    bool is_mesh() const { return !triangles.empty(); }
    BoundingBox box() const;
};

/// Drops points that are not finite, merges those with equal coordinates (the first stays in its place), leaves out
/// triangles that degenerate thereby, and counts all three. Normals that are not finite or 0 make all normals unusable
/// and are dropped with a warning; the others are brought to unit length. Throws InvalidInput if a triangle refers to a
/// point that does not exist, or the number of normals does not fit.
void clean(PointCloud& cloud);

/// Area of one triangle, mm^2.
double triangle_area(const PointCloud& cloud, const std::array<int, 3>& triangle);

/// Normals of the cloud's points: its own, or the sums of those of the triangles around each point weighted by area
/// (not of unit length; 0 at points of no triangle); none without either.
std::vector<Vector3> outward_normals(const PointCloud& cloud);

/// Leaves `most` points (at least 1), chosen at random by `seed`, in their order, with a warning that says so; nothing
/// happens if there are no more. A mesh becomes a cloud with normals, as its triangles lose their corners; the points
/// of a mesh that belong to no triangle go first.
void thin_out(PointCloud& cloud, std::size_t most, std::uint64_t seed = 0);

}  // namespace umbilic
