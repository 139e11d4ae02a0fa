// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <umbilic/bernstein/degree_reduction.h>
#include <umbilic/bernstein/subdivision.h>
#include <umbilic/core/progress.h>
#include <umbilic/core/types.h>
#include <umbilic/curvature_points/curvature_box.h>
#include <umbilic/umbilics/equations.h>

namespace umbilic {

/// A point at which K and H have the values of a level, proved to be the only one in its box.
struct LevelPoint {
    int level = 0;
    Vector2 at = Vector2::Zero();
    Vector2 radius = Vector2::Zero();  ///< bound on the distance of `at` from the point, the input taken as rounded
    ParameterBox box;                  ///< may reach out of [0, 1]^2, to which the surface continues
};

/// A box that was neither excluded nor proved (tolerances 0), or the part of a box that holds a part of the region
/// within the tolerances: all of that region lies in such parts.
struct LevelBox {
    int level = 0;
    BoxPart part;
    /// Greater distance of K or H from the level at the middle of their ranges, in units of the tolerance; infinity
    /// where the ranges could not be told.
    double misfit = 0.0;
};

struct LevelSets {
    std::vector<LevelPoint> points;
    std::vector<LevelBox> boxes;
    long visited = 0;
    bool exhausted = false;
};

struct LevelLimits {
    /// Boxes not longer than this count as fine: each level may use `fine_boxes` of them before those that are left
    /// stay as they are. So a point of tangency is told apart, and a curve of solutions costs little.
    double u_size = 1e-3, v_size = 1e-3;
    long fine_boxes = 2000;
    /// No box is split beyond this share of those sizes.
    double finest = 1e-4;
    long boxes = 200000;  ///< visited before the rest is left
};

/// All points of a patch at which K and H have given values, for many pairs of values in one tree (thesis 4.6.2,
/// without its auxiliary variable; docs/algorithms/curvature_points.md). On a box T = |N|^2 varies little, so that K
/// T^2 and H T^(3/2) are linear up to a remainder of second order: every pair of equations becomes two linear
/// combinations of the coefficient arrays of the box, to which exclusion, preconditioning and the proof by contraction
/// apply. Memory is kept from call to call.
class CurvatureLevelSearch {
public:
    void set_equations(const CurvatureEquations& equations);

    /// Appends what is found on [0, 1]^2. Levels are in the unit of the equations. Throws Cancelled.
    void search(std::span<const CurvatureLevel> levels, const LevelLimits& limits, const Progress& progress,
                LevelSets& result);

private:
    struct Node {
        int depth = 0;
        ParameterBox box;
        std::array<double, CurvatureBox::most_arrays> errors{};
        std::size_t first_live = 0;
        std::size_t live = 0;
    };
    enum class Outcome { empty, point, member, split };

    /// Searches from the nodes there are, with at most `budget` boxes; returns how many were visited.
    long run(std::span<const CurvatureLevel> levels, const LevelLimits& limits, long budget, const Progress& progress,
             LevelSets& result);
    /// Hands the arrays of a box, of lower degree, to lower_; false if that is not worth while.
    bool reduce(const Node& node, const double* coefficients);
    Outcome examine(const Node& node, const CurvatureLevel& level, int number, LevelSets& result);
    Outcome examine_region(const Node& node, const CurvatureLevel& level, int number, LevelSets& result);
    Outcome isolate(const Node& node, const CurvatureLevel& level, int number, const Matrix2& preconditioner,
                    double contraction, LevelSets& result);
    /// Takes the part [low, high] of the box of the last node, which may reach out of it, as other_box_.
    void take_other(const Node& node, const Vector2& low, const Vector2& high);
    /// Whether K and H are within the tolerances on a part of the box, or vary little; none if the part holds nothing.
    std::optional<bool> restricted_within(const CurvatureLevel& level, const Node& node, const Vector2& low,
                                          const Vector2& high);
    void leave(const Node& node, int number, LevelSets& result) const;

    CoefficientShape shape_;
    CoefficientShape error_shape_;  ///< degrees of the equations, of which those searched may be reductions
    int arrays_ = 0;
    bool rational_ = false;
    std::vector<double> root_, slots_, other_;
    std::array<double, CurvatureBox::most_arrays> root_errors_{};
    /// Searches small boxes, for levels with tolerances, with polynomials of lower degree.
    std::unique_ptr<CurvatureLevelSearch> lower_;
    std::optional<DegreeReduction> reduction_;
    std::array<double, CurvatureBox::most_arrays> reduction_errors_{};
    std::vector<Node> nodes_;
    std::vector<int> live_;
    std::vector<long> fine_;
    CurvatureBox box_, other_box_;
};

}  // namespace umbilic
