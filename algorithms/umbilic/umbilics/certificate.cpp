// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/certificate.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace umbilic {

namespace {

/// Half sides of a detour around an umbilic on the border that are tried, relative to its patch: large beside the
/// radius of the umbilic, small beside its distance from others.
constexpr std::array<double, 4> detour_sizes = {1e-4, 1e-5, 1e-6, 1e-7};
/// An umbilic nearer to the border than this share of its patch is gone around where the border cannot be evaluated.
constexpr double near_border = 1e-5;
/// Sightings nearer than this share of a patch are one place.
constexpr double same_place = 1e-8;

constexpr std::array<PatchEdge, 4> all_edges = {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low,
                                                PatchEdge::v_high};

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

/// An umbilic as a block sees it.
struct Place {
    Vector2 at;
    Vector2 patch_size;
    double index = 0.0;
};

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

/// Distance of a place from the nearest side of its block, relative to its patch.
double border_gap(const Place& place, const ParameterBox& block) {
    return std::min({std::abs(place.at.x() - block.u.low) / place.patch_size.x(),
                     std::abs(place.at.x() - block.u.high) / place.patch_size.x(),
                     std::abs(place.at.y() - block.v.low) / place.patch_size.y(),
                     std::abs(place.at.y() - block.v.high) / place.patch_size.y()});
}

std::array<Vector2, 4> corners(const ParameterBox& box) {
    return {Vector2(box.u.low, box.v.low), Vector2(box.u.high, box.v.low), Vector2(box.u.high, box.v.high),
            Vector2(box.u.low, box.v.high)};
}

/// Border of the union of a rectangle with small disjoint boxes that meet its border, counter-clockwise.
std::vector<Vector2> border_with_detours(const ParameterBox& block, const std::vector<ParameterBox>& detours) {
    const std::array<Vector2, 4> corner = corners(block);
    std::vector<Vector2> path;
    for (int side = 0; side < 4; ++side) {
        const Vector2 start = corner[side], end = corner[(side + 1) % 4];
        const bool along_u = side % 2 == 0, forward = side < 2;
        const double line = along_u ? start.y() : start.x();
        const auto point = [&](double along, double across) {
            return along_u ? Vector2(along, across) : Vector2(across, along);
        };
        struct Piece {
            double from, to, outside;
        };
        std::vector<Piece> pieces;
        for (const ParameterBox& box : detours) {
            const ParameterInterval &along = along_u ? box.u : box.v, &across = along_u ? box.v : box.u;
            if (!across.contains(line)) continue;
            const double outside = side == 0 || side == 3 ? across.low : across.high;
            pieces.push_back(forward ? Piece{along.low, along.high, outside} : Piece{along.high, along.low, outside});
        }
        std::sort(pieces.begin(), pieces.end(),
                  [&](const Piece& a, const Piece& b) { return forward ? a.from < b.from : a.from > b.from; });
        const double first = along_u ? start.x() : start.y(), last = along_u ? end.x() : end.y();
        const auto before = [&](double a, double b) { return forward ? a < b : a > b; };
        const bool from_detour = !pieces.empty() && before(pieces.front().from, first);
        if (!from_detour) path.push_back(start);
        for (const Piece& piece : pieces) {
            if (!before(piece.from, first)) path.push_back(point(piece.from, line));
            path.push_back(point(piece.from, piece.outside));
            if (before(last, piece.to)) break;  // around the corner: the next side starts at the outer corner
            path.push_back(point(piece.to, piece.outside));
            path.push_back(point(piece.to, line));
        }
    }
    return path;
}

/// A box around `place` that holds no other umbilic; none if no size serves.
std::optional<ParameterBox> detour(const Place& place, const std::vector<Place>& places, const ParameterBox& block,
                                   PathTurning& turning) {
    const double gap = border_gap(place, block);
    for (const double size : detour_sizes) {
        const Vector2 half = size * place.patch_size;
        if (gap > 0.25 * size) continue;
        const auto crowds = [&](const Place& other) {
            return &other != &place && ((other.at - place.at).cwiseAbs().array() <= 4 * half.array()).all();
        };
        if (std::any_of(places.begin(), places.end(), crowds)) continue;
        const ParameterBox box{{place.at.x() - half.x(), place.at.x() + half.x()},
                               {place.at.y() - half.y(), place.at.y() + half.y()}};
        const std::optional<double> winding = turning.winding(corners(box));
        if (winding && 0.5 * *winding == place.index) return box;
    }
    return std::nullopt;
}

/// Winding of one block whose border cannot be evaluated along its edges as they are.
std::optional<double> difficult_winding(const NurbsSurface& surface, const BezierPatches& patches,
                                        const InputRounding& input, const PatchRange& block, const ParameterBox& domain,
                                        const std::vector<Place>& places) {
    PathTurning turning(surface, patches, input, block);
    std::vector<ParameterBox> detours;
    for (const Place& place : places) {
        if (border_gap(place, domain) > near_border) continue;
        const std::optional<ParameterBox> box = detour(place, places, domain, turning);
        if (!box) return std::nullopt;
        detours.push_back(*box);
    }
    return turning.winding(border_with_detours(domain, detours));
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

BorderWinding border_winding(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                             const PatchRange& range, const std::vector<PatchUmbilics>& found,
                             const std::vector<SightedUmbilic>& umbilics, std::span<const Pole> poles) {
    BorderWinding result;
    double total = 0.0, counted = 0.0, listed = 0.0;
    int detoured = 0;
    for (const SightedUmbilic& umbilic : umbilics) listed += umbilic.umbilic.index;
    for (const PatchRange& block : smooth_blocks(surface, range)) {
        const std::vector<Place> places = places_in(block, patches, umbilics);
        for (const Place& place : places) counted += place.index;
        ParameterBox domain = domain_of(surface, block);
        bool at_pole = false;
        for (const Pole& pole : poles) {
            const ParameterInterval& side = across_u(pole.edge) ? domain.u : domain.v;
            if (!(side.low < pole.circle && pole.circle < side.high)) continue;
            at_pole = true;
            ParameterInterval& cut = across_u(pole.edge) ? domain.u : domain.v;
            (pole.edge == PatchEdge::u_low || pole.edge == PatchEdge::v_low ? cut.low : cut.high) = pole.circle;
        }
        double angle = 0.0;
        bool evaluated = !at_pole && std::none_of(places.begin(), places.end(), [&](const Place& place) {
            return border_gap(place, domain) <= near_border;
        });
        for (int i = block.u_first; i < block.u_last && evaluated; ++i)
            for (int j = block.v_first; j < block.v_last && evaluated; ++j) {
                if (i > block.u_first && i + 1 < block.u_last && j > block.v_first && j + 1 < block.v_last) {
                    j = block.v_last - 2;  // inner patches have no border
                    continue;
                }
                const std::size_t k = static_cast<std::size_t>(i) * patches.v_count + j;
                for (const PatchEdge edge : all_edges) {
                    const EdgeTurning& part = found[k].turning[static_cast<int>(edge)];
                    if (!part.wanted) continue;
                    if (!part.angle)
                        evaluated = false;
                    else
                        angle += edge == PatchEdge::v_low || edge == PatchEdge::u_high ? *part.angle : -*part.angle;
                }
            }
        std::optional<double> winding = evaluated ? whole_turns(angle) : std::nullopt;
        if (!winding) {
            winding = difficult_winding(surface, patches, input, block, domain, places);
            ++detoured;
        }
        if (!winding) {
            result.why = "an umbilic lies too near to the border of the surface or of one of its smooth parts";
            return result;
        }
        total += 0.5 * *winding;
    }
    // What several sides of one border see is one umbilic.
    total -= counted - listed;
    // A pole that is no umbilic has index 0, or is a tip of the surface.
    for (const Pole& pole : poles)
        if (pole.full && pole.umbilic) total += pole.umbilic->index;
    result.turns = total;
    result.why = "the indices sum to the winding along the border";
    if (detoured > 0 && !poles.empty())
        result.why += ", which runs around the poles";
    else if (detoured > 0)
        result.why += ", which goes around the umbilics on it";
    return result;
}

Certificate certify(const BorderWinding& winding, const FaceUmbilics& found) {
    Certificate certificate;
    bool unknown = false;
    for (const Umbilic& umbilic : found.umbilics)
        if (umbilic.pole != PoleKind::border) certificate.index_sum += umbilic.index;
    for (const UndecidedCluster& cluster : found.undecided) {
        certificate.index_sum += cluster.index.value_or(0.0);
        unknown = unknown || !cluster.index;
    }
    if (!found.regions.empty())
        certificate.why = "not evaluated: there are umbilic regions";
    else if (!found.lines.empty())
        certificate.why = "not evaluated: there are lines of umbilics";
    else if (found.statistics.budget_exhausted)
        certificate.why = "not evaluated: the search used up its boxes";
    else if (!winding.turns)
        certificate.why = "not evaluated: " + winding.why;
    else if (unknown)
        certificate.why = "not evaluated: there are undecided boxes whose index is unknown";
    else {
        certificate.boundary_winding = *winding.turns;
        certificate.complete = certificate.boundary_winding == certificate.index_sum;
        certificate.why = *certificate.complete ? winding.why
                                                : "an umbilic is missing: the indices found do not sum to the winding "
                                                  "along the border";
        if (*certificate.complete && !found.undecided.empty())
            certificate.why += ", undecided clusters counted with the winding around them";
    }
    return certificate;
}

}  // namespace umbilic
