// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <umbilic/umbilics/common_zeros.h>
#include <umbilic/umbilics/equations.h>
#include <umbilic/umbilics/way_turning.h>

namespace umbilic {

/// How (A, B) turns along one edge, parameters increasing.
struct EdgeTurning {
    bool wanted = false;
    std::optional<WayTurning> way;  ///< none if the edge may hold an umbilic
};

/// What the search found on one Bezier patch, in the patch's own parameters.
struct PatchUmbilics {
    CommonZeros zeros;
    bool formed = false;
    std::array<bool, 4> singular{};      ///< UmbilicEquations::singular, indexed by PatchEdge
    std::array<EdgeTurning, 4> turning;  ///< indexed by PatchEdge
};

/// What is asked of one patch.
struct PatchTask {
    SearchLimits limits;          ///< sizes in the patch's own parameters
    std::array<bool, 4> edges{};  ///< edges along which the turning of (A, B) is wanted
};

/// Forms the equations of patches and finds their umbilics; memory is kept from patch to patch.
class PatchSearch {
public:
    /// `patch` is one of `surface`.
    PatchUmbilics search(const NurbsSurface& surface, const BezierPatch& patch, const InputRounding& input,
                         const PatchTask& task, const Progress& progress);

private:
    void take_equations(const NurbsSurface& surface, const BezierPatch& patch, const std::array<bool, 4>& divided);
    void refine(const PatchTask& task, const Progress& progress, CommonZeros& zeros);
    bool is_line(const std::vector<OpenBox>& heap, const PatchTask& task, const Progress& progress, CommonZeros& zeros);
    void redo_doubtful(const NurbsSurface& surface, const BezierPatch& patch, const InputRounding& input,
                       const PatchTask& task, const std::array<bool, 4>& divided, const Progress& progress,
                       CommonZeros& zeros);
    /// Zeros of equations divided by edges, proved from equations of the given surface: what that division leaves out
    /// vanishes within rounding only, and moves a zero by that over its distance from the edge. Boxes of those that
    /// cannot be proved are left open.
    void prove_near_edges(const NurbsSurface& surface, const BezierPatch& patch, const InputRounding& input,
                          const std::array<bool, 4>& divided, const std::vector<IsolatedZero>& found,
                          CommonZeros& zeros);
    void prove_around(CommonZeros& zeros);

    UmbilicEquations equations_;
    CommonZeroSearch zeros_;
};

}  // namespace umbilic
