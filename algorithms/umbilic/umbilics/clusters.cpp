// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/clusters.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include <umbilic/differential/curvature.h>
#include <umbilic/umbilics/winding.h>

namespace umbilic {

namespace {

/// A heap longer than this many smallest boxes is a line.
constexpr double line_length = 8.0;
/// Boxes whose gap is below this share of the domain touch; box ends differ by roundings only.
constexpr double touching = 1e-12;
/// Curvature times the region's diagonal below which a region is planar, and relative spread of curvature below which
/// it is spherical.
constexpr double curvature_spread = 1e-6;
/// Heaps with a diameter below this many resolutions of the surface's box are a single point (a pole).
constexpr double point_like = 4.0;
/// Distances of the ways around a cluster that are tried, in resolutions.
constexpr std::array<double, 5> ring_margins = {0.01, 0.1, 1.0, 4.0, 16.0};
/// Boxes in which the curvature of a region is looked at.
constexpr std::size_t curvature_samples = 64;

std::vector<std::vector<std::size_t>> heaps(const std::vector<OpenPart>& parts, const ParameterBox& domain) {
    std::vector<std::size_t> parent(parts.size()), order(parts.size());
    std::iota(parent.begin(), parent.end(), 0);
    std::iota(order.begin(), order.end(), 0);
    const auto root = [&](std::size_t k) {
        while (parent[k] != k) k = parent[k] = parent[parent[k]];
        return k;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return parts[a].box.u.low < parts[b].box.u.low; });
    const double u_gap = touching * domain.u.length(), v_gap = touching * domain.v.length();
    std::vector<std::size_t> active;
    for (const std::size_t k : order) {
        const ParameterBox& box = parts[k].box;
        std::erase_if(active, [&](std::size_t other) { return parts[other].box.u.high < box.u.low - u_gap; });
        for (const std::size_t other : active) {
            const ParameterInterval& v = parts[other].box.v;
            if (v.low <= box.v.high + v_gap && box.v.low <= v.high + v_gap) {
                const std::size_t a = root(k), b = root(other);
                parent[std::max(a, b)] = std::min(a, b);
            }
        }
        active.push_back(k);
    }
    std::vector<std::vector<std::size_t>> result;
    std::vector<std::size_t> number(parts.size(), parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::size_t r = root(k);
        if (number[r] == parts.size()) {
            number[r] = result.size();
            result.emplace_back();
        }
        result[number[r]].push_back(k);
    }
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

std::vector<Vector3> centre_points(const NurbsSurface& surface, const std::vector<ParameterBox>& boxes) {
    std::vector<Vector3> result;
    result.reserve(boxes.size());
    for (const ParameterBox& box : boxes) result.push_back(surface.value(box.u.middle(), box.v.middle()));
    return result;
}

/// The points in the order of a walk from the one with the farthest partner to the nearest not yet visited.
std::vector<Vector3> chained(std::vector<Vector3> points) {
    std::size_t start = 0;
    double farthest = -1.0;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (const double distance = (points[k] - points[0]).squaredNorm(); distance > farthest) {
            farthest = distance;
            start = k;
        }
    std::swap(points[0], points[start]);
    for (std::size_t k = 1; k < points.size(); ++k) {
        const auto nearest =
            std::min_element(points.begin() + k, points.end(), [&](const Vector3& a, const Vector3& b) {
                return (a - points[k - 1]).squaredNorm() < (b - points[k - 1]).squaredNorm();
            });
        std::iter_swap(points.begin() + k, nearest);
    }
    return points;
}

/// Area of a box within one span in each direction.
double span_area(const NurbsSurface& surface, const ParameterBox& box) {
    // Gauss-Legendre rule with four nodes per direction, on parts of the box if the integrand is not a polynomial.
    constexpr std::array<double, 4> node = {-0.861136311594052575, -0.339981043584856265, 0.339981043584856265,
                                            0.861136311594052575};
    constexpr std::array<double, 4> weight = {0.347854845137453857, 0.652145154862546143, 0.652145154862546143,
                                              0.347854845137453857};
    const int parts = surface.rational() ? 4 : 1;
    const double du = box.u.length() / parts, dv = box.v.length() / parts;
    double sum = 0.0;
    for (int a = 0; a < parts; ++a)
        for (int b = 0; b < parts; ++b)
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j) {
                    const SurfaceDerivatives d = surface.derivatives(box.u.low + (a + 0.5 + 0.5 * node[i]) * du,
                                                                     box.v.low + (b + 0.5 + 0.5 * node[j]) * dv, 1);
                    sum += weight[i] * weight[j] * d.r_u().cross(d.r_v()).norm();
                }
    return 0.25 * sum * du * dv;
}

std::vector<ParameterInterval> pieces(const KnotVector& knots, const ParameterInterval& interval) {
    std::vector<ParameterInterval> result;
    double low = interval.low;
    for (const double knot : knots.breaks())
        if (low < knot && knot < interval.high) {
            result.push_back({low, knot});
            low = knot;
        }
    result.push_back({low, interval.high});
    return result;
}

double area(const NurbsSurface& surface, const ParameterBox& box) {
    double sum = 0.0;
    for (const ParameterInterval& u : pieces(surface.u_knots(), box.u))
        for (const ParameterInterval& v : pieces(surface.v_knots(), box.v)) sum += span_area(surface, {u, v});
    return sum;
}

std::optional<double> cluster_index(const NurbsSurface& surface, const BezierPatches& patches,
                                    const InputRounding& input, const std::vector<OpenPart>& parts,
                                    const ParameterBox& cluster, const UmbilicOptions& options,
                                    const FaceUmbilics& result) {
    const ParameterBox domain = surface.domain();
    // (A, B) may be too small near a degenerate point; then a wider way around it is taken, as long as it holds nothing
    // else that is undecided.
    for (const double margin : ring_margins) {
        const double u_margin = std::max(0.5 * cluster.u.length(), margin * options.resolution * domain.u.length());
        const double v_margin = std::max(0.5 * cluster.v.length(), margin * options.resolution * domain.v.length());
        const ParameterBox around{
            {domain.u.clamp(cluster.u.low - u_margin), domain.u.clamp(cluster.u.high + u_margin)},
            {domain.v.clamp(cluster.v.low - v_margin), domain.v.clamp(cluster.v.high + v_margin)}};
        const auto crowds = [&](const OpenPart& part) {
            const auto meet = [](const ParameterInterval& a, const ParameterInterval& b) {
                return a.low <= b.high && b.low <= a.high;
            };
            const bool own = meet(part.box.u, cluster.u) && meet(part.box.v, cluster.v);
            return !own && meet(part.box.u, around.u) && meet(part.box.v, around.v);
        };
        if (std::any_of(parts.begin(), parts.end(), crowds)) break;
        const std::optional<double> winding = rectangle_winding(surface, patches, input, around);
        if (!winding) continue;
        double index = 0.5 * *winding;
        for (const Umbilic& umbilic : result.umbilics)
            if (around.contains(umbilic.at.u, umbilic.at.v)) index -= umbilic.index;
        return index;
    }
    return std::nullopt;
}

}  // namespace

UmbilicRegion make_region(const NurbsSurface& surface, const std::vector<ParameterBox>& boxes) {
    UmbilicRegion region;
    region.boxes = boxes;
    for (const ParameterBox& box : boxes) region.area += area(surface, box);
    double lowest = 0.0, highest = 0.0;
    BoundingBox extent;
    bool first = true;
    const std::size_t stride = std::max<std::size_t>(1, boxes.size() / curvature_samples);
    for (std::size_t k = 0; k < boxes.size(); k += stride)
        for (const double s : {0.25, 0.75})
            for (const double t : {0.25, 0.75}) {
                const Curvature c = curvature(surface, boxes[k].u.low + s * boxes[k].u.length(),
                                              boxes[k].v.low + t * boxes[k].v.length());
                if (!c.regular) continue;
                extent.add(c.point);
                lowest = first ? c.kappa_min : std::min(lowest, c.kappa_min);
                highest = first ? c.kappa_max : std::max(highest, c.kappa_max);
                first = false;
            }
    const double largest = std::max(std::abs(lowest), std::abs(highest));
    if (first)
        region.kind = UmbilicRegionKind::other;
    else if (largest * extent.diagonal() <= curvature_spread)
        region.kind = UmbilicRegionKind::planar;
    else if (highest - lowest <= curvature_spread * largest)
        region.kind = UmbilicRegionKind::spherical;
    return region;
}

void sort_open_parts(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                     const std::vector<OpenPart>& parts, const UmbilicOptions& options, FaceUmbilics& result) {
    const ParameterBox domain = surface.domain();
    const double size = surface.pole_box().diagonal();
    for (const std::vector<std::size_t>& heap : heaps(parts, domain)) {
        std::vector<ParameterBox> boxes, zero_boxes;
        for (const std::size_t k : heap) {
            boxes.push_back(parts[k].box);
            if (parts[k].zero) zero_boxes.push_back(parts[k].box);
        }
        if (!zero_boxes.empty()) {
            // The undecided seam around the region is part of it within the resolution, but not of its area.
            UmbilicRegion region = make_region(surface, zero_boxes);
            for (const std::size_t k : heap)
                if (!parts[k].zero) region.border.push_back(parts[k].box);
            result.regions.push_back(std::move(region));
            continue;
        }
        const ParameterBox extent = hull(boxes);
        const double length = std::max(extent.u.length() / domain.u.length(), extent.v.length() / domain.v.length());
        if (length > line_length * options.resolution) {
            std::vector<Vector3> points = centre_points(surface, boxes);
            BoundingBox box;
            for (const Vector3& point : points) box.add(point);
            if (box.diagonal() > point_like * options.resolution * size || boxes.size() == 1) {
                UmbilicLine line;
                line.boxes = std::move(boxes);
                line.points = chained(std::move(points));
                result.lines.push_back(std::move(line));
                continue;
            }
        }
        result.undecided.push_back(
            {std::move(boxes), cluster_index(surface, patches, input, parts, extent, options, result)});
    }
}

}  // namespace umbilic
