// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/patch_search.h>

#include <algorithm>

#include <umbilic/umbilics/winding.h>

namespace umbilic {

namespace {

/// Boxes left open by the first search are searched again this much finer, so that umbilics closer than the resolution
/// and nearly non-generic ones are told apart; lines of umbilics show by exhausting `refinement_boxes`.
constexpr double refinement = 1e-4;
constexpr long refinement_boxes = 1500;
constexpr std::size_t most_refined = 64;
/// Next to a collapsed edge, within this part of the patch, the equations divided by the edge's factors are used: they
/// have a looser bound, but do not vanish on the edge.
constexpr double pole_share = 0.125;

bool smaller_than_limits(const ParameterBox& box, const SearchLimits& limits) {
    return box.u.length() <= limits.u_size && box.v.length() <= limits.v_size;
}

}  // namespace

PatchUmbilics PatchSearch::search(const BezierPatch& patch, const InputRounding& input, const PatchTask& task,
                                  const Progress& progress) {
    PatchUmbilics result;
    equations_.form_fundamental(patch, input);
    for (const PatchEdge edge : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high}) {
        const int k = static_cast<int>(edge);
        result.collapsed[k] = equations_.collapsed(edge);
        if (task.edges[k])
            result.turning[k] = {
                true, turning(equations_.edge_equations(edge), patch.domain.u.length(), patch.domain.v.length())};
    }
    if (equations_.excluded_by_hulls()) return result;
    result.formed = true;
    equations_.form_umbilic();
    zeros_.set_polynomials(equations_.a(), equations_.b(),
                           [this](const Vector2& at) { return equations_.enclose(at); });

    ParameterBox regular{{0.0, 1.0}, {0.0, 1.0}};
    std::vector<ParameterBox> strips;
    const auto cut = [&](PatchEdge edge, ParameterInterval ParameterBox::*side, bool low_end) {
        if (!equations_.collapsed(edge)) return;
        ParameterBox strip = regular;
        if (low_end)
            (strip.*side).high = (regular.*side).low = (regular.*side).low + pole_share;
        else
            (strip.*side).low = (regular.*side).high = (regular.*side).high - pole_share;
        strips.push_back(strip);
    };
    cut(PatchEdge::u_low, &ParameterBox::u, true);
    cut(PatchEdge::u_high, &ParameterBox::u, false);
    cut(PatchEdge::v_low, &ParameterBox::v, true);
    cut(PatchEdge::v_high, &ParameterBox::v, false);

    zeros_.search(regular, task.limits, progress, result.zeros);
    refine(task, progress, result.zeros);
    if (!strips.empty()) {
        equations_.divide_by_collapsed_edges();
        zeros_.set_polynomials(equations_.a(), equations_.b());
        CommonZeros near_poles;
        for (const ParameterBox& strip : strips) zeros_.search(strip, task.limits, progress, near_poles);
        refine(task, progress, near_poles);
        for (const IsolatedZero& zero : near_poles.isolated) CommonZeroSearch::add_zero(zero, result.zeros);
        result.zeros.open.insert(result.zeros.open.end(), near_poles.open.begin(), near_poles.open.end());
        result.zeros.boxes += near_poles.boxes;
        result.zeros.exhausted = result.zeros.exhausted || near_poles.exhausted;
    }
    return result;
}

void PatchSearch::refine(const PatchTask& task, const Progress& progress, CommonZeros& zeros) {
    const auto refinable = [&](const OpenBox& open) {
        return !open.zero && smaller_than_limits(open.box, task.limits);
    };
    const auto count = static_cast<std::size_t>(std::count_if(zeros.open.begin(), zeros.open.end(), refinable));
    if (count == 0 || count > most_refined || zeros.exhausted) return;
    SearchLimits finer;
    finer.u_size = task.limits.u_size * refinement;
    finer.v_size = task.limits.v_size * refinement;
    finer.boxes = refinement_boxes;

    CommonZeros refined;
    refined.isolated = zeros.isolated;
    for (const OpenBox& open : zeros.open) {
        if (!refinable(open)) {
            refined.open.push_back(open);
            continue;
        }
        zeros_.search(open.box, finer, progress, refined);
        if (refined.exhausted) {
            // Too much for isolated points: what the first search left stands.
            zeros.boxes += refined.boxes;
            return;
        }
    }
    // On a scale this fine everything is within the input's rounding at degenerate points: undecided, not a region.
    for (OpenBox& open : refined.open)
        if (open.box.u.length() < task.limits.u_size / 2 && open.box.v.length() < task.limits.v_size / 2)
            open.zero = false;
    refined.boxes += zeros.boxes;
    zeros = std::move(refined);
}

}  // namespace umbilic
