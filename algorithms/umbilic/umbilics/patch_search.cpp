// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/patch_search.h>

#include <algorithm>
#include <map>

#include <umbilic/bernstein/box_clusters.h>
#include <umbilic/umbilics/winding.h>

namespace umbilic {

namespace {

/// Boxes left open by the first search are searched again this much finer, so that umbilics closer than the resolution
/// and nearly non-generic ones are told apart. Boxes that touch are searched as one heap, with a budget that shrinks
/// with its size: lines of umbilics show by exhausting it.
constexpr double refinement = 1e-4;
constexpr std::size_t most_refined = 256;
/// A box longer than this many smallest ones was not halved because nothing varies along it: part of a line.
constexpr double longest_refined = 8.0;
constexpr long heap_budget = 48000, least_heap_budget = 1500, most_heap_budget = 3000;
/// Boxes all refinements of one patch may use.
constexpr long refinement_budget = 30000;
/// A heap of more boxes is a line if some of them, searched this much finer, all leave boxes open. Around points most
/// are excluded.
constexpr std::size_t short_heap = 6;
constexpr double line_refinement = 1.0 / 8;
constexpr std::size_t line_samples = 6;
constexpr long line_budget = 400;
constexpr std::array<bool, 4> undivided{};
/// Next to a singular or umbilic edge, within this part of the patch, the equations divided by the edge's factors are
/// used: they have a looser bound, but do not vanish on the edge. What they leave out where the edge is singular or
/// umbilic only within the input's rounding grows with the inverse of the distance.
constexpr double edge_share = 1.0 / 64;
/// A zero of the divided equations is proved from those of the given surface on boxes down to this share of its
/// distance from the edge.
constexpr double least_edge_proof = 1.0 / 64;
/// A box on which the bound has this share in the polynomials' sizes is open because of the bound.
constexpr double doubtful = 1e-3;
/// It is searched again with bounds for single coefficients if those are smaller by this factor.
constexpr double worthwhile = 0.25;
/// What is still open then is proved, if it can be, on boxes around it that are that many times larger each time and
/// have sides of at most this share of the patch: the bound weighs less on them.
constexpr double proof_growth = 4.0;
constexpr double largest_proof = 1.0 / 8;
/// Heaps of open boxes this is tried for.
constexpr std::size_t most_proofs = 64;
constexpr ParameterBox whole_patch{{0.0, 1.0}, {0.0, 1.0}};

/// Open boxes that touch, joined.
std::vector<std::vector<OpenBox>> heaps_of(const std::vector<OpenBox>& boxes) {
    std::vector<Interval> sides;
    for (const OpenBox& open : boxes) {
        sides.emplace_back(open.box.u.low, open.box.u.high);
        sides.emplace_back(open.box.v.low, open.box.v.high);
    }
    const BoxClusters heaps = cluster_boxes(sides, 2, 0.0);
    std::vector<std::vector<OpenBox>> result(heaps.count);
    for (std::size_t k = 0; k < boxes.size(); ++k) result[heaps.cluster[k]].push_back(boxes[k]);
    return result;
}

ParameterInterval grown(const ParameterInterval& part, double factor, const ParameterInterval& whole) {
    const double more = 0.5 * (factor - 1.0) * part.length();
    return {whole.clamp(part.low - more), whole.clamp(part.high + more)};
}

}  // namespace

void PatchSearch::take_equations(const NurbsSurface& surface, const BezierPatch& patch,
                                 const std::array<bool, 4>& divided) {
    equations_.form_umbilic();
    if (divided != undivided) {
        equations_.divide_by_edges(divided);
        zeros_.set_polynomials(equations_.a(), equations_.b());
        return;
    }
    zeros_.set_polynomials(
        equations_.a(), equations_.b(), [this](const Vector2& at) { return equations_.enclose(at); },
        [&surface, &patch](const Vector2& at) { return enclose_precisely(surface, patch, at); });
}

PatchUmbilics PatchSearch::search(const NurbsSurface& surface, const BezierPatch& patch, const InputRounding& input,
                                  const PatchTask& task, const Progress& progress) {
    PatchUmbilics result;
    equations_.form_fundamental(patch, input);
    for (const PatchEdge edge : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high}) {
        const int k = static_cast<int>(edge);
        result.singular[k] = equations_.singular(edge);
        if (task.edges[k])
            result.turning[k] = {
                true, turning(equations_.edge_equations(edge), patch.domain.u.length(), patch.domain.v.length())};
    }
    if (equations_.excluded_by_hulls()) return result;
    result.formed = true;
    take_equations(surface, patch, undivided);

    // Edges next to which the equations are divided by the factors that vanish there.
    std::array<bool, 4> divided{};
    ParameterBox regular{{0.0, 1.0}, {0.0, 1.0}};
    std::vector<ParameterBox> strips, umbilic_edges;
    std::array<bool, 4> umbilic_edge{};
    const auto cut = [&](PatchEdge edge, ParameterInterval ParameterBox::*side, bool low_end) {
        const bool umbilic = equations_.umbilic(edge);
        if (!umbilic && !equations_.singular(edge)) return;
        divided[static_cast<int>(edge)] = true;
        ParameterBox strip = regular;
        if (low_end)
            (strip.*side).high = (regular.*side).low = (regular.*side).low + edge_share;
        else
            (strip.*side).low = (regular.*side).high = (regular.*side).high - edge_share;
        strips.push_back(strip);
        umbilic_edge[static_cast<int>(edge)] = umbilic;
        if (!umbilic) return;
        // The edge itself: one open box of the smallest width.
        ParameterBox line{{0.0, 1.0}, {0.0, 1.0}};
        const double width = side == &ParameterBox::u ? task.limits.u_size : task.limits.v_size;
        (line.*side) = low_end ? ParameterInterval{0.0, width} : ParameterInterval{1.0 - width, 1.0};
        umbilic_edges.push_back(line);
    };
    cut(PatchEdge::u_low, &ParameterBox::u, true);
    cut(PatchEdge::u_high, &ParameterBox::u, false);
    cut(PatchEdge::v_low, &ParameterBox::v, true);
    cut(PatchEdge::v_high, &ParameterBox::v, false);

    // Zeros of the divided equations there are points of the edge's line.
    const auto on_umbilic_edge = [&](const IsolatedZero& zero) {
        const Vector2 low = zero.at - zero.input_radius, high = zero.at + zero.input_radius;
        const bool reaches[4] = {low.x() <= 0.0, high.x() >= 1.0, low.y() <= 0.0, high.y() >= 1.0};
        for (int k = 0; k < 4; ++k)
            if (umbilic_edge[k] && reaches[k]) return true;
        return false;
    };
    zeros_.search(regular, task.limits, progress, result.zeros);
    refine(task, progress, result.zeros);
    redo_doubtful(surface, patch, input, task, undivided, progress, result.zeros);
    if (!strips.empty()) {
        take_equations(surface, patch, divided);
        CommonZeros near_edges;
        for (const ParameterBox& strip : strips) zeros_.search(strip, task.limits, progress, near_edges);
        refine(task, progress, near_edges);
        redo_doubtful(surface, patch, input, task, divided, progress, near_edges);
        std::erase_if(near_edges.isolated, on_umbilic_edge);
        if (!near_edges.isolated.empty())
            prove_near_edges(surface, patch, input, divided, near_edges.isolated, result.zeros);
        std::vector<OpenBox>& open = result.zeros.open;
        open.insert(open.end(), near_edges.open.begin(), near_edges.open.end());
        for (const ParameterBox& line : umbilic_edges) open.push_back({line, false, 0.0, line});
        result.zeros.boxes += near_edges.boxes;
        result.zeros.exhausted = result.zeros.exhausted || near_edges.exhausted;
    }
    return result;
}

void PatchSearch::refine(const PatchTask& task, const Progress& progress, CommonZeros& zeros) {
    if (zeros.open.empty() || zeros.exhausted) return;
    const std::vector<std::vector<OpenBox>> heaps = heaps_of(zeros.open);
    zeros.open.clear();
    long left = refinement_budget;
    for (const std::vector<OpenBox>& heap : heaps) {
        const bool refinable = std::all_of(heap.begin(), heap.end(), [&](const OpenBox& open) {
            return !open.zero && open.box.u.length() <= longest_refined * task.limits.u_size &&
                   open.box.v.length() <= longest_refined * task.limits.v_size;
        });
        CommonZeros refined;
        refined.isolated = zeros.isolated;
        refined.exhausted = !refinable || heap.size() > most_refined || is_line(heap, task, progress, zeros);
        SearchLimits finer = task.limits;
        finer.u_size *= refinement;
        finer.v_size *= refinement;
        const long budget =
            std::clamp(heap_budget / static_cast<long>(heap.size()), least_heap_budget, most_heap_budget);
        std::size_t searched = 0;
        for (std::size_t k = 0; k < heap.size() && !refined.exhausted; ++k) {
            finer.boxes = std::min(budget, left) - refined.boxes;
            if (finer.boxes <= 0)
                refined.exhausted = true;
            else
                zeros_.search(heap[k].box, finer, progress, refined);
            for (; searched < refined.open.size(); ++searched) refined.open[searched].origin = heap[k].origin;
        }
        zeros.boxes += refined.boxes;
        left -= refined.boxes;
        if (refined.exhausted) {
            // Too much for isolated points: what the first search left stands.
            zeros.open.insert(zeros.open.end(), heap.begin(), heap.end());
            continue;
        }
        // On a scale this fine everything is within the input's rounding at degenerate points: undecided, no region.
        for (OpenBox& open : refined.open) open.zero = false;
        zeros.open.insert(zeros.open.end(), refined.open.begin(), refined.open.end());
        zeros.isolated = std::move(refined.isolated);
    }
}

bool PatchSearch::is_line(const std::vector<OpenBox>& heap, const PatchTask& task, const Progress& progress,
                          CommonZeros& zeros) {
    if (heap.size() <= short_heap) return false;
    SearchLimits finer = task.limits;
    finer.u_size *= line_refinement;
    finer.v_size *= line_refinement;
    finer.boxes = line_budget;
    for (std::size_t k = 0; k < line_samples; ++k) {
        CommonZeros sample;
        zeros_.search(heap[k * (heap.size() - 1) / (line_samples - 1)].box, finer, progress, sample);
        zeros.boxes += sample.boxes;
        if (sample.open.empty()) return false;
    }
    return true;
}

void PatchSearch::redo_doubtful(const NurbsSurface& surface, const BezierPatch& patch, const InputRounding& input,
                                const PatchTask& task, const std::array<bool, 4>& divided, const Progress& progress,
                                CommonZeros& zeros) {
    const auto in_doubt = [](const OpenBox& open) {
        const bool whole = open.box.u.length() == 1.0 && open.box.v.length() == 1.0;
        return open.doubt > doubtful && !(open.zero && whole);
    };
    if (zeros.exhausted || std::none_of(zeros.open.begin(), zeros.open.end(), in_doubt)) return;
    // The bound weighs least on large boxes: those of the first search are searched again, as a whole.
    const auto key = [](const ParameterBox& box) {
        return std::array<double, 4>{box.u.low, box.v.low, box.u.high, box.v.high};
    };
    struct Doubtful {
        ParameterBox box;
        double error = 0.0;
        bool searched = false;
    };
    std::map<std::array<double, 4>, Doubtful> doubts;
    for (const OpenBox& open : zeros.open)
        if (in_doubt(open) && !doubts.contains(key(open.origin)))
            doubts[key(open.origin)] = {open.origin, zeros_.largest_error(open.origin)};
    equations_.form_fundamental_with_errors(surface, patch, input);
    take_equations(surface, patch, divided);
    CommonZeros again;
    for (auto& [place, doubt] : doubts) {
        if (again.exhausted || !(zeros_.largest_error(doubt.box) < worthwhile * doubt.error)) continue;
        zeros_.search(doubt.box, task.limits, progress, again);
        doubt.searched = true;
    }
    std::erase_if(zeros.open, [&](const OpenBox& open) {
        const auto doubt = doubts.find(key(open.origin));
        return doubt != doubts.end() && doubt->second.searched;
    });
    refine(task, progress, again);
    if (divided == undivided && !again.exhausted) prove_around(again);
    for (const IsolatedZero& zero : again.isolated) CommonZeroSearch::add_zero(zero, zeros);
    zeros.open.insert(zeros.open.end(), again.open.begin(), again.open.end());
    zeros.boxes += again.boxes;
    zeros.exhausted = zeros.exhausted || again.exhausted;
}

void PatchSearch::prove_near_edges(const NurbsSurface& surface, const BezierPatch& patch, const InputRounding& input,
                                   const std::array<bool, 4>& divided, const std::vector<IsolatedZero>& found,
                                   CommonZeros& zeros) {
    std::array<bool, 4> poles{};
    for (int k = 0; k < 4; ++k) poles[k] = divided[k] && collapsed(surface, patch, static_cast<PatchEdge>(k));
    // Values of A and B at a point, divided as the polynomials are.
    const auto quotient = [poles](std::array<Interval, 2> value, const Vector2& at) {
        const Interval u(at.x()), v(at.y());
        const Interval distance[4] = {u, Interval(1.0) - u, v, Interval(1.0) - v};
        for (int k = 0; k < 4; ++k) {
            if (!poles[k]) continue;
            const PolePowers powers = pole_powers(static_cast<PatchEdge>(k));
            for (int i = 0; i < powers.a; ++i) value[0] = value[0] / distance[k];
            for (int i = 0; i < powers.b; ++i) value[1] = value[1] / distance[k];
        }
        return value;
    };
    equations_.form_fundamental_with_errors(surface, patch, input);
    equations_.form_umbilic();
    equations_.divide_by_poles(poles);
    zeros_.set_polynomials(
        equations_.a(), equations_.b(),
        [this, quotient](const Vector2& at) { return quotient(equations_.enclose(at), at); },
        [&surface, &patch, quotient](const Vector2& at) {
            return quotient(enclose_precisely(surface, patch, at), at);
        });
    for (const IsolatedZero& zero : found) {
        // (A, B) still changes by powers of the distance from the edges: across them the boxes are small beside it.
        const double gaps[4] = {zero.at.x(), 1.0 - zero.at.x(), zero.at.y(), 1.0 - zero.at.y()};
        const bool across[2] = {divided[0] || divided[1], divided[2] || divided[3]};
        double gap = 1.0;
        for (int k = 0; k < 4; ++k)
            if (divided[k]) gap = std::min(gap, gaps[k]);
        std::optional<int> count;
        for (double share = 0.5; gap > 0.0 && !count && share >= least_edge_proof; share /= 2)
            for (double length = across[0] && across[1] ? share * gap : 0.25; !count && length >= share * gap;
                 length /= 4) {
                const auto around = [&](int k) {
                    const double size = across[k] ? share * gap : length;
                    return ParameterInterval{whole_patch.u.clamp(zero.at[k] - size),
                                             whole_patch.u.clamp(zero.at[k] + size)};
                };
                count = zeros_.count({around(0), around(1)}, zeros);
            }
        if (count != 1) zeros.open.push_back({zero.box, false, 0.0, zero.box});
    }
}

void PatchSearch::prove_around(CommonZeros& zeros) {
    const std::vector<std::vector<OpenBox>> heaps = heaps_of(zeros.open);
    if (heaps.size() > most_proofs) return;
    zeros.open.clear();
    for (const std::vector<OpenBox>& heap : heaps) {
        ParameterBox hull = heap.front().box;
        for (const OpenBox& open : heap) {
            hull.u = {std::min(hull.u.low, open.box.u.low), std::max(hull.u.high, open.box.u.high)};
            hull.v = {std::min(hull.v.low, open.box.v.low), std::max(hull.v.high, open.box.v.high)};
        }
        bool decided = false;
        for (double factor = proof_growth; !decided; factor *= proof_growth) {
            const ParameterBox around{grown(hull.u, factor, whole_patch.u), grown(hull.v, factor, whole_patch.v)};
            if (std::max(around.u.length(), around.v.length()) > largest_proof) break;
            decided = zeros_.count(around, zeros).has_value();
        }
        if (!decided) zeros.open.insert(zeros.open.end(), heap.begin(), heap.end());
    }
}

}  // namespace umbilic
