// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/umbilics/equations.h>
#include <umbilic/umbilics/rectangle_border.h>

namespace umbilic {

/// Bernstein coefficients of a univariate polynomial with bounds on their errors: of each one, or the same for all.
struct BoundedCurve {
    std::vector<double> coefficients;
    double error = 0.0;
    std::vector<double> errors;

    int degree() const { return static_cast<int>(coefficients.size()) - 1; }
    double error_of(int k) const { return errors.empty() ? error : errors[k]; }
    /// Adds `arithmetic` to all errors, and `relative` times the largest of `errors` to each of these.
    void widen(double arithmetic, double relative);
};

/// How (A, B) turns along a straight way, A and B in the surface's parameters up to one common factor. The way falls
/// into pieces on each of which (A, B) stays within a right angle of one direction, whatever the rounding.
struct WayTurning {
    Vector2 start = Vector2::Zero(), end = Vector2::Zero();   ///< (A, B) at the ends, as computed
    Vector2 first = Vector2::Zero(), last = Vector2::Zero();  ///< directions of the pieces at the ends; zero: no piece
    double angle = 0.0;  ///< radians, from `first` to `last`, through the directions of the pieces between

    /// Angle from `start` to `end`, exact within their rounding.
    double between_ends() const;
    /// The same way from its end to its start.
    WayTurning reversed() const;
    /// Goes on along `next`. False, and nothing done, if the sense of turning between the two is lost in rounding.
    bool append(const WayTurning& next);
};

/// The turning along a straight way in a patch, whose sides in the surface's domain are `u_length` and `v_length`: A /
/// u_length and B / v_length are in the surface's parameters (docs/numerics.md). None if a common zero may lie on it:
/// then `obstacle` is the first part of the way's range [0, 1] that may hold one.
std::optional<WayTurning> turning(const BoundedCurve& a, const BoundedCurve& b, double u_length, double v_length,
                                  ParameterInterval& obstacle);
/// The same along an edge of a patch with increasing parameter.
std::optional<WayTurning> turning(const EdgeEquations& edge, double u_length, double v_length);

struct DirectedWay {
    BorderSide side;
    WayTurning turning;
};

/// Winding number of (A, B) along closed paths, twice the sum of the indices on their left; the ways may come in any
/// order. It rests on the pieces' directions alone, on no rounded value of (A, B), and so is whole. None if the sense
/// of turning at an end is lost in rounding or the paths do not close.
std::optional<double> winding(std::span<const DirectedWay> ways);

}  // namespace umbilic
