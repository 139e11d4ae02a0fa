// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include <TopoDS_Shape.hxx>
#include <gp_Trsf.hxx>

namespace umbilic::models {

/// p -> scale * rotation * M * p + translation, M = diag(-1, 1, 1) if mirrored, else the identity.
struct Similarity {
    double scale = 1;                                              // > 0
    std::array<double, 9> rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // row-major, determinant +1
    std::array<double, 3> translation = {0, 0, 0};                 // mm
    bool mirrored = false;
};

/// The pose used for a suspect: turned by `angle` (rad) about `axis`, then moved. The numbers are
/// arbitrary; they only must not be special (no axis direction, no right angle).
Similarity pose(double scale, std::array<double, 3> axis, double angle, std::array<double, 3> translation,
                bool mirrored = false);

Similarity inverse(const Similarity& similarity);

gp_Trsf to_trsf(const Similarity& similarity);

/// A copy of the shape with transformed geometry (not with a location on top of it).
TopoDS_Shape transformed(const TopoDS_Shape& shape, const Similarity& similarity);

}  // namespace umbilic::models
