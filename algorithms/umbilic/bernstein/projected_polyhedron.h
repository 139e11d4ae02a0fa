// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include <umbilic/bernstein/multivariate_polynomial.h>
#include <umbilic/core/progress.h>
#include <umbilic/core/types.h>

namespace umbilic {

struct ProjectedPolyhedronOptions {
    /// Side below which a box is not split; the domain is [0, 1]^l. Between 1e-14 and 1.
    double tolerance = 1e-8;
    /// Boxes examined before what is left is returned as undecided.
    long boxes = 100000;
    /// Also projects the combinations of the polynomials whose mean derivative is the identity. Needs as many
    /// polynomials as unknowns, or more; otherwise it changes nothing.
    bool precondition = true;
};

/// A solution that was singled out.
struct SystemRoot {
    std::vector<double> at;
    /// Bound on the distance of `at` from the solution, per unknown. A solution on the border of the domain may be
    /// reported although it lies outside by less than this.
    std::vector<double> radius;
    /// The system has at most one solution in this box; it may reach out of [0, 1]^l, where the polynomials continue.
    std::vector<Interval> box;
    /// Existence was proved too. It never is for more polynomials than unknowns: then a solution, if there is one in
    /// `box`, is within `radius`, and all residuals enclose 0.
    bool exists = false;
    /// Sign of the Jacobian determinant at the solution, proved; 0 unless there are as many polynomials as unknowns and
    /// the sign could be told.
    int jacobian_sign = 0;
};

/// A side of a box with [0, 1] mapped onto a parameter interval; both ends of it exactly.
ParameterInterval placed(const Interval& side, const ParameterInterval& range);

/// One coordinate of a root with [0, 1] mapped onto a parameter interval, clamped to it, and its radius there.
struct PlacedCoordinate {
    double at = 0.0;
    double radius = 0.0;
};
PlacedCoordinate placed(const SystemRoot& root, int unknown, const ParameterInterval& range);

/// A box that may hold solutions and is not larger than the tolerance in any direction in which the polynomials vary
/// notably, or was left over when the budget was spent.
struct UndecidedBox {
    std::vector<Interval> box;
    int cluster = 0;    ///< boxes that touch within the tolerance bear the same number, from 0
    bool zero = false;  ///< every polynomial vanishes on the whole box within its error: not examined further
};

struct ProjectedPolyhedronStatistics {
    long boxes = 0;    ///< examined, each shrunk version counted
    long shrinks = 0;  ///< boxes cut down by projection to at most 0.8 of a side
    long splits = 0;
    long proofs = 0;         ///< attempts to prove a root
    bool exhausted = false;  ///< the budget was spent; the boxes left over are among the undecided ones
};

/// Solutions of a system in [0, 1]^l: every one lies in the `box` of a root or in an undecided box.
struct SystemRoots {
    std::vector<SystemRoot> roots;  ///< ordered by coordinates, the first one first
    std::vector<UndecidedBox> undecided;
    int clusters = 0;  ///< of undecided boxes
    ProjectedPolyhedronStatistics statistics;
};

/// All solutions in [0, 1]^l of n polynomial equations in l unknowns by the Interval Projected Polyhedron method
/// (thesis 3.8.2, (3.49); Sherbrooke and Patrikalakis, Computation of the solutions of nonlinear polynomial systems,
/// CAGD 10, 1993), with existence and uniqueness proved by a contraction. Multiple solutions and curves of solutions
/// end as undecided boxes; with n < l everything does. Proof and bounds: docs/numerics.md, "Systems of polynomials".
/// The same input gives the same result. Throws InvalidInput if there are no polynomials, one of them is not valid (see
/// check), their numbers of unknowns differ, or an option is out of range; Cancelled.
SystemRoots solve_projected_polyhedron(std::span<const MultivariatePolynomial> system,
                                       const ProjectedPolyhedronOptions& options = {}, const Progress& progress = {});

}  // namespace umbilic
