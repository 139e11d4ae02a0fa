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
#include <umbilic/umbilics/rectangle_border.h>
#include <umbilic/umbilics/way_turning.h>

namespace umbilic {

/// Patches (i, j) with first <= i < last in both directions.
struct PatchRange {
    int u_first = 0, u_last = 0;
    int v_first = 0, v_last = 0;
};

/// Turning of (A, B) along paths of axis-parallel segments in the parameters of a surface. The range of patches must be
/// one on which the surface is twice continuously differentiable; beyond its border the outer patches are continued.
/// The equations of the patches met are formed once, and each way is evaluated once.
class PathTurning {
public:
    PathTurning(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                const PatchRange& range);

    /// The straight way, parallel to an axis; none if a common zero may lie on it: then `obstacle`, if given, is the
    /// first piece of the way, in the direction of growing parameter, that may hold one.
    std::optional<WayTurning> along(const Vector2& from, const Vector2& to, BorderSide* obstacle = nullptr);
    /// Winding number along closed paths of sides in any order. None if a common zero may lie on a side: then
    /// `obstacles`, if given, has a piece of each such side.
    std::optional<double> winding(std::span<const BorderSide> sides, std::vector<BorderSide>* obstacles = nullptr);

private:
    struct Formed {
        CoefficientShape shape;
        std::array<std::vector<double>, 2> coefficients;
        std::array<double, 2> error{};
        std::array<std::vector<double>, 2> errors;  ///< of each coefficient, once that was asked for
    };

    Formed& formed(std::size_t patch);
    void take_equations(Formed& result);
    std::optional<WayTurning> piece(bool along_u, double from, double to, double line, BorderSide* obstacle);

    const NurbsSurface& surface_;
    const BezierPatches& patches_;
    const InputRounding& input_;
    PatchRange range_;
    UmbilicEquations equations_;
    std::map<std::size_t, Formed> formed_;
    std::map<std::array<double, 4>, WayTurning> ways_;
};

}  // namespace umbilic
