// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model_to_shape.h"

#include <algorithm>
#include <vector>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

struct Knots {
    TColStd_Array1OfReal values;
    TColStd_Array1OfInteger multiplicities;
};

Knots kernel_knots(const KnotVector& knots) {
    std::vector<double> distinct = knots.knots();
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    const int count = static_cast<int>(distinct.size());
    Knots result{TColStd_Array1OfReal(1, count), TColStd_Array1OfInteger(1, count)};
    for (int k = 0; k < count; ++k) {
        result.values.SetValue(k + 1, distinct[k]);
        result.multiplicities.SetValue(
            k + 1, static_cast<int>(std::count(knots.knots().begin(), knots.knots().end(), distinct[k])));
    }
    return result;
}

Handle(Geom_BSplineSurface) kernel_surface(const NurbsSurface& surface) {
    TColgp_Array2OfPnt poles(1, surface.u_pole_count(), 1, surface.v_pole_count());
    TColStd_Array2OfReal weights(1, surface.u_pole_count(), 1, surface.v_pole_count());
    for (int i = 0; i < surface.u_pole_count(); ++i)
        for (int j = 0; j < surface.v_pole_count(); ++j) {
            const Vector3& p = surface.pole(i, j);
            poles.SetValue(i + 1, j + 1, gp_Pnt(p.x(), p.y(), p.z()));
            weights.SetValue(i + 1, j + 1, surface.weight(i, j));
        }
    const Knots u = kernel_knots(surface.u_knots()), v = kernel_knots(surface.v_knots());
    return new Geom_BSplineSurface(poles, weights, u.values, v.values, u.multiplicities, v.multiplicities,
                                   surface.u_degree(), surface.v_degree());
}

}  // namespace

TopoDS_Shape shape_of(const Model& model) {
    BRep_Builder builder;
    TopoDS_Compound all;
    builder.MakeCompound(all);
    TopoDS_Face last;
    for (const Face& face : model.faces) {
        BRepBuilderAPI_MakeFace maker(kernel_surface(face.surface), Precision::Confusion());
        if (!maker.IsDone())
            throw NumericFailure("OpenCASCADE makes no face of the surface of face " + std::to_string(face.number));
        last = maker.Face();
        if (face.reversed) last.Reverse();
        builder.Add(all, last);
    }
    if (model.faces.size() == 1) return last;
    return all;
}

}  // namespace umbilic
