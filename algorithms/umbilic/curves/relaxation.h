// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include <umbilic/core/progress.h>

namespace umbilic {

/// Boundary value problem y' = g(y) on [0, 1] (thesis 3.4): as many components are given at the ends as there are.
struct BoundaryValueProblem {
    /// False where g is not defined.
    std::function<bool(const Eigen::VectorXd& y, Eigen::VectorXd& g)> rate;
    /// Components given at the start and at the end, with their values.
    std::vector<std::pair<int, double>> at_start, at_end;
    /// Scale factors M of the components in the norm of a correction (thesis (3.19)).
    Eigen::VectorXd scale;
    /// Distance of two states, in the unit of RelaxationOptions::tolerance.
    std::function<double(const Eigen::VectorXd& a, const Eigen::VectorXd& b)> distance;
};

struct RelaxationOptions {
    /// Newton's method ends when the norm (3.19) of the correction, summed over the mesh, is below this.
    double epsilon = 1e-5;
    int most_iterations = 60;
    /// The mesh is halved until the solution moves by less than this; 0 keeps the first mesh.
    double tolerance = 0.0;
    int most_points = 8193;
};

struct Relaxation {
    bool converged = false;
    /// States at equal distances of the parameter, one a column.
    Eigen::MatrixXd states;
    int iterations = 0;  ///< on the first mesh
    /// Largest distance between this solution and that of the mesh twice as coarse; infinite if there was none.
    double error = 0.0;
};

/// Solves a boundary value problem by relaxation: trapezoidal differences on a mesh, Newton's method with step control
/// (thesis (3.9)-(3.19)) and a sparse factorisation of the block-banded Jacobian; the mesh is halved as long as the
/// tolerance asks for it. `guess` holds the states of the first mesh, one a column, at least two. `converged` is false
/// if a mesh could not be relaxed or the tolerance was not reached. Throws InvalidInput if sizes do not fit.
Relaxation relax(const BoundaryValueProblem& problem, const Eigen::MatrixXd& guess,
                 const RelaxationOptions& options = {}, const Progress& progress = {});

}  // namespace umbilic
