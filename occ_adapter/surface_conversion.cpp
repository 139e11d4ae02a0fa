// SPDX-License-Identifier: LGPL-2.1-or-later
#include "surface_conversion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <GeomConvert.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>

#include <umbilic/core/errors.h>

#include "occ_types.h"
#include "profile_curve.h"

namespace umbilic {

namespace {

/// Deviation asked for where a surface can only be approximated, relative to the diagonal of the piece. Reaching it
/// is not required: the deviation that was reached is measured and stated.
constexpr double approximation_tolerance = 1e-7;
constexpr int approximation_degree = 8;
constexpr int approximation_segments = 200;

/// Distance between file's surface and NURBS, relative to the size of the piece and its distance from the origin,
/// that rounding explains.
constexpr double rounding_tolerance = 1e-11;

/// The two surfaces are compared on a grid of this many points a side.
constexpr int exact_check_points = 7;
constexpr int approximation_check_points = 41;

/// NURBS surface with its maps, before the placement.
struct Sheet {
    NurbsSurface surface;
    ParameterMap u_map, v_map;
};

struct Frame {
    Vector3 origin, x, y, z;

    explicit Frame(const gp_Ax3& axes)
        : origin(to_vector(axes.Location())),
          x(to_vector(axes.XDirection())),
          y(to_vector(axes.YDirection())),
          z(to_vector(axes.Direction())) {}
    Vector3 point(const Vector3& local) const { return origin + local.x() * x + local.y() * y + local.z() * z; }
};

Sheet revolved(const Frame& frame, const ProfileCurve& meridian, const ParameterInterval& angles) {
    const ProfileCurve arc = unit_arc(angles);
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (std::size_t i = 0; i < arc.poles.size(); ++i)
        for (std::size_t j = 0; j < meridian.poles.size(); ++j) {
            const Vector3 &turn = arc.poles[i], &p = meridian.poles[j];
            poles.push_back(
                frame.point({p.x() * turn.x() - p.y() * turn.y(), p.x() * turn.y() + p.y() * turn.x(), p.z()}));
            weights.push_back(arc.weights[i] * meridian.weights[j]);
        }
    return {NurbsSurface(arc.knots, meridian.knots, std::move(poles), std::move(weights)), arc.map, meridian.map};
}

ProfileCurve segment(const ParameterInterval& range, const Vector3& start, const Vector3& end) {
    return {KnotVector(1, {range.low, range.low, range.high, range.high}), {start, end}, {1.0, 1.0}, {}};
}

/// Arc in the xz plane around (center, 0, 0).
ProfileCurve meridian_arc(const ParameterInterval& range, double center, double radius) {
    ProfileCurve arc = unit_arc(range);
    for (Vector3& pole : arc.poles) pole = Vector3(center + radius * pole.x(), 0.0, radius * pole.y());
    return arc;
}

/// Sweeps the profile of the u direction along `direction`.
Sheet extruded(const ProfileCurve& profile, const Vector3& direction, const ParameterInterval& range) {
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (std::size_t i = 0; i < profile.poles.size(); ++i)
        for (const double v : {range.low, range.high}) {
            poles.push_back(profile.poles[i] + v * direction);
            weights.push_back(profile.weights[i]);
        }
    return {NurbsSurface(profile.knots, KnotVector(1, {range.low, range.low, range.high, range.high}), std::move(poles),
                         std::move(weights)),
            profile.map,
            {}};
}

struct Direction {
    std::vector<double> knots;
    std::vector<int> poles;
};

Direction direction(int degree, bool periodic, const TColStd_Array1OfReal& knots,
                    const TColStd_Array1OfInteger& multiplicities, int pole_count, const ParameterInterval& range) {
    if (periodic) {
        UnrolledKnots unrolled = unroll_periodic(degree, {knots.begin(), knots.end()},
                                                 {multiplicities.begin(), multiplicities.end()}, range);
        return {std::move(unrolled.knots), std::move(unrolled.poles)};
    }
    Direction result;
    for (int i = knots.Lower(); i <= knots.Upper(); ++i)
        result.knots.insert(result.knots.end(), multiplicities(i), knots(i));
    for (int i = 0; i < pole_count; ++i) result.poles.push_back(i);
    return result;
}

Sheet from_bspline(const Handle(Geom_BSplineSurface) & surface, const ParameterBox& range) {
    Direction u = direction(surface->UDegree(), surface->IsUPeriodic(), surface->UKnots(), surface->UMultiplicities(),
                            surface->NbUPoles(), range.u);
    Direction v = direction(surface->VDegree(), surface->IsVPeriodic(), surface->VKnots(), surface->VMultiplicities(),
                            surface->NbVPoles(), range.v);
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (const int i : u.poles)
        for (const int j : v.poles) {
            poles.push_back(to_vector(surface->Pole(i + 1, j + 1)));
            weights.push_back(surface->Weight(i + 1, j + 1));
        }
    return {NurbsSurface(KnotVector(surface->UDegree(), std::move(u.knots)),
                         KnotVector(surface->VDegree(), std::move(v.knots)), std::move(poles), std::move(weights)),
            {},
            {}};
}

Sheet from_revolution(const Geom_SurfaceOfRevolution& surface, const ProfileCurve& meridian,
                      const ParameterInterval& angles) {
    const Frame frame(gp_Ax3(surface.Location(), surface.Direction()));
    ProfileCurve local = meridian;
    for (Vector3& pole : local.poles) {
        const Vector3 from_origin = pole - frame.origin;
        pole = Vector3(from_origin.dot(frame.x), from_origin.dot(frame.y), from_origin.dot(frame.z));
    }
    return revolved(frame, local, angles);
}

/// Exact form, if the surface has one that its own parameters reach.
std::optional<Sheet> exact_sheet(const Handle(Geom_Surface) & surface, const ParameterBox& range) {
    if (const auto elementary = Handle(Geom_ElementarySurface)::DownCast(surface)) {
        const Frame frame(elementary->Position());
        const ParameterInterval& v = range.v;
        if (surface->IsKind(STANDARD_TYPE(Geom_Plane)))
            return extruded(segment(range.u, frame.point({range.u.low, 0, 0}), frame.point({range.u.high, 0, 0})),
                            frame.y, v);
        if (const auto cylinder = Handle(Geom_CylindricalSurface)::DownCast(surface)) {
            const double r = cylinder->Radius();
            return revolved(frame, segment(v, {r, 0, v.low}, {r, 0, v.high}), range.u);
        }
        if (const auto cone = Handle(Geom_ConicalSurface)::DownCast(surface)) {
            const double r = cone->RefRadius(), c = std::cos(cone->SemiAngle()), s = std::sin(cone->SemiAngle());
            return revolved(frame, segment(v, {r + v.low * s, 0, v.low * c}, {r + v.high * s, 0, v.high * c}), range.u);
        }
        if (const auto sphere = Handle(Geom_SphericalSurface)::DownCast(surface))
            return revolved(frame, meridian_arc(v, 0.0, sphere->Radius()), range.u);
        if (const auto torus = Handle(Geom_ToroidalSurface)::DownCast(surface))
            return revolved(frame, meridian_arc(v, torus->MajorRadius(), torus->MinorRadius()), range.u);
        return std::nullopt;
    }
    if (const auto revolution = Handle(Geom_SurfaceOfRevolution)::DownCast(surface)) {
        const auto meridian = profile_curve(revolution->BasisCurve(), range.v);
        if (meridian) return from_revolution(*revolution, *meridian, range.u);
    }
    if (const auto extrusion = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface)) {
        const auto profile = profile_curve(extrusion->BasisCurve(), range.u);
        if (profile) return extruded(*profile, to_vector(extrusion->Direction()), range.v);
    }
    if (const auto bspline = Handle(Geom_BSplineSurface)::DownCast(surface)) return from_bspline(bspline, range);
    if (Handle(Geom_BezierSurface)::DownCast(surface))
        return from_bspline(GeomConvert::SurfaceToBSplineSurface(surface), range);
    if (const auto offset = Handle(Geom_OffsetSurface)::DownCast(surface)) {
        // The kernel knows the offsets of elementary surfaces and of zero distance.
        const Handle(Geom_Surface) equivalent = offset->Surface();
        if (!equivalent.IsNull() && equivalent != surface) return exact_sheet(equivalent, range);
    }
    return std::nullopt;
}

double diagonal_over(const Geom_Surface& surface, const ParameterBox& range) {
    BoundingBox box;
    for (int i = 0; i <= 4; ++i)
        for (int j = 0; j <= 4; ++j)
            box.add(to_vector(
                surface.Value(range.u.low + range.u.length() * i / 4, range.v.low + range.v.length() * j / 4)));
    return box.diagonal();
}

Sheet approximated_sheet(const Handle(Geom_Surface) & surface, const ParameterBox& range) {
    const Handle(Geom_Surface) piece =
        new Geom_RectangularTrimmedSurface(surface, range.u.low, range.u.high, range.v.low, range.v.high);
    const double tolerance = approximation_tolerance * diagonal_over(*surface, range);
    if (!(tolerance > 0.0) || !std::isfinite(tolerance)) throw InvalidInput("its surface has no finite extent");
    const GeomConvert_ApproxSurface approximation(piece, tolerance, GeomAbs_C2, GeomAbs_C2, approximation_degree,
                                                  approximation_degree, approximation_segments, 1);
    if (!approximation.HasResult()) throw Unsupported("its surface could not be approximated by a NURBS surface");
    return from_bspline(approximation.Surface(), range);
}

/// Largest distance at equal native parameters, and the scale of rounding errors, over `range`.
std::pair<double, double> deviation(const Sheet& sheet, const Geom_Surface& surface, const ParameterBox& range,
                                    int points) {
    double largest = 0.0, extent = 0.0;
    for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j) {
            const double u = range.u.low + range.u.length() * i / (points - 1);
            const double v = range.v.low + range.v.length() * j / (points - 1);
            const Vector3 expected = to_vector(surface.Value(u, v));
            const Vector3 found = sheet.surface.value(sheet.u_map.surface(u), sheet.v_map.surface(v));
            largest = std::max(largest, (found - expected).norm());
            extent = std::max(extent, expected.cwiseAbs().maxCoeff());
        }
    return {largest, extent};
}

NurbsSurface placed(const NurbsSurface& surface, const gp_Trsf& placement) {
    if (placement.Form() == gp_Identity) return surface;
    std::vector<Vector3> poles;
    for (const Vector3& pole : surface.poles()) poles.push_back(to_vector(to_point(pole).Transformed(placement)));
    return NurbsSurface(surface.u_knots(), surface.v_knots(), std::move(poles), surface.weights());
}

std::optional<ElementarySurface> elementary_parameters(const Handle(Geom_Surface) & surface, const gp_Trsf& placement) {
    const auto elementary = Handle(Geom_ElementarySurface)::DownCast(surface);
    if (elementary.IsNull()) return std::nullopt;
    const double scale = std::abs(placement.ScaleFactor());
    const auto moved = [&](const gp_Dir& direction) {
        return to_vector(gp_Vec(direction).Transformed(placement)).normalized().eval();
    };
    const gp_Ax3& axes = elementary->Position();
    ElementarySurface result;
    result.location = to_vector(axes.Location().Transformed(placement));
    result.axis = moved(axes.Direction());
    result.x_axis = moved(axes.XDirection());
    if (const auto cylinder = Handle(Geom_CylindricalSurface)::DownCast(surface))
        result.radius = scale * cylinder->Radius();
    if (const auto cone = Handle(Geom_ConicalSurface)::DownCast(surface)) {
        result.radius = scale * cone->RefRadius();
        result.semi_angle = cone->SemiAngle();
    }
    if (const auto sphere = Handle(Geom_SphericalSurface)::DownCast(surface)) result.radius = scale * sphere->Radius();
    if (const auto torus = Handle(Geom_ToroidalSurface)::DownCast(surface)) {
        result.radius = scale * torus->MajorRadius();
        result.minor_radius = scale * torus->MinorRadius();
    }
    return result;
}

Handle(Geom_Surface) without_rectangle(Handle(Geom_Surface) surface) {
    while (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface))
        surface = trimmed->BasisSurface();
    return surface;
}

}  // namespace

SurfaceKind surface_kind(const Handle(Geom_Surface) & surface) {
    const Handle(Geom_Surface) basis = without_rectangle(surface);
    const auto is = [&](const Handle(Standard_Type) & type) { return basis->IsKind(type); };
    if (is(STANDARD_TYPE(Geom_Plane))) return SurfaceKind::plane;
    if (is(STANDARD_TYPE(Geom_CylindricalSurface))) return SurfaceKind::cylinder;
    if (is(STANDARD_TYPE(Geom_ConicalSurface))) return SurfaceKind::cone;
    if (is(STANDARD_TYPE(Geom_SphericalSurface))) return SurfaceKind::sphere;
    if (is(STANDARD_TYPE(Geom_ToroidalSurface))) return SurfaceKind::torus;
    if (is(STANDARD_TYPE(Geom_BezierSurface))) return SurfaceKind::bezier;
    if (is(STANDARD_TYPE(Geom_BSplineSurface))) return SurfaceKind::bspline;
    if (is(STANDARD_TYPE(Geom_SurfaceOfRevolution))) return SurfaceKind::revolution;
    if (is(STANDARD_TYPE(Geom_SurfaceOfLinearExtrusion))) return SurfaceKind::extrusion;
    if (is(STANDARD_TYPE(Geom_OffsetSurface))) return SurfaceKind::offset;
    return SurfaceKind::other;
}

ConvertedSurface convert_surface(const Handle(Geom_Surface) & surface, const ParameterBox& range,
                                 const gp_Trsf& placement) {
    const Handle(Geom_Surface) basis = without_rectangle(surface);
    std::optional<Sheet> exact = exact_sheet(basis, range);
    const bool is_exact = exact.has_value();
    const Sheet sheet = is_exact ? std::move(*exact) : approximated_sheet(basis, range);

    const ParameterBox natural = sheet.surface.domain();
    const ParameterBox common{{std::max(range.u.low, natural.u.low), std::min(range.u.high, natural.u.high)},
                              {std::max(range.v.low, natural.v.low), std::min(range.v.high, natural.v.high)}};
    const auto [largest, extent] =
        deviation(sheet, *basis, common, is_exact ? exact_check_points : approximation_check_points);
    if (!std::isfinite(largest)) throw InvalidInput("its surface has points that are not finite");

    ConvertedSurface result{surface_kind(surface), elementary_parameters(basis, placement),
                            placed(sheet.surface, placement), sheet.u_map, sheet.v_map};
    if (!is_exact || largest > rounding_tolerance * extent) result.error = largest * std::abs(placement.ScaleFactor());
    result.u_closed = basis->IsUClosed();
    result.v_closed = basis->IsVClosed();
    result.u_periodic = basis->IsUPeriodic();
    result.v_periodic = basis->IsVPeriodic();
    return result;
}

}  // namespace umbilic
