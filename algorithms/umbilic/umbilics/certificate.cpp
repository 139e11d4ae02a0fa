// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/certificate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>

#include <umbilic/umbilics/block_border.h>

namespace umbilic {

namespace {

/// Sightings nearer than this share of a patch are one place.
constexpr double same_place = 1e-8;

bool across_u(PatchEdge edge) {
    return edge == PatchEdge::u_low || edge == PatchEdge::u_high;
}

std::vector<int> block_ends(const KnotVector& knots, int first, int last) {
    std::vector<int> result{first};
    for (int k = first + 1; k < last; ++k)
        if (knots.continuity(k) < 2) result.push_back(k);
    result.push_back(last);
    return result;
}

ParameterBox domain_of(const NurbsSurface& surface, const PatchRange& range) {
    const std::vector<double>&u = surface.u_knots().breaks(), &v = surface.v_knots().breaks();
    return {{u[range.u_first], u[range.u_last]}, {v[range.v_first], v[range.v_last]}};
}

std::vector<Place> places_in(const PatchRange& block, const BezierPatches& patches,
                             const std::vector<SightedUmbilic>& umbilics) {
    std::vector<Place> result;
    for (const SightedUmbilic& umbilic : umbilics) {
        const std::size_t before = result.size();
        for (const Sighting& sighting : umbilic.sightings) {
            const int i = static_cast<int>(sighting.patch) / patches.v_count;
            const int j = static_cast<int>(sighting.patch) % patches.v_count;
            if (i < block.u_first || i >= block.u_last || j < block.v_first || j >= block.v_last) continue;
            const ParameterBox& domain = patches.patches[sighting.patch].domain;
            const Vector2 size(domain.u.length(), domain.v.length());
            const auto known = [&](const Place& place) {
                return ((place.at - sighting.at).cwiseAbs().array() <= same_place * size.array()).all();
            };
            if (std::none_of(result.begin() + before, result.end(), known))
                result.push_back({sighting.at, size, umbilic.umbilic.index});
        }
    }
    return result;
}

std::array<Vector2, 4> corners(const ParameterBox& box) {
    return {Vector2(box.u.low, box.v.low), Vector2(box.u.high, box.v.low), Vector2(box.u.high, box.v.high),
            Vector2(box.u.low, box.v.high)};
}

}  // namespace

std::vector<PatchRange> smooth_blocks(const NurbsSurface& surface, const PatchRange& range) {
    const std::vector<int> u = block_ends(surface.u_knots(), range.u_first, range.u_last);
    const std::vector<int> v = block_ends(surface.v_knots(), range.v_first, range.v_last);
    std::vector<PatchRange> result;
    for (std::size_t i = 0; i + 1 < u.size(); ++i)
        for (std::size_t j = 0; j + 1 < v.size(); ++j) result.push_back({u[i], u[i + 1], v[j], v[j + 1]});
    return result;
}

namespace {

/// Winding along the edges of a block's outer patches, as followed by the search; none if one could not be followed.
std::optional<double> winding_along_edges(const BezierPatches& patches, const PatchRange& block,
                                          const std::vector<PatchUmbilics>& found) {
    std::vector<DirectedWay> ways;
    for (int i = block.u_first; i < block.u_last; ++i)
        for (int j = block.v_first; j < block.v_last; ++j) {
            if (i > block.u_first && i + 1 < block.u_last && j > block.v_first && j + 1 < block.v_last) {
                j = block.v_last - 2;  // inner patches have no border
                continue;
            }
            const std::size_t k = static_cast<std::size_t>(i) * patches.v_count + j;
            const std::array<Vector2, 4> corner = corners(patches.patches[k].domain);
            for (int side = 0; side < 4; ++side) {
                constexpr std::array<PatchEdge, 4> edge_of = {PatchEdge::v_low, PatchEdge::u_high, PatchEdge::v_high,
                                                              PatchEdge::u_low};
                const EdgeTurning& edge = found[k].turning[static_cast<int>(edge_of[side])];
                if (!edge.wanted) continue;
                if (!edge.way) return std::nullopt;
                ways.push_back({{corner[side], corner[(side + 1) % 4]}, side < 2 ? *edge.way : edge.way->reversed()});
            }
        }
    return winding(ways);
}

/// "(x, y, z)" in mm, in a few digits.
std::string words(const Vector3& point) {
    std::ostringstream text;
    text.precision(6);
    text << "(" << point.x() << ", " << point.y() << ", " << point.z() << ")";
    return text.str();
}

}  // namespace

BorderWinding border_winding(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                             const PatchRange& range, const std::vector<PatchUmbilics>& found,
                             const std::vector<SightedUmbilic>& umbilics, std::span<const Pole> poles,
                             std::span<const ParameterBox> open) {
    BorderWinding result;
    double total = 0.0;
    bool around_umbilics = false;
    for (const SightedUmbilic& umbilic : umbilics) total += umbilic.umbilic.index;
    for (const PatchRange& block : smooth_blocks(surface, range)) {
        const std::vector<Place> places = places_in(block, patches, umbilics);
        ParameterBox domain = domain_of(surface, block);
        bool easy = true;
        for (const Pole& pole : poles) {
            ParameterInterval& side = across_u(pole.edge) ? domain.u : domain.v;
            if (!(side.low < pole.circle && pole.circle < side.high)) continue;
            easy = false;
            (pole.edge == PatchEdge::u_low || pole.edge == PatchEdge::v_low ? side.low : side.high) = pole.circle;
        }
        std::vector<ParameterBox> left_open;
        std::copy_if(open.begin(), open.end(), std::back_inserter(left_open),
                     [&](const ParameterBox& box) { return meet(box, domain); });
        easy = easy && left_open.empty() &&
               std::none_of(places.begin(), places.end(), [&](const Place& place) { return on_border(place, domain); });
        if (easy) {
            if (const std::optional<double> turns = winding_along_edges(patches, block, found)) {
                total += 0.5 * *turns;
                for (const Place& place : places) total -= place.index;
                continue;
            }
        }
        BlockBorder border(surface, patches, input, block, domain, places, std::move(left_open));
        const std::optional<double> excess = border.excess();
        if (!excess) {
            const Vector2& at = border.obstacle();
            result.why = "the principal directions cannot be followed along the border near " +
                         words(surface.value(at.x(), at.y()));
            return result;
        }
        total += *excess;
        around_umbilics = around_umbilics || border.went_around();
        result.left_out += border.places_left_out();
    }
    // A pole that is no umbilic has index 0, or is a tip of the surface.
    for (const Pole& pole : poles)
        if (pole.full && pole.umbilic) total += pole.umbilic->index;
    result.turns = total;
    result.why = "the indices sum to the winding along the border";
    std::vector<std::string> around;
    if (!poles.empty()) around.push_back("the poles");
    if (around_umbilics) around.push_back("the umbilics on it");
    if (!around.empty()) result.why += ", which goes around " + around.front();
    if (around.size() > 1) result.why += " and " + around.back();
    return result;
}

Certificate certify(const BorderWinding& winding, const FaceUmbilics& found) {
    Certificate certificate;
    int unknown = 0;
    double undecided = 0.0;
    for (const Umbilic& umbilic : found.umbilics)
        if (umbilic.pole != PoleKind::border) certificate.index_sum += umbilic.index;
    for (const UndecidedCluster& cluster : found.undecided) {
        undecided += cluster.index.value_or(0.0);
        unknown += !cluster.index;
    }
    certificate.index_sum += undecided;
    std::vector<std::string> left_out;
    if (!found.regions.empty()) left_out.push_back("umbilic regions");
    if (!found.lines.empty()) left_out.push_back("lines of umbilics");
    if (!found.undecided.empty()) left_out.push_back("undecided places");
    if (winding.left_out > 0)
        left_out.push_back("places on the border where the principal directions are lost in rounding");
    std::string outside;
    for (std::size_t k = 0; k < left_out.size(); ++k)
        outside += (k == 0 ? ", outside of " : k + 1 < left_out.size() ? ", " : " and ") + left_out[k];

    if (found.statistics.budget_exhausted) {
        certificate.why = "not evaluated: the search used up its boxes";
    } else if (!winding.turns) {
        certificate.why = "not evaluated: " + winding.why;
    } else if (const double turns = *winding.turns + undecided; turns != certificate.index_sum) {
        certificate.boundary_winding = turns;
        certificate.complete = false;
        certificate.why =
            "an umbilic is missing: the indices found do not sum to the winding along the border" + outside;
    } else if (unknown > 0) {
        certificate.why = "not evaluated: " +
                          (unknown == 1 ? std::string("an undecided place has an index that is")
                                        : std::to_string(unknown) + " undecided places have indices that are") +
                          " not known; " + winding.why + outside;
    } else {
        certificate.boundary_winding = turns;
        certificate.complete = true;
        certificate.why = winding.why + outside;
    }
    return certificate;
}

}  // namespace umbilic
