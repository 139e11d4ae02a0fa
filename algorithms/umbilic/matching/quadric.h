// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include <umbilic/core/types.h>

namespace umbilic {

/// Root mean square distance (mm, to first order) of points from the quadric that fits them best (Taubin, Estimation of
/// planar curves, surfaces, and nonplanar space curves defined by implicit equations, 1991). Pieces of smooth surfaces
/// that are no more than this from a quadric look alike; 0 for fewer than ten points.
double departure_from_quadric(std::span<const Vector3> points);

}  // namespace umbilic
