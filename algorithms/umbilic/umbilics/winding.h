// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <umbilic/bernstein/subdivision.h>
#include <umbilic/nurbs/bezier_patch.h>
#include <umbilic/umbilics/equations.h>

namespace umbilic {

/// Angle in radians through which the vector (A, B) turns along an edge with increasing parameter, within rounding of
/// its exact value; none if the edge may hold a common zero. `u_length` and `v_length` are the sides of the patch's
/// part of the surface's domain: A / u_length and B / v_length are in the surface's parameters up to one common factor,
/// so that angles of neighbouring patches add up (docs/numerics.md).
std::optional<double> turning(const EdgeEquations& edge, double u_length, double v_length);

/// Patches (i, j) with first <= i < last in both directions.
struct PatchRange {
    int u_first = 0, u_last = 0;
    int v_first = 0, v_last = 0;
};

/// Turning of (A, B) along paths of axis-parallel segments in the parameters of a surface. The range of patches must be
/// one on which the surface is twice continuously differentiable; beyond its border the outer patches are continued.
/// The equations of the patches met are formed once.
class PathTurning {
public:
    PathTurning(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                const PatchRange& range);

    /// Angle (radians) along the straight way, parallel to an axis; none if a common zero may lie on it.
    std::optional<double> along(const Vector2& from, const Vector2& to);
    /// Winding number along the closed path through `corners`, twice the sum of the indices inside if it runs
    /// counter-clockwise. None if a common zero may lie on it.
    std::optional<double> winding(std::span<const Vector2> corners);

private:
    struct Formed {
        CoefficientShape shape;
        std::array<std::vector<double>, 2> coefficients;
        std::array<double, 2> error{};
    };

    const Formed& formed(int i, int j);
    std::optional<double> piece(bool along_u, double from, double to, double across);

    const NurbsSurface& surface_;
    const BezierPatches& patches_;
    const InputRounding& input_;
    PatchRange range_;
    UmbilicEquations equations_;
    std::map<std::size_t, Formed> formed_;
};

/// Winding number of (A, B), twice the sum of the indices inside, along the border of a rectangle; where it reaches out
/// of the surface's domain the outer patches are continued. None if a common zero may lie on the border or the surface
/// is not twice continuously differentiable across a knot inside.
std::optional<double> rectangle_winding(const NurbsSurface& surface, const BezierPatches& patches,
                                        const InputRounding& input, const ParameterBox& rectangle);

/// Winding number from an angle that adds up to whole turns; none if it does not.
std::optional<double> whole_turns(double angle);

}  // namespace umbilic
