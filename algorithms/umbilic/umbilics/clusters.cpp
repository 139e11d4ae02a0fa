// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/clusters.h>

#include <algorithm>
#include <array>
#include <map>

#include <umbilic/bernstein/box_clusters.h>
#include <umbilic/umbilics/block_border.h>
#include <umbilic/umbilics/certificate.h>
#include <umbilic/umbilics/lines.h>
#include <umbilic/umbilics/regions.h>
#include <umbilic/umbilics/winding.h>

namespace umbilic {

namespace {

/// A heap longer than this many smallest boxes is a line.
constexpr double line_length = 8.0;
/// Boxes whose gap is below this share of the domain touch; box ends differ by roundings only.
constexpr double touching = 1e-12;
/// A patch is umbilic everywhere if it is so within rounding on this share of it.
constexpr double zero_share = 0.5;
/// Open boxes within this many resolutions of a region belong to its border.
constexpr double border_width = 4.0;
/// Heaps with a diameter below this many resolutions of the surface's box are a single point (a pole).
constexpr double point_like = 4.0;
/// Distances of the ways around a cluster that are tried: relative to its own size, and in resolutions.
constexpr std::array<double, 4> ring_shares = {0.5, 2.0, 8.0, 32.0};
constexpr std::array<double, 5> ring_margins = {0.01, 0.1, 1.0, 4.0, 16.0};

/// Boxes that touch, joined.
std::vector<std::vector<ParameterBox>> heaps(const std::vector<ParameterBox>& boxes, const ParameterBox& domain) {
    std::vector<Interval> sides;
    for (const ParameterBox& box : boxes) {
        const auto relative = [](const ParameterInterval& part, const ParameterInterval& whole) {
            return Interval((part.low - whole.low) / whole.length(), (part.high - whole.low) / whole.length());
        };
        sides.push_back(relative(box.u, domain.u));
        sides.push_back(relative(box.v, domain.v));
    }
    const BoxClusters clusters = cluster_boxes(sides, 2, touching);
    std::vector<std::vector<ParameterBox>> result(clusters.count);
    for (std::size_t k = 0; k < boxes.size(); ++k) result[clusters.cluster[k]].push_back(boxes[k]);
    return result;
}

ParameterBox hull(const std::vector<ParameterBox>& boxes) {
    ParameterBox result = boxes.front();
    for (const ParameterBox& box : boxes) {
        result.u = {std::min(result.u.low, box.u.low), std::max(result.u.high, box.u.high)};
        result.v = {std::min(result.v.low, box.v.low), std::max(result.v.high, box.v.high)};
    }
    return result;
}

std::vector<Vector3> corner_points(const NurbsSurface& surface, const std::vector<ParameterBox>& boxes) {
    std::vector<Vector3> result;
    for (const ParameterBox& box : boxes)
        for (const double u : {box.u.low, box.u.high})
            for (const double v : {box.v.low, box.v.high}) result.push_back(surface.value(u, v));
    return result;
}

/// Number of the patch that holds a box.
std::size_t patch_of(const NurbsSurface& surface, const BezierPatches& patches, const ParameterBox& box) {
    return static_cast<std::size_t>(surface.u_knots().piece(box.u.middle())) * patches.v_count +
           static_cast<std::size_t>(surface.v_knots().piece(box.v.middle()));
}

/// Patches that are umbilic everywhere, increasing. A polynomial that vanishes on an open set vanishes everywhere;
/// small boxes in which it only is below rounding belong to lines and points at which it has a high order.
std::vector<std::size_t> umbilic_patches(const NurbsSurface& surface, const BezierPatches& patches,
                                         const std::vector<OpenPart>& parts) {
    std::map<std::size_t, double> share;
    for (const OpenPart& part : parts) {
        if (!part.zero) continue;
        const std::size_t k = patch_of(surface, patches, part.box);
        const ParameterBox& whole = patches.patches[k].domain;
        share[k] += part.box.u.length() / whole.u.length() * (part.box.v.length() / whole.v.length());
    }
    std::vector<std::size_t> result;
    for (const auto& [patch, covered] : share)
        if (covered >= zero_share) result.push_back(patch);
    return result;
}

/// Moves the boxes that lie beside pieces of regions to those regions' borders; returns the others.
std::vector<ParameterBox> take_borders(const NurbsSurface& surface, std::vector<ParameterBox> boxes, double resolution,
                                       std::vector<UmbilicRegion>& regions) {
    const ParameterBox domain = surface.domain();
    const double u_gap = border_width * resolution * domain.u.length();
    const double v_gap = border_width * resolution * domain.v.length();
    const auto beside = [&](const ParameterBox& box, const ParameterBox& piece) {
        return box.u.low <= piece.u.high + u_gap && piece.u.low <= box.u.high + u_gap &&
               box.v.low <= piece.v.high + v_gap && piece.v.low <= box.v.high + v_gap;
    };
    std::vector<ParameterBox> left;
    for (const ParameterBox& box : boxes) {
        const auto region = std::find_if(regions.begin(), regions.end(), [&](const UmbilicRegion& candidate) {
            return std::any_of(candidate.boxes.begin(), candidate.boxes.end(),
                               [&](const ParameterBox& piece) { return beside(box, piece); });
        });
        if (region == regions.end())
            left.push_back(box);
        else
            region->border.push_back(box);
    }
    return left;
}

ParameterInterval common_part(const ParameterInterval& a, const ParameterInterval& b) {
    return {b.clamp(a.low), b.clamp(a.high)};
}

/// Index of whatever lies in `part` of a cluster, which is in one smooth block, from the winding around it: within the
/// block or, where (A, B) is too small on the block's border, beyond it, where the polynomials continue. (A, B) may
/// also be too small near a degenerate point; then a wider way around it is taken, as long as it holds nothing else
/// that is undecided.
std::optional<double> index_in_block(const NurbsSurface& surface, const BezierPatches& patches,
                                     const InputRounding& input, const PatchRange& range,
                                     const std::vector<OpenPart>& parts, const ParameterBox& cluster,
                                     const UmbilicOptions& options, const FaceUmbilics& result) {
    const ParameterBox domain = surface.domain();
    const std::vector<double>&u = surface.u_knots().breaks(), &v = surface.v_knots().breaks();
    const ParameterBox block{{u[range.u_first], u[range.u_last]}, {v[range.v_first], v[range.v_last]}};
    const ParameterBox part{common_part(cluster.u, block.u), common_part(cluster.v, block.v)};
    std::vector<Vector2> margins;
    for (const double share : ring_shares) margins.emplace_back(share * part.u.length(), share * part.v.length());
    for (const double margin : ring_margins)
        margins.emplace_back(
            std::max(ring_shares[0] * part.u.length(), margin * options.resolution * domain.u.length()),
            std::max(ring_shares[0] * part.v.length(), margin * options.resolution * domain.v.length()));
    PathTurning turning(surface, patches, input, range);
    for (const Vector2& margin : margins) {
        const ParameterBox wide{{part.u.low - margin.x(), part.u.high + margin.x()},
                                {part.v.low - margin.y(), part.v.high + margin.y()}};
        const ParameterBox narrow{common_part(wide.u, block.u), common_part(wide.v, block.v)};
        if (std::any_of(parts.begin(), parts.end(),
                        [&](const OpenPart& other) { return !meet(other.box, cluster) && meet(other.box, narrow); }))
            continue;
        // Beyond the block the polynomials may have zeros of their own: no farther out than some of the cluster's own
        // sizes.
        const bool near =
            margin.x() <= ring_shares.back() * part.u.length() && margin.y() <= ring_shares.back() * part.v.length();
        for (const ParameterBox* const ring : {&narrow, near ? &wide : nullptr}) {
            if (!ring) continue;
            const std::optional<double> winding =
                turning.winding(border_of_difference(std::span<const ParameterBox>(ring, 1), {}));
            if (!winding) continue;
            double index = 0.5 * *winding;
            for (const Umbilic& umbilic : result.umbilics)
                if (narrow.contains(umbilic.at.u, umbilic.at.v)) index -= umbilic.index;
            return index;
        }
    }
    return std::nullopt;
}

/// The sum over the smooth blocks that the cluster lies in.
std::optional<double> cluster_index(const NurbsSurface& surface, const BezierPatches& patches,
                                    const InputRounding& input, const std::vector<OpenPart>& parts,
                                    const ParameterBox& cluster, const UmbilicOptions& options,
                                    const FaceUmbilics& result) {
    const std::vector<double>&u = surface.u_knots().breaks(), &v = surface.v_knots().breaks();
    double sum = 0.0;
    for (const PatchRange& range : smooth_blocks(surface, {0, patches.u_count, 0, patches.v_count})) {
        const auto overlaps = [](const ParameterInterval& a, double low, double high) {
            return std::min(a.high, high) > std::max(a.low, low);
        };
        if (!overlaps(cluster.u, u[range.u_first], u[range.u_last]) ||
            !overlaps(cluster.v, v[range.v_first], v[range.v_last]))
            continue;
        const std::optional<double> index =
            index_in_block(surface, patches, input, range, parts, cluster, options, result);
        if (!index) return std::nullopt;
        sum += *index;
    }
    return sum;
}

}  // namespace

void sort_open_parts(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                     const std::vector<OpenPart>& parts, const UmbilicOptions& options, FaceUmbilics& result) {
    const std::vector<std::size_t> whole = umbilic_patches(surface, patches, parts);
    std::vector<ParameterBox> boxes, pieces;
    for (const std::size_t k : whole) pieces.push_back(patches.patches[k].domain);
    for (const OpenPart& part : parts)
        if (!std::binary_search(whole.begin(), whole.end(), patch_of(surface, patches, part.box)))
            boxes.push_back(part.box);
    if (!pieces.empty()) {
        result.regions = make_regions(surface, pieces);
        boxes = take_borders(surface, std::move(boxes), options.resolution, result.regions);
    }

    const ParameterBox domain = surface.domain();
    const double size = surface.pole_box().diagonal();
    const auto elongated = [&](const std::vector<ParameterBox>& heap) {
        const ParameterBox extent = hull(heap);
        const double length = std::max(extent.u.length() / domain.u.length(), extent.v.length() / domain.v.length());
        if (length <= line_length * options.resolution) return false;
        BoundingBox box;
        for (const Vector3& point : corner_points(surface, heap)) box.add(point);
        return box.diagonal() > point_like * options.resolution * size;
    };
    const auto undecided = [&](std::vector<ParameterBox> heap) {
        const std::optional<double> index = cluster_index(surface, patches, input, parts, hull(heap), options, result);
        result.undecided.push_back({std::move(heap), index});
    };
    // Lines are traced through all heaps before they are joined across seams.
    std::vector<ParameterBox> through_lines;
    for (std::vector<ParameterBox>& heap : heaps(boxes, domain)) {
        if (elongated(heap))
            through_lines.insert(through_lines.end(), heap.begin(), heap.end());
        else
            undecided(std::move(heap));
    }
    if (through_lines.empty()) return;
    result.lines = trace_lines(surface, through_lines, options.resolution);
    for (std::vector<ParameterBox>& heap : heaps(through_lines, domain)) undecided(std::move(heap));
}

}  // namespace umbilic
