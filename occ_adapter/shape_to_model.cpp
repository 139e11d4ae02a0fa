// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shape_to_model.h"

#include <cmath>
#include <utility>

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Mat.hxx>

#include <umbilic/core/errors.h>
#include <umbilic/nurbs/area.h>

#include "face_loops.h"
#include "occ_types.h"
#include "surface_conversion.h"
#include "trimmed_box.h"

namespace umbilic {

namespace {

/// The kernel's own word for an infinite coordinate or parameter is 2e100 (Precision::Infinite()); coordinates (mm)
/// beyond a hundred times the distance of the Moon are taken as such, too.
constexpr double largest_coordinate = 4e13;

/// Relative error asked of the kernel's adaptive integration of the areas of trimmed faces and of volumes. Its plain
/// one, without a bound, can be off by several percent on real B-spline faces; this one was seen off by 2e-4 on a
/// strongly curved patch.
constexpr double integration_accuracy = 1e-6;

/// A face of a smaller area (mm^2) is a point or a line; the kernel's own smallest length, squared.
const double smallest_area = Precision::SquareConfusion();

void check_area(double area) {
    if (!std::isfinite(area)) throw InvalidInput("its area is not finite");
    if (std::abs(area) <= smallest_area) throw InvalidInput("it is collapsed: its area is zero");
    if (area < 0.0) throw InvalidInput("its area is negative: its boundary runs the wrong way around");
}

std::string message_of(const Standard_Failure& failure) {
    const char* text = failure.GetMessageString();
    return std::string("OpenCASCADE: ") + failure.DynamicType()->Name() +
           (text && *text ? std::string(" ") + text : "");
}

struct LoopsAndRegion {
    FaceLoops loops;
    ConvertedSurface surface;
    TrimmingRegion region;
};

LoopsAndRegion convert(FaceLoops loops, const TopoDS_Face& face) {
    TopLoc_Location location;
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, location);
    for (const ParameterInterval& range : {loops.range.u, loops.range.v})
        if (!(std::max(std::abs(range.low), std::abs(range.high)) < largest_coordinate))
            throw InvalidInput("it has no boundary and its surface is infinite");
    for (const ParameterInterval& range : {loops.range.u, loops.range.v})
        if (!(range.length() > 0.0)) throw InvalidInput("its boundary encloses nothing in the parameter plane");
    ConvertedSurface converted = convert_surface(surface, loops.range, location.Transformation());
    TrimmingRegion region(converted.surface.domain(), loops.loops, converted.u_map, converted.v_map);
    return {std::move(loops), std::move(converted), std::move(region)};
}

/// Loops of all faces together; they lie on one surface.
FaceLoops joined_loops(const std::vector<TopoDS_Face>& faces, const TopTools_IndexedMapOfShape& edges) {
    FaceLoops result = face_loops(faces.front(), edges);
    for (std::size_t i = 1; i < faces.size(); ++i) {
        FaceLoops more = face_loops(faces[i], edges);
        std::move(more.loops.begin(), more.loops.end(), std::back_inserter(result.loops));
        result.tolerance = std::max(result.tolerance, more.tolerance);
        result.range.u = {std::min(result.range.u.low, more.range.u.low),
                          std::max(result.range.u.high, more.range.u.high)};
        result.range.v = {std::min(result.range.v.low, more.range.v.low),
                          std::max(result.range.v.high, more.range.v.high)};
    }
    return result;
}

LoopsAndRegion convert_or_heal(const TopoDS_Face& face, int number, const TopTools_IndexedMapOfShape& edges,
                               std::vector<std::string>& repaired) {
    try {
        return convert(face_loops(face, edges), face);
    } catch (const InvalidInput& problem) {
        const std::vector<TopoDS_Face> healed = healed_faces(face);
        if (healed.empty()) throw;
        LoopsAndRegion result = convert(joined_loops(healed, edges), face);
        repaired.push_back("face " + std::to_string(number) + ": boundary healed (" + problem.what() + ")");
        return result;
    }
}

Face to_face(const TopoDS_Face& face, int number, const TopTools_IndexedMapOfShape& edges,
             std::vector<std::string>& repaired) {
    LoopsAndRegion parts = convert_or_heal(face, number, edges, repaired);
    Face result{number, parts.surface.kind, parts.surface.elementary, std::move(parts.surface.surface),
                std::move(parts.region)};
    result.u_closed = parts.surface.u_closed;
    result.v_closed = parts.surface.v_closed;
    result.u_periodic = parts.surface.u_periodic;
    result.v_periodic = parts.surface.v_periodic;
    result.conversion_error = parts.surface.error;
    result.tolerance = parts.loops.tolerance;
    return result;
}

double area_of(const TopoDS_Shape& face) {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties, integration_accuracy);
    return properties.Mass();
}

Solid to_solid(const TopoDS_Shape& shape) {
    GProp_GProps volume;
    BRepGProp::VolumeProperties(shape, volume, integration_accuracy);
    Solid result;
    result.volume = volume.Mass();
    result.centroid = to_vector(volume.CentreOfMass());
    const gp_Mat inertia = volume.MatrixOfInertia();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result.inertia(i, j) = inertia(i + 1, j + 1);
    return result;
}

/// What the topology says about each face, by its number.
struct FacePlaces {
    std::vector<double> area;
    std::vector<int> solid;      ///< index into Model::solids, or -1
    std::vector<bool> reversed;  ///< as Face::reversed
};

FacePlaces measure(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces, Model& model,
                   const Progress& progress) {
    FacePlaces places;
    places.area.assign(faces.Extent() + 1, 0.0);
    places.solid.assign(faces.Extent() + 1, -1);
    places.reversed.assign(faces.Extent() + 1, false);
    for (int i = 1; i <= faces.Extent(); ++i) {
        progress.report(0.5 * i / faces.Extent(), "measuring faces");
        places.area[i] = area_of(faces(i));
        places.reversed[i] = faces(i).Orientation() == TopAbs_REVERSED;
    }
    TopTools_IndexedMapOfShape solids;
    TopExp::MapShapes(shape, TopAbs_SOLID, solids);
    for (int i = 1; i <= solids.Extent(); ++i) {
        progress.report(0.5 + 0.5 * (i - 1) / solids.Extent(), "measuring solids");
        Solid solid = to_solid(solids(i));
        const bool inside_out = solid.volume < 0.0;
        if (inside_out) {
            solid.volume = -solid.volume;
            solid.inertia = -solid.inertia;
            model.repaired.push_back("solid " + std::to_string(i) +
                                     " was inside out: the sides of its faces are exchanged");
        }
        if (!std::isfinite(solid.volume) || !solid.inertia.allFinite() || !solid.centroid.allFinite()) {
            model.warnings.push_back("solid " + std::to_string(i) + " has no finite volume; its volume is given as 0");
            solid = Solid();
        }
        for (TopExp_Explorer explorer(solids(i), TopAbs_FACE); explorer.More(); explorer.Next()) {
            const int number = faces.FindIndex(explorer.Current());
            if (places.solid[number] >= 0) continue;
            places.solid[number] = i - 1;
            places.reversed[number] = (explorer.Current().Orientation() == TopAbs_REVERSED) != inside_out;
        }
        model.volume += solid.volume;
        model.solids.push_back(std::move(solid));
    }
    return places;
}

}  // namespace

Model shape_to_model(const TopoDS_Shape& shape, const Progress& progress) {
    if (shape.IsNull()) throw InvalidInput("it holds no shape");
    TopTools_IndexedMapOfShape faces, edges, shells;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    TopExp::MapShapes(shape, TopAbs_EDGE, edges);
    TopExp::MapShapes(shape, TopAbs_SHELL, shells);
    if (faces.Extent() == 0) throw InvalidInput("it holds no face");

    Model model;
    model.shells = shells.Extent();
    const FacePlaces places = measure(shape, faces, model, progress.part(0.0, 0.5));

    for (int i = 1; i <= faces.Extent(); ++i) {
        progress.report(0.5 + 0.4 * (i - 1) / faces.Extent(), "converting faces");
        try {
            check_area(places.area[i]);
            Face face = to_face(TopoDS::Face(faces(i)), i, edges, model.repaired);
            face.area = face.region.whole_domain() ? surface_area(face.surface) : places.area[i];
            face.solid = places.solid[i];
            if (face.solid >= 0) model.solids[face.solid].area += face.area;
            face.reversed = places.reversed[i];
            extend_box(face.surface, face.region, model.box);
            model.area += face.area;
            model.faces.push_back(std::move(face));
        } catch (const Cancelled&) {
            throw;
        } catch (const Error& error) {
            model.skipped.push_back({i, "", error.what()});
        } catch (const Standard_Failure& failure) {
            model.skipped.push_back({i, "", message_of(failure)});
        }
    }
    if (model.faces.empty())
        throw InvalidInput("none of its " + std::to_string(faces.Extent()) +
                           " faces can be used; face 1: " + model.skipped.front().why);

    if (model.box.empty() || !(model.box.low.cwiseAbs().maxCoeff() < largest_coordinate) ||
        !(model.box.high.cwiseAbs().maxCoeff() < largest_coordinate))
        throw InvalidInput("its shape is empty or infinite");
    progress.report(0.9, "checking topology");
    model.valid = BRepCheck_Analyzer(shape).IsValid();
    progress.report(1.0, "checking topology");
    return model;
}

}  // namespace umbilic
