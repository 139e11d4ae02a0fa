// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shape_to_model.h"

#include <cmath>
#include <utility>

#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <GProp_PrincipalProps.hxx>
#include <Geom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Mat.hxx>

#include <umbilic/core/errors.h>

#include "face_loops.h"
#include "occ_types.h"
#include "surface_conversion.h"

namespace umbilic {

namespace {

/// The kernel's own word for an infinite coordinate or parameter is 2e100 (Precision::Infinite()); coordinates (mm)
/// beyond a hundred times the distance of the Moon are taken as such, too.
constexpr double largest_coordinate = 4e13;

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
    result.reversed = face.Orientation() == TopAbs_REVERSED;
    result.u_closed = parts.surface.u_closed;
    result.v_closed = parts.surface.v_closed;
    result.u_periodic = parts.surface.u_periodic;
    result.v_periodic = parts.surface.v_periodic;
    result.conversion_error = parts.surface.error;
    result.tolerance = parts.loops.tolerance;
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties);
    result.area = properties.Mass();
    if (!std::isfinite(result.area)) throw InvalidInput("its area is not finite");
    return result;
}

Solid to_solid(const TopoDS_Shape& shape) {
    GProp_GProps volume, surface;
    BRepGProp::VolumeProperties(shape, volume);
    BRepGProp::SurfaceProperties(shape, surface);
    Solid result;
    result.volume = volume.Mass();
    result.area = surface.Mass();
    result.centroid = to_vector(volume.CentreOfMass());
    const gp_Mat inertia = volume.MatrixOfInertia();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result.inertia(i, j) = inertia(i + 1, j + 1);
    return result;
}

BoundingBox box_of(const TopoDS_Shape& shape) {
    Bnd_Box box;
    BRepBndLib::AddOptimal(shape, box, false, false);
    BoundingBox result;
    if (box.IsVoid()) return result;
    double x0, y0, z0, x1, y1, z1;
    box.Get(x0, y0, z0, x1, y1, z1);
    result.low = Vector3(x0, y0, z0);
    result.high = Vector3(x1, y1, z1);
    return result;
}

void add_solids(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces, Model& model,
                std::vector<int>& solid_of_face, std::vector<bool>& reversed) {
    TopTools_IndexedMapOfShape solids;
    TopExp::MapShapes(shape, TopAbs_SOLID, solids);
    for (int i = 1; i <= solids.Extent(); ++i) {
        Solid solid = to_solid(solids(i));
        if (!std::isfinite(solid.volume) || !solid.inertia.allFinite() || !solid.centroid.allFinite()) {
            model.warnings.push_back("solid " + std::to_string(i) + " has no finite volume and is left out");
            continue;
        }
        const bool inside_out = solid.volume < 0.0;
        if (inside_out) {
            solid.volume = -solid.volume;
            solid.inertia = -solid.inertia;
            model.repaired.push_back("solid " + std::to_string(i) +
                                     " was inside out: the sides of its faces exchanged");
        }
        for (TopExp_Explorer explorer(solids(i), TopAbs_FACE); explorer.More(); explorer.Next()) {
            const int number = faces.FindIndex(explorer.Current());
            if (solid_of_face[number] >= 0) continue;
            solid_of_face[number] = static_cast<int>(model.solids.size());
            reversed[number] = (explorer.Current().Orientation() == TopAbs_REVERSED) != inside_out;
        }
        model.volume += solid.volume;
        model.solids.push_back(std::move(solid));
    }
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
    std::vector<int> solid_of_face(faces.Extent() + 1, -1);
    std::vector<bool> reversed(faces.Extent() + 1, false);
    for (int i = 1; i <= faces.Extent(); ++i) reversed[i] = faces(i).Orientation() == TopAbs_REVERSED;
    progress.report(0.0, "measuring solids");
    add_solids(shape, faces, model, solid_of_face, reversed);

    for (int i = 1; i <= faces.Extent(); ++i) {
        progress.report(0.2 + 0.5 * (i - 1) / faces.Extent(), "converting faces");
        try {
            Face face = to_face(TopoDS::Face(faces(i)), i, edges, model.repaired);
            face.solid = solid_of_face[i];
            face.reversed = reversed[i];
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

    for (const Face& face : model.faces) {
        progress.report(0.7 + 0.15 * face.number / faces.Extent(), "bounding faces");
        model.box.add(box_of(faces(face.number)));
    }
    if (model.box.empty() || !(model.box.low.cwiseAbs().maxCoeff() < largest_coordinate) ||
        !(model.box.high.cwiseAbs().maxCoeff() < largest_coordinate))
        throw InvalidInput("its shape is empty or infinite");
    progress.report(0.85, "checking topology");
    model.valid = BRepCheck_Analyzer(shape).IsValid();
    progress.report(1.0, "checking topology");
    return model;
}

}  // namespace umbilic
