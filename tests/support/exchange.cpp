// SPDX-License-Identifier: LGPL-2.1-or-later
#include <support/exchange.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <ShapeFix_Face.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <unistd.h>

#include <models/generate/exchange.h>
#include <occ_adapter/occ_types.h>
#include <occ_adapter/read_file.h>
#include <support/reparametrisation.h>
#include <umbilic/core/errors.h>

namespace umbilic::support {

namespace {

/// What OpenCASCADE's writers keep of points, relative to the model's extent and its distance from the origin: STEP
/// knots and weights lose their last digits (largest error seen 5e-13), the IGES writer keeps about ten decimals
/// (2e-10).
constexpr double step_precision = 2e-12, iges_precision = 1e-9;
/// Confusion (mm) of the vertices the kernel makes, its own default.
constexpr double vertex_tolerance = 1e-7;

struct Knots {
    TColStd_Array1OfReal values;
    TColStd_Array1OfInteger multiplicities;

    explicit Knots(const KnotVector& knots)
        : values(1, static_cast<int>(knots.breaks().size())), multiplicities(1, values.Upper()) {
        for (int i = 1; i <= values.Upper(); ++i) {
            values(i) = knots.breaks()[i - 1];
            multiplicities(i) =
                i == 1 || i == values.Upper() ? knots.degree() + 1 : knots.degree() - knots.continuity(i - 1);
        }
    }
};

Handle(Geom_BSplineSurface) to_kernel(const NurbsSurface& unclamped) {
    const NurbsSurface surface = restricted(unclamped, unclamped.domain());
    const Knots u(surface.u_knots()), v(surface.v_knots());
    TColgp_Array2OfPnt poles(1, surface.u_pole_count(), 1, surface.v_pole_count());
    TColStd_Array2OfReal weights(1, poles.ColLength(), 1, poles.RowLength());
    for (int i = 0; i < surface.u_pole_count(); ++i)
        for (int j = 0; j < surface.v_pole_count(); ++j) {
            poles(i + 1, j + 1) = to_point(surface.pole(i, j));
            weights(i + 1, j + 1) = surface.weight(i, j);
        }
    return new Geom_BSplineSurface(poles, weights, u.values, v.values, u.multiplicities, v.multiplicities,
                                   surface.u_degree(), surface.v_degree());
}

Handle(Geom2d_BSplineCurve) to_kernel(const NurbsCurve2& curve) {
    const Knots knots(curve.knots());
    const int count = static_cast<int>(curve.poles().size());
    TColgp_Array1OfPnt2d poles(1, count);
    TColStd_Array1OfReal weights(1, count);
    for (int i = 0; i < count; ++i) {
        poles(i + 1) = gp_Pnt2d(curve.poles()[i].x(), curve.poles()[i].y());
        weights(i + 1) = curve.weights().empty() ? 1.0 : curve.weights()[i];
    }
    return new Geom2d_BSplineCurve(poles, weights, knots.values, knots.multiplicities, curve.knots().degree());
}

/// Vertex k where curve k of the loop starts; as wide as the gap to the end of the one before.
std::vector<TopoDS_Vertex> corner_vertices(const Face& face, const TrimmingLoop& loop) {
    const auto end = [&](const TrimmingCurve& curve, bool first) {
        const ParameterInterval domain = curve.curve.domain();
        const Vector2 at = curve.curve.value(first != curve.reversed ? domain.low : domain.high);
        return face.surface.value(at.x(), at.y());
    };
    std::vector<TopoDS_Vertex> result;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vector3 start = end(loop[k], true), before = end(loop[(k + loop.size() - 1) % loop.size()], false);
        TopoDS_Vertex vertex;
        BRep_Builder().MakeVertex(vertex, to_point(start), vertex_tolerance + (start - before).norm());
        result.push_back(vertex);
    }
    return result;
}

TopoDS_Face to_kernel(const Face& face) {
    const Handle(Geom_BSplineSurface) surface = to_kernel(face.surface);
    if (face.region.whole_domain()) {
        BRepBuilderAPI_MakeFace make(surface, vertex_tolerance);
        if (!make.IsDone()) throw InvalidInput("the kernel makes no face of face " + std::to_string(face.number));
        return face.reversed ? TopoDS::Face(make.Face().Reversed()) : make.Face();
    }
    TopoDS_Face result;
    BRep_Builder builder;
    builder.MakeFace(result, surface, vertex_tolerance);
    for (const TrimmingLoop& loop : face.region.loops()) {
        const std::vector<TopoDS_Vertex> corners = corner_vertices(face, loop);
        BRepBuilderAPI_MakeWire wire;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const TopoDS_Vertex &from = corners[k], &to = corners[(k + 1) % loop.size()];
            const bool back = loop[k].reversed;
            BRepBuilderAPI_MakeEdge make(to_kernel(loop[k].curve), surface, back ? to : from, back ? from : to);
            if (!make.IsDone())
                throw InvalidInput("curve " + std::to_string(k + 1) + " of face " + std::to_string(face.number) +
                                   " makes no edge");
            TopoDS_Edge edge = make.Edge();
            BRepLib::BuildCurve3d(edge);
            wire.Add(back ? TopoDS::Edge(edge.Reversed()) : edge);
        }
        if (!wire.IsDone()) throw InvalidInput("a loop of face " + std::to_string(face.number) + " makes no wire");
        builder.Add(result, wire.Wire());
    }
    ShapeFix_Face fix(result);
    fix.Perform();
    fix.FixOrientation();
    return face.reversed ? TopoDS::Face(fix.Face().Reversed()) : fix.Face();
}

/// All faces on B-spline surfaces with loops in their parameters.
TopoDS_Compound to_kernel(const Model& model) {
    TopoDS_Compound result;
    BRep_Builder builder;
    builder.MakeCompound(result);
    for (const Face& face : model.faces) builder.Add(result, to_kernel(face));
    return result;
}

ModelCopy exchanged_by(const Model& model, const std::string& ending, double precision) {
    std::string folder = (std::filesystem::temp_directory_path() / "umbilic_exchange_XXXXXX").string();
    if (!::mkdtemp(folder.data())) throw InvalidInput("no temporary folder can be made");
    const std::string path = folder + "/model" + ending;
    ModelCopy copy;
    try {
        models::write_cad(to_kernel(elementary_as_nurbs().copy(model).model), "model", path);
        copy.model = read_file(path).model;
    } catch (...) {
        std::filesystem::remove_all(folder);
        throw;
    }
    std::filesystem::remove_all(folder);
    copy.deviation = precision * (model.box.diagonal() + model.box.center().norm());
    return copy;
}

}  // namespace

std::vector<Invariance> exchanges() {
    return {{"through_step", [](const Model& model) { return exchanged_by(model, ".step", step_precision); }},
            {"through_iges", [](const Model& model) { return exchanged_by(model, ".igs", iges_precision); }}};
}

}  // namespace umbilic::support
