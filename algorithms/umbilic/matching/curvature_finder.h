// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include <umbilic/core/progress.h>
#include <umbilic/curvature_points/curvature_points.h>
#include <umbilic/curvature_points/curvature_surfaces.h>
#include <umbilic/matching/choices.h>
#include <umbilic/model/model.h>

namespace umbilic {

/// Places of a model with the curvatures of each query, outward sides applied: as the query is, and as it is seen from
/// behind (H opposite).
using CurvatureSolutions = std::vector<std::array<std::vector<Curvature>, 2>>;

/// Finds points of given curvatures on all faces of a model on which Gaussian and mean curvature together tell the
/// place, by one of the solvers (thesis 4.6.2 and 4.8). Refers to the model.
class CurvatureFinder {
public:
    /// With CurvatureSolver::approximated makes the curvature surfaces of all faces.
    CurvatureFinder(const Model& model, CurvatureSolver solver, const Progress& progress = {});

    std::size_t faces() const { return faces_.size(); }
    /// `both_signs`: H = -mean, too. Queries with tolerances have solutions with CurvatureSolver::direct alone. Throws
    /// Cancelled.
    CurvatureSolutions find(std::span<const CurvatureQuery> queries, bool both_signs, const Progress& progress) const;

private:
    CurvatureSolver solver_;
    std::vector<const Face*> faces_;
    std::vector<CurvatureSurfaces> surfaces_;  ///< of each face, where they are what is solved
};

}  // namespace umbilic
