// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solids.h"

#include <cmath>
#include <stdexcept>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>

#include "surfaces.h"

namespace umbilic::models {
namespace {

constexpr double kPlaceTolerance = 1e-6;  // mm; to find an edge by its measures

TopoDS_Shape cylinder(gp_Pnt foot, gp_Dir axis, double radius, double height) {
    return BRepPrimAPI_MakeCylinder{gp_Ax2{foot, axis}, radius, height}.Shape();
}

TopoDS_Edge circle_at(const TopoDS_Shape& shape, double radius, const gp_Pnt& centre) {
    for (TopExp_Explorer it{shape, TopAbs_EDGE}; it.More(); it.Next()) {
        const TopoDS_Edge edge = TopoDS::Edge(it.Current());
        const BRepAdaptor_Curve curve{edge};
        if (curve.GetType() == GeomAbs_Circle && std::abs(curve.Circle().Radius() - radius) < kPlaceTolerance &&
            curve.Circle().Location().Distance(centre) < kPlaceTolerance)
            return edge;
    }
    throw std::runtime_error("the bracket has no such circle");
}

TopoDS_Edge line_through(const TopoDS_Shape& shape, const gp_Pnt& middle) {
    for (TopExp_Explorer it{shape, TopAbs_EDGE}; it.More(); it.Next()) {
        const TopoDS_Edge edge = TopoDS::Edge(it.Current());
        const BRepAdaptor_Curve curve{edge};
        const double t = (curve.FirstParameter() + curve.LastParameter()) / 2;
        if (curve.GetType() == GeomAbs_Line && curve.Value(t).Distance(middle) < kPlaceTolerance) return edge;
    }
    throw std::runtime_error("the bracket has no such edge");
}

TopoDS_Shape merged(const TopoDS_Shape& shape) {
    ShapeUpgrade_UnifySameDomain unify{shape};
    unify.Build();
    return unify.Shape();
}

}  // namespace

TopoDS_Shape bracket() {
    const gp_Dir x{1, 0, 0}, z{0, 0, 1};
    TopoDS_Shape body = BRepPrimAPI_MakeBox{gp_Pnt{0, 0, 0}, 120, 80, 12}.Shape();
    const TopoDS_Shape wall = BRepPrimAPI_MakeBox{gp_Pnt{0, 0, 0}, 14, 62, 70}.Shape();
    const gp_Pnt boss_foot{84, 30, 12};
    body = BRepAlgoAPI_Fuse{body, wall}.Shape();
    body = BRepAlgoAPI_Fuse{body, cylinder({84, 30, 6}, z, 16, 24)}.Shape();
    body = merged(body);

    BRepFilletAPI_MakeFillet fillet{body};
    fillet.Add(5, circle_at(body, 16, boss_foot));    // torus
    fillet.Add(9, line_through(body, {120, 80, 6}));  // cylinders of three radii
    fillet.Add(15, line_through(body, {120, 0, 6}));
    fillet.Add(20, line_through(body, {7, 62, 70}));
    body = fillet.Shape();

    body = BRepAlgoAPI_Cut{body, cylinder({84, 30, -1}, z, 9, 40)}.Shape();
    body = BRepAlgoAPI_Cut{body, cylinder({-1, 25, 48}, x, 8, 20)}.Shape();
    body = BRepAlgoAPI_Cut{body, cylinder({40, 62, -1}, z, 5.5, 14)}.Shape();
    // Countersink: from radius 5.5 at z = 7 to 10.5 at the top of the plate.
    const TopoDS_Shape countersink = BRepPrimAPI_MakeCone{gp_Ax2{gp_Pnt{40, 62, 7}, z}, 5.5, 10.5, 5}.Shape();
    return BRepAlgoAPI_Cut{body, countersink}.Shape();
}

TopoDS_Shape ball() {
    return BRepPrimAPI_MakeSphere{gp_Pnt{40, -10, 15}, 25}.Shape();
}

TopoDS_Shape ring() {
    return BRepPrimAPI_MakeTorus{40, 12}.Shape();
}

TopoDS_Shape ellipsoid() {
    const double seam = 0.65;  // rad; the umbilics stand at 0 and pi
    const gp_Ax3 frame{gp_Pnt{0, 0, 0}, gp_Dir{0, 0, 1}, gp_Dir{std::cos(seam), std::sin(seam), 0}};
    const Handle(Geom_SphericalSurface) unit = new Geom_SphericalSurface{frame, 1};
    const Handle(Geom_BSplineSurface) surface = GeomConvert::SurfaceToBSplineSurface(unit);
    for (int i = 1; i <= surface->NbUPoles(); ++i)
        for (int j = 1; j <= surface->NbVPoles(); ++j) {
            const gp_Pnt p = surface->Pole(i, j);
            surface->SetPole(i, j, gp_Pnt{30 * p.X(), 20 * p.Y(), 10 * p.Z()});
        }
    TopoDS_Shell shell;
    BRep_Builder builder;
    builder.MakeShell(shell);
    builder.Add(shell, whole_face(surface));
    shell.Closed(true);
    TopoDS_Solid solid = BRepBuilderAPI_MakeSolid{shell}.Solid();
    BRepLib::OrientClosedSolid(solid);
    return solid;
}

}  // namespace umbilic::models
