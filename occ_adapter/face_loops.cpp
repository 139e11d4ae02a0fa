// SPDX-License-Identifier: LGPL-2.1-or-later
#include "face_loops.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <BndLib_Add2dCurve.hxx>
#include <Bnd_Box2d.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_Surface.hxx>
#include <ShapeFix_Face.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>

#include <umbilic/core/errors.h>

#include "occ_types.h"

namespace umbilic {

namespace {

/// Widening asked of the kernel when it bounds a parameter curve: none.
constexpr double no_widening = 0.0;

NurbsCurve2 to_nurbs(const Handle(Geom2d_Curve) & curve, double first, double last) {
    Handle(Geom2d_Curve) basis = curve;
    while (const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(basis)) basis = trimmed->BasisCurve();
    if (basis->IsKind(STANDARD_TYPE(Geom2d_Line)))
        return NurbsCurve2(KnotVector(1, {first, first, last, last}),
                           {to_vector(basis->Value(first)), to_vector(basis->Value(last))});
    const Handle(Geom2d_BSplineCurve) spline =
        Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(basis, first, last));
    if (spline->IsPeriodic()) spline->SetNotPeriodic();
    std::vector<double> knots, weights;
    for (int i = 1; i <= spline->NbKnots(); ++i) knots.insert(knots.end(), spline->Multiplicity(i), spline->Knot(i));
    std::vector<Vector2> poles;
    for (int i = 1; i <= spline->NbPoles(); ++i) {
        poles.push_back(to_vector(spline->Pole(i)));
        if (spline->IsRational()) weights.push_back(spline->Weight(i));
    }
    return NurbsCurve2(KnotVector(spline->Degree(), std::move(knots)), std::move(poles), std::move(weights));
}

bool is_boundary(const TopoDS_Shape& edge) {
    return edge.Orientation() == TopAbs_FORWARD || edge.Orientation() == TopAbs_REVERSED;
}

/// Edges of a wire in the order in which they follow each other; in the order of the file if they cannot be followed
/// by their vertices.
std::vector<TopoDS_Edge> ordered_edges(const TopoDS_Wire& wire, const TopoDS_Face& face) {
    std::vector<TopoDS_Edge> stored, followed;
    for (TopoDS_Iterator it(wire); it.More(); it.Next())
        if (is_boundary(it.Value())) stored.push_back(TopoDS::Edge(it.Value()));
    for (BRepTools_WireExplorer explorer(wire, face); explorer.More(); explorer.Next())
        if (is_boundary(explorer.Current())) followed.push_back(explorer.Current());
    return followed.size() == stored.size() ? followed : stored;
}

void add(ParameterBox& box, const Bnd_Box2d& other) {
    double u0, v0, u1, v1;
    other.Get(u0, v0, u1, v1);
    box.u = {std::min(box.u.low, u0), std::max(box.u.high, u1)};
    box.v = {std::min(box.v.low, v0), std::max(box.v.high, v1)};
}

}  // namespace

FaceLoops face_loops(const TopoDS_Face& oriented_face, const TopTools_IndexedMapOfShape& edges) {
    const TopoDS_Face face = TopoDS::Face(oriented_face.Oriented(TopAbs_FORWARD));
    FaceLoops result;
    result.tolerance = BRep_Tool::Tolerance(face);
    const double infinity = std::numeric_limits<double>::infinity();
    result.range = {{infinity, -infinity}, {infinity, -infinity}};
    for (TopoDS_Iterator it(face); it.More(); it.Next()) {
        if (it.Value().ShapeType() != TopAbs_WIRE) continue;
        const TopoDS_Wire wire = TopoDS::Wire(it.Value());
        TrimmingLoop loop;
        for (const TopoDS_Edge& edge : ordered_edges(wire, face)) {
            double first = 0.0, last = 0.0;
            const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
            if (curve.IsNull()) throw InvalidInput("an edge has no curve in the parameters of the face");
            if (!(first < last)) throw InvalidInput("an edge has an empty parameter range");
            TrimmingCurve trimming{to_nurbs(curve, first, last)};
            trimming.reversed = edge.Orientation() == TopAbs_REVERSED;
            trimming.edge = edges.FindIndex(edge);
            trimming.degenerate = BRep_Tool::Degenerated(edge);
            trimming.tolerance = BRep_Tool::Tolerance(edge);
            result.tolerance = std::max(result.tolerance, trimming.tolerance);
            for (TopoDS_Iterator vertex(edge); vertex.More(); vertex.Next())
                if (vertex.Value().ShapeType() == TopAbs_VERTEX)
                    result.tolerance = std::max(result.tolerance, BRep_Tool::Tolerance(TopoDS::Vertex(vertex.Value())));
            Bnd_Box2d box;
            BndLib_Add2dCurve::AddOptimal(curve, first, last, no_widening, box);
            add(result.range, box);
            loop.push_back(std::move(trimming));
        }
        if (!loop.empty()) result.loops.push_back(std::move(loop));
    }
    if (result.loops.empty()) {
        ParameterBox& range = result.range;
        BRep_Tool::Surface(face)->Bounds(range.u.low, range.u.high, range.v.low, range.v.high);
    }
    return result;
}

std::vector<TopoDS_Face> healed_faces(const TopoDS_Face& face) {
    const Handle(ShapeFix_Face) fix = new ShapeFix_Face(TopoDS::Face(face.Oriented(TopAbs_FORWARD)));
    std::vector<TopoDS_Face> result;
    if (!fix->Perform()) return result;
    TopLoc_Location before, after;
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, before);
    for (TopExp_Explorer explorer(fix->Result(), TopAbs_FACE); explorer.More(); explorer.Next()) {
        const TopoDS_Face healed = TopoDS::Face(explorer.Current());
        // Loops on another surface would mean other parameters than the file's.
        if (BRep_Tool::Surface(healed, after) != surface) return {};
        result.push_back(healed);
    }
    return result;
}

}  // namespace umbilic
