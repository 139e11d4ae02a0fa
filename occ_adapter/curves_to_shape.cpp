// SPDX-License-Identifier: LGPL-2.1-or-later
#include "curves_to_shape.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRep_Builder.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Precision.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>

#include <umbilic/core/errors.h>

namespace umbilic {

TopoDS_Shape shape_of(const std::vector<std::vector<Vector3>>& curves) {
    BRep_Builder builder;
    TopoDS_Compound all;
    builder.MakeCompound(all);
    int made = 0;
    for (const std::vector<Vector3>& curve : curves) {
        std::vector<gp_Pnt> points;
        for (const Vector3& p : curve) {
            const gp_Pnt point(p.x(), p.y(), p.z());
            if (points.empty() || points.back().Distance(point) > Precision::Confusion()) points.push_back(point);
        }
        if (points.size() < 2) continue;
        if (points.size() == 2) {
            builder.Add(all, BRepBuilderAPI_MakeEdge(points[0], points[1]).Edge());
        } else {
            const Handle(TColgp_HArray1OfPnt) array = new TColgp_HArray1OfPnt(1, static_cast<int>(points.size()));
            for (std::size_t i = 0; i < points.size(); ++i) array->SetValue(static_cast<int>(i) + 1, points[i]);
            GeomAPI_Interpolate interpolation(array, Standard_False, Precision::Confusion());
            interpolation.Perform();
            if (!interpolation.IsDone()) throw NumericFailure("OpenCASCADE makes no curve through the points");
            builder.Add(all, BRepBuilderAPI_MakeEdge(interpolation.Curve()).Edge());
        }
        ++made;
    }
    if (made == 0) throw NumericFailure("there is no curve to write");
    return all;
}

}  // namespace umbilic
