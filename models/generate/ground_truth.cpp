// SPDX-License-Identifier: LGPL-2.1-or-later
#include "ground_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <GProp_PrincipalProps.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom2d_Curve.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <math.hxx>
#include <math_Vector.hxx>

#include "exchange.h"
#include "umbilic_scan.h"

namespace umbilic::models {
namespace {

using Json = nlohmann::ordered_json;

// Relative. BRepGProp's default integration over faces bounded by rational arcs is off by 0.2 %.
constexpr double kIntegration = 1e-9;
constexpr double kOnBound = 1e-9;  // of the parameter range

double area_by_opencascade(const TopoDS_Shape& shape) {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(shape, properties, kIntegration);
    return properties.Mass();
}

// True if every edge runs along a border of the face's parameter rectangle.
bool fills_its_rectangle(const TopoDS_Face& face, double u0, double u1, double v0, double v1) {
    for (TopExp_Explorer it{face, TopAbs_EDGE}; it.More(); it.Next()) {
        double first, last;
        const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(it.Current()), face, first, last);
        if (curve.IsNull()) return false;
        double from_u0 = 0, from_u1 = 0, from_v0 = 0, from_v1 = 0;
        for (double t : {first, (first + last) / 2, last}) {
            const gp_Pnt2d p = curve->Value(t);
            from_u0 = std::max(from_u0, std::abs(p.X() - u0)), from_u1 = std::max(from_u1, std::abs(p.X() - u1));
            from_v0 = std::max(from_v0, std::abs(p.Y() - v0)), from_v1 = std::max(from_v1, std::abs(p.Y() - v1));
        }
        if (std::min(from_u0, from_u1) > kOnBound * (u1 - u0) && std::min(from_v0, from_v1) > kOnBound * (v1 - v0))
            return false;
    }
    return true;
}

// Area of the surface over the rectangle: Gauss-Legendre on 8 x 8 cells of every knot span.
double rectangle_area(const Surface& surface, double u0, double u1, double v0, double v1) {
    constexpr int order = 10, cells = 8;
    math_Vector points{1, order}, weights{1, order};
    math::GaussPoints(order, points);
    math::GaussWeights(order, weights);
    const auto nodes = [&](const std::vector<double>& breaks) {
        std::vector<std::pair<double, double>> result;
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            const double half = (breaks[i + 1] - breaks[i]) / 2;
            for (int k = 1; k <= order; ++k) result.push_back({breaks[i] + half * (1 + points(k)), half * weights(k)});
        }
        return result;
    };
    double sum = 0;
    for (const auto& [u, weight_u] : nodes(sample_parameters(surface, true, u0, u1, cells)))
        for (const auto& [v, weight_v] : nodes(sample_parameters(surface, false, v0, v1, cells))) {
            gp_Pnt p;
            gp_Vec ru, rv;
            surface->D1(u, v, p, ru, rv);
            sum += weight_u * weight_v * ru.Crossed(rv).Magnitude();
        }
    return sum;
}

Json array(const gp_XYZ& p) {
    return {p.X(), p.Y(), p.Z()};
}

Json complex(std::complex<double> z) {
    return {z.real(), z.imag()};
}

// The representative of omega with argument in [-pi/3, pi/3); null where alpha vanishes beside beta.
Json omega(const Umbilic& umbilic) {
    const double alpha = std::abs(umbilic.alpha);
    if (alpha == 0) return nullptr;
    const std::complex<double> cube = std::pow(umbilic.beta, 3) * umbilic.alpha / std::pow(alpha, 4);
    return complex(std::polar(std::cbrt(std::abs(cube)), std::arg(cube) / 3));
}

Json to_json(const Umbilic& umbilic, bool inside) {
    const double alpha = std::norm(umbilic.alpha), beta = std::norm(umbilic.beta);
    const double sum = alpha + beta;
    const auto finite = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
    return {{"u", umbilic.u},
            {"v", umbilic.v},
            {"point", array(umbilic.point.XYZ())},
            {"normal", array(umbilic.normal.XYZ())},
            {"kappa", umbilic.kappa},
            {"cubic", umbilic.cubic},
            {"omega", omega(umbilic)},
            {"delta", (alpha - beta) / sum},
            {"zeta", complex(umbilic.alpha * std::pow(umbilic.beta, 3) / (sum * sum))},
            {"type", umbilic.type},
            {"star", umbilic.star.empty() ? Json(nullptr) : Json(umbilic.star)},
            {"index", umbilic.index},
            {"inside", inside},
            {"type_margin", finite(umbilic.type_margin)},
            {"knot_margin", umbilic.knot_margin}};
}

std::string kind_name(GeomAbs_SurfaceType type) {
    switch (type) {
        case GeomAbs_Plane:
            return "plane";
        case GeomAbs_Cylinder:
            return "cylinder";
        case GeomAbs_Cone:
            return "cone";
        case GeomAbs_Sphere:
            return "sphere";
        case GeomAbs_Torus:
            return "torus";
        case GeomAbs_BezierSurface:
            return "bezier";
        case GeomAbs_BSplineSurface:
            return "bspline";
        case GeomAbs_SurfaceOfRevolution:
            return "revolution";
        case GeomAbs_SurfaceOfExtrusion:
            return "extrusion";
        default:
            return "other";
    }
}

Json measure_face(const TopoDS_Face& face, double size) {
    const Surface surface = BRep_Tool::Surface(face);
    const GeomAdaptor_Surface adaptor{surface};
    Json result = {{"surface", kind_name(adaptor.GetType())}};
    const bool spline = adaptor.GetType() == GeomAbs_BSplineSurface || adaptor.GetType() == GeomAbs_BezierSurface;
    if (spline) {
        result["degree"] = {adaptor.UDegree(), adaptor.VDegree()};
        result["poles"] = {adaptor.NbUPoles(), adaptor.NbVPoles()};
        result["rational"] = adaptor.IsURational() || adaptor.IsVRational();
    }
    result["orientation"] = face.Orientation() == TopAbs_REVERSED ? "reversed" : "forward";
    double u0, u1, v0, v1;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    const bool trimmed = spline && !fills_its_rectangle(face, u0, u1, v0, v1);
    result["area"] = spline && !trimmed ? rectangle_area(surface, u0, u1, v0, v1) : area_by_opencascade(face);
    if (!spline) return result;
    result["trimmed"] = trimmed;
    result["bounds"] = {{u0, u1}, {v0, v1}};
    result["all_umbilic"] = all_umbilic(surface, u0, u1, v0, v1, size);
    result["umbilics"] = Json::array();
    if (result["all_umbilic"]) return result;
    const BRepTopAdaptor_FClass2d trimming{face, Precision::PConfusion()};
    for (const Umbilic& umbilic : scan_umbilics(surface, u0, u1, v0, v1)) {
        const bool inside = trimming.Perform(gp_Pnt2d{umbilic.u, umbilic.v}) == TopAbs_IN;
        result["umbilics"].push_back(to_json(umbilic, inside));
    }
    return result;
}

// Of the volume at density 1, about the centre of mass: mm, mm^5 in increasing order.
Json inertia(const GProp_GProps& properties) {
    std::array<double, 3> moments;
    properties.PrincipalProperties().Moments(moments[0], moments[1], moments[2]);
    std::sort(moments.begin(), moments.end());
    return {{"centre", array(properties.CentreOfMass().XYZ())}, {"principal_moments", moments}};
}

bool has_spline(const TopTools_IndexedMapOfShape& faces) {
    for (int i = 1; i <= faces.Extent(); ++i) {
        const GeomAdaptor_Surface surface{BRep_Tool::Surface(TopoDS::Face(faces(i)))};
        if (surface.GetType() == GeomAbs_BSplineSurface || surface.GetType() == GeomAbs_BezierSurface) return true;
    }
    return false;
}

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
    TopTools_IndexedMapOfShape map;
    TopExp::MapShapes(shape, kind, map);
    return map.Extent();
}

Json check(const Pair& pair, const Json& original, const Json& suspect) {
    const gp_Trsf transform = to_trsf(pair.original_suspect);
    const auto inside = [](const Json& model) {
        std::vector<gp_Pnt> points;
        for (const Json& face : model["face_list"]) {
            if (!face.contains("umbilics")) continue;
            for (const Json& umbilic : face["umbilics"])
                if (umbilic["inside"])
                    points.push_back({umbilic["point"][0], umbilic["point"][1], umbilic["point"][2]});
        }
        return points;
    };
    const std::vector<gp_Pnt> targets = inside(original);
    Json distances = Json::array();
    for (const gp_Pnt& point : inside(suspect)) {
        double least = std::numeric_limits<double>::infinity();
        for (const gp_Pnt& target : targets) least = std::min(least, point.Transformed(transform).Distance(target));
        distances.push_back(targets.empty() ? Json(nullptr) : Json(least));
    }
    const double scale = pair.original_suspect.scale;
    return {{"area_ratio", scale * scale * suspect["area"].get<double>() / original["area"].get<double>()},
            {"umbilic_distances", distances}};
}

}  // namespace

Json measure(const Model& model, const std::filesystem::path& file) {
    const TopoDS_Shape shape = read_cad(file);
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    Bnd_Box box;
    BRepBndLib::AddOptimal(shape, box, false, false);
    const double size = std::sqrt(box.SquareExtent());
    GProp_GProps volume;
    const int solids = count(shape, TopAbs_SOLID);
    // The default integration is exact for analytic faces, the adaptive one is better for splines.
    if (solids > 0 && has_spline(faces))
        BRepGProp::VolumeProperties(shape, volume, kIntegration);
    else if (solids > 0)
        BRepGProp::VolumeProperties(shape, volume);

    Json result = {{"file", model.file},
                   {"description", model.description},
                   {"format", file.extension() == ".step" ? "STEP" : "IGES"},
                   {"unit", "mm"},
                   {"solids", solids},
                   {"faces", faces.Extent()},
                   {"area", 0.0},
                   {"volume", solids > 0 ? Json(volume.Mass()) : Json(nullptr)},
                   {"inertia", solids > 0 ? inertia(volume) : Json(nullptr)},
                   {"box", {array(box.CornerMin().XYZ()), array(box.CornerMax().XYZ())}},
                   {"exact", model.exact}};
    Json list = Json::array();
    double area = 0;
    for (int i = 1; i <= faces.Extent(); ++i) {
        Json face = {{"face", i}};
        face.update(measure_face(TopoDS::Face(faces(i)), size));
        area += face["area"].get<double>();
        list.push_back(face);
    }
    result["area"] = area;
    result["face_list"] = list;
    return result;
}

Json describe(const Pair& pair, const Json& original, const Json& suspect) {
    Json result = {{"original", pair.original}, {"suspect", pair.suspect}};
    if (pair.related) {
        const auto& r = pair.original_suspect.rotation;
        result["transform"] = {{"mirrored", pair.original_suspect.mirrored},
                               {"scale", pair.original_suspect.scale},
                               {"rotation", {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}}},
                               {"translation", pair.original_suspect.translation}};
        result["check"] = check(pair, original, suspect);
    } else {
        result["transform"] = nullptr;
        result["check"] = nullptr;
    }
    result["answer"] = pair.answer;
    result["level"] = pair.level;
    result["facts"] = pair.facts;
    result["note"] = pair.note;
    return result;
}

}  // namespace umbilic::models
