// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/regions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/math/quadrature/gauss.hpp>

#include <umbilic/differential/curvature.h>
#include <umbilic/differential/elementary_fit.h>

namespace umbilic {

namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point>;
using Polygons = bg::model::multi_polygon<Polygon>;
using Ring = Polygon::ring_type;

/// Pieces touch if their gap is below this share of the domain: their ends are the same knots.
constexpr double touching = 1e-12;
/// Largest deviation from a plane or sphere, relative to the region's extent, of what is called one.
constexpr double same_surface = 1e-6;
/// Neighbouring pieces belong together if their curvatures, times the surface's size, and their normals along the
/// common edge differ by less than this.
constexpr double same_curvature = 1e-5;
/// Points per direction that a piece is represented by, and most points a surface is fitted to.
constexpr int piece_points = 5;
constexpr std::size_t most_points = 4000;

bool touch(const ParameterBox& a, const ParameterBox& b, const ParameterBox& domain) {
    const double u = touching * domain.u.length(), v = touching * domain.v.length();
    const double u_overlap = std::min(a.u.high, b.u.high) - std::max(a.u.low, b.u.low);
    const double v_overlap = std::min(a.v.high, b.v.high) - std::max(a.v.low, b.v.low);
    // Along an edge, not at a corner only.
    return (u_overlap >= -u && v_overlap > v) || (v_overlap >= -v && u_overlap > u);
}

/// Curvature of a piece (all normal curvatures are equal), at its middle.
double piece_curvature(const NurbsSurface& surface, const ParameterBox& box) {
    return curvature(surface, box.u.middle(), box.v.middle()).mean();
}

/// Sine between the normals of two pieces at the middle of their common edge.
double crease(const NurbsSurface& surface, const ParameterBox& a, const ParameterBox& b) {
    const auto common = [](const ParameterInterval& x, const ParameterInterval& y) {
        return 0.5 * (std::max(x.low, y.low) + std::min(x.high, y.high));
    };
    const double u = common(a.u, b.u), v = common(a.v, b.v);
    const auto normal = [&](const ParameterBox& box) {
        const SurfaceDerivatives d = surface.derivatives(u, v, 1, u < box.u.high ? Side::right : Side::left,
                                                         v < box.v.high ? Side::right : Side::left);
        return regular(d) ? unit_normal(d) : Vector3(Vector3::Zero());
    };
    return normal(a).cross(normal(b)).norm();
}

std::vector<std::vector<ParameterBox>> groups(const NurbsSurface& surface, const std::vector<ParameterBox>& pieces) {
    const ParameterBox domain = surface.domain();
    const double size = surface.pole_box().diagonal();
    std::vector<double> kappa;
    for (const ParameterBox& piece : pieces) kappa.push_back(size * piece_curvature(surface, piece));
    std::vector<std::size_t> parent(pieces.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::size_t k) {
        while (parent[k] != k) k = parent[k] = parent[parent[k]];
        return k;
    };
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            if (!touch(pieces[i], pieces[j], domain)) continue;
            const bool one = std::abs(kappa[i] - kappa[j]) <= same_curvature * std::max(1.0, std::abs(kappa[i])) &&
                             crease(surface, pieces[i], pieces[j]) <= same_curvature;
            if (one) parent[std::max(root(i), root(j))] = std::min(root(i), root(j));
        }
    std::vector<std::vector<ParameterBox>> result;
    std::vector<std::size_t> number(pieces.size(), pieces.size());
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const std::size_t r = root(k);
        if (number[r] == pieces.size()) {
            number[r] = result.size();
            result.emplace_back();
        }
        result[number[r]].push_back(pieces[k]);
    }
    return result;
}

/// Tells the plane or sphere a region lies on.
void identify(const NurbsSurface& surface, UmbilicRegion& region) {
    std::vector<Vector3> points;
    const std::size_t stride = 1 + region.boxes.size() * piece_points * piece_points / most_points;
    for (std::size_t k = 0; k < region.boxes.size(); k += stride)
        for (int i = 0; i < piece_points; ++i)
            for (int j = 0; j < piece_points; ++j) {
                const ParameterBox& box = region.boxes[k];
                points.push_back(surface.value(box.u.low + i * box.u.length() / (piece_points - 1),
                                               box.v.low + j * box.v.length() / (piece_points - 1)));
            }
    BoundingBox extent;
    for (const Vector3& point : points) extent.add(point);
    const double accepted = same_surface * extent.diagonal();
    if (!(accepted > 0.0)) return;
    const ElementaryFit plane = fit_elementary(SurfaceKind::plane, *plane_through(points), points);
    region.surface = plane.surface;
    region.deviation = plane.deviation;
    if (plane.deviation <= accepted) region.kind = UmbilicRegionKind::planar;
    const std::optional<ElementarySurface> sphere = sphere_through(points);
    if (!sphere) return;
    const ElementaryFit round = fit_elementary(SurfaceKind::sphere, *sphere, points);
    // A plane is a sphere, too, up to rounding: a sphere must be much nearer.
    if (round.deviation > accepted || 10.0 * round.deviation > plane.deviation) return;
    region.kind = UmbilicRegionKind::spherical;
    region.surface = round.surface;
    region.deviation = round.deviation;
}

Ring ring(const ParameterBox& box) {
    Ring result = {{box.u.low, box.v.low}, {box.u.low, box.v.high}, {box.u.high, box.v.high}, {box.u.high, box.v.low}};
    result.push_back(result.front());
    return result;
}

/// What the loops bound by the even-odd rule.
Polygons inside(const TrimmingRegion& loops) {
    Polygons result;
    for (std::size_t k = 0; k < loops.loops().size(); ++k) {
        Polygon polygon;
        for (const Vector2& at : loops.polyline(static_cast<int>(k)))
            bg::append(polygon.outer(), Point(at.x(), at.y()));
        bg::correct(polygon);
        Polygons next;
        bg::sym_difference(result, polygon, next);
        result = std::move(next);
    }
    return result;
}

/// Area of the image of a polygon within one piece of the surface, by Green's theorem: the integral along its border
/// of the integral of the area element from the piece's lower side in u.
template <typename Rule>
double image_area(const NurbsSurface& surface, const ParameterBox& piece, const Polygon& polygon) {
    // Evaluation at the upper sides of the piece stays on the piece.
    const auto element = [&](double u, double v) {
        const SurfaceDerivatives d = surface.derivatives(u, v, 1, u < piece.u.high ? Side::right : Side::left,
                                                         v < piece.v.high ? Side::right : Side::left);
        return d.r_u().cross(d.r_v()).norm();
    };
    const auto along = [&](const Ring& border) {
        double sum = 0.0;
        for (std::size_t k = 0; k + 1 < border.size(); ++k) {
            const double u = border[k].x(), v = border[k].y();
            const double du = border[k + 1].x() - u, dv = border[k + 1].y() - v;
            if (dv == 0.0) continue;
            sum += dv * Rule::integrate(
                            [&](double t) {
                                const double to = u + t * du, at = v + t * dv;
                                if (!(to > piece.u.low)) return 0.0;
                                return Rule::integrate([&](double s) { return element(s, at); }, piece.u.low, to);
                            },
                            0.0, 1.0);
        }
        return sum;
    };
    // Rings run clockwise outside, counter-clockwise around holes.
    double sum = along(polygon.outer());
    for (const Ring& hole : polygon.inners()) sum += along(hole);
    return -sum;
}

double image_area(const NurbsSurface& surface, const ParameterBox& piece, const Polygon& polygon) {
    // The area element of a polynomial plane is a polynomial.
    if (surface.rational() || std::max(surface.u_degree(), surface.v_degree()) > 3)
        return image_area<boost::math::quadrature::gauss<double, 15>>(surface, piece, polygon);
    return image_area<boost::math::quadrature::gauss<double, 7>>(surface, piece, polygon);
}

RegionBoundary boundary(const NurbsSurface& surface, const Ring& border) {
    // Sides along a piece are straight in the parameters but curved in space.
    constexpr int parts = 8;
    const ParameterBox domain = surface.domain();
    RegionBoundary result;
    for (std::size_t k = 0; k + 1 < border.size(); ++k) {
        const Vector2 from(border[k].x(), border[k].y()), to(border[k + 1].x(), border[k + 1].y());
        const bool is_long = std::abs(to.x() - from.x()) > 0.01 * domain.u.length() ||
                             std::abs(to.y() - from.y()) > 0.01 * domain.v.length();
        for (int i = 0; i < (is_long ? parts : 1); ++i) {
            result.parameters.push_back(from + (to - from) * i / parts);
            result.points.push_back(surface.value(result.parameters.back().x(), result.parameters.back().y()));
        }
    }
    result.parameters.push_back(result.parameters.front());
    result.points.push_back(result.points.front());
    return result;
}

/// The pieces joined to fewer, longer boxes.
std::vector<ParameterBox> joined(std::vector<ParameterBox> boxes) {
    const auto join = [&](ParameterInterval ParameterBox::*along, ParameterInterval ParameterBox::*across) {
        std::stable_sort(boxes.begin(), boxes.end(), [&](const ParameterBox& a, const ParameterBox& b) {
            if ((a.*across).low != (b.*across).low) return (a.*across).low < (b.*across).low;
            return (a.*along).low < (b.*along).low;
        });
        std::vector<ParameterBox> result;
        for (const ParameterBox& box : boxes) {
            const bool continues = !result.empty() && (result.back().*across).low == (box.*across).low &&
                                   (result.back().*across).high == (box.*across).high &&
                                   (result.back().*along).high == (box.*along).low;
            if (continues)
                (result.back().*along).high = (box.*along).high;
            else
                result.push_back(box);
        }
        boxes = std::move(result);
    };
    join(&ParameterBox::v, &ParameterBox::u);
    join(&ParameterBox::u, &ParameterBox::v);
    return boxes;
}

/// The part of a box that is allowed; all of it if nothing is given.
Polygons allowed_part(const ParameterBox& box, const Polygons* allowed) {
    Polygons result;
    if (allowed)
        bg::intersection(*allowed, ring(box), result);
    else
        result.push_back({ring(box)});
    return result;
}

void set_extent(const NurbsSurface& surface, const Polygons* allowed, UmbilicRegion& region) {
    region.area = 0.0;
    for (const ParameterBox& piece : region.boxes)
        for (const Polygon& polygon : allowed_part(piece, allowed)) region.area += image_area(surface, piece, polygon);
    Polygons all;
    for (const ParameterBox& box : joined(region.boxes)) {
        Polygons sum;
        bg::union_(all, allowed_part(box, allowed), sum);
        all = std::move(sum);
    }
    region.boundary.clear();
    for (const Polygon& polygon : all) {
        region.boundary.push_back(boundary(surface, polygon.outer()));
        for (const Ring& hole : polygon.inners()) region.boundary.push_back(boundary(surface, hole));
    }
}

}  // namespace

std::vector<UmbilicRegion> make_regions(const NurbsSurface& surface, const std::vector<ParameterBox>& pieces) {
    std::vector<UmbilicRegion> result;
    for (std::vector<ParameterBox>& group : groups(surface, pieces)) {
        UmbilicRegion region;
        region.boxes = std::move(group);
        identify(surface, region);
        set_extent(surface, nullptr, region);
        result.push_back(std::move(region));
    }
    return result;
}

void trim(const NurbsSurface& surface, const TrimmingRegion& loops, UmbilicRegion& region) {
    const Polygons allowed = inside(loops);
    set_extent(surface, &allowed, region);
}

}  // namespace umbilic
