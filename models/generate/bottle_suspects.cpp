// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bottle_suspects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <GProp_GProps.hxx>
#include <Geom2dAPI_Interpolate.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <TColgp_HArray1OfPnt2d.hxx>
#include <TopoDS.hxx>

namespace umbilic::models {
namespace {

constexpr double kAreaTolerance = 1e-7;   // relative; the default integration is only good to 1e-4
constexpr double kBesideTop = 0.4;        // poles beside the top of the bulge move by this share
constexpr double kCurveTolerance = 1e-7;  // of the parameter plane

double area(const TopoDS_Shape& shape) {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(shape, properties, kAreaTolerance);
    return properties.Mass();
}

}  // namespace

TopoDS_Shape reparametrised_bottle(const Bottle& bottle) {
    std::vector<TopoDS_Face> faces;
    for (const BSpline& surface : bottle.faces()) {
        const bool panel = surface->VDegree() == 3;
        const std::vector<double> knots_v = panel ? std::vector{0.11, 0.53, 0.74} : std::vector{0.5};
        const BSpline copy = reparametrised(surface, 4, panel ? 5 : 2, {0.07, 0.33, 0.47, 0.86}, knots_v);
        // Swapping u and v turned the normal; the face keeps its outer side.
        faces.push_back(TopoDS::Face(whole_face(copy).Reversed()));
    }
    return shell_of(faces);
}

Reapproximation reapproximated_bottle(const Bottle& bottle) {
    constexpr int degree = 5, poles_panel = 21, poles_neck = 2;
    std::vector<TopoDS_Face> faces;
    double largest = 0;
    for (const BSpline& surface : bottle.faces()) {
        const bool panel = surface->VDegree() == 3;
        const BSpline copy = reapproximated(surface, degree, poles_panel, panel ? poles_panel : poles_neck);
        constexpr int grid = 60;
        largest = std::max(largest, largest_distance(copy, surface, grid));
        faces.push_back(whole_face(copy));
    }
    return {shell_of(faces), largest};
}

Piece bottle_piece(const Bottle& bottle) {
    // An egg round (0.47, 0.62) in the parameter plane, through twelve points, closed and smooth.
    constexpr int count = 12;
    Handle(TColgp_HArray1OfPnt2d) points = new TColgp_HArray1OfPnt2d{1, count};
    for (int k = 0; k < count; ++k) {
        const double t = 2 * std::numbers::pi * k / count;
        const double wide = 0.41 * (1 + 0.13 * std::cos(t + 0.7)), high = 0.345;
        points->SetValue(k + 1, gp_Pnt2d{0.47 + wide * std::cos(t), 0.62 + high * std::sin(t)});
    }
    const bool periodic = true;
    Geom2dAPI_Interpolate interpolation{points, periodic, kCurveTolerance};
    interpolation.Perform();
    const Handle(Geom2d_BSplineCurve) curve = interpolation.Curve();
    const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge{curve, bottle.front}.Edge();
    const TopoDS_Face face = BRepBuilderAPI_MakeFace{bottle.front, BRepBuilderAPI_MakeWire{edge}.Wire()}.Face();
    BRepLib::BuildCurves3d(face);
    const double share = area(face);
    return {face, share / area(whole_face(bottle.front)), share / area(shell_of(bottle))};
}

Redesign redesigned_bottle(const Bottle& bottle) {
    // Finer knots give the bulge a support that ends inside the front.
    BSpline front = BSpline::DownCast(bottle.front->Copy());
    for (double knot : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        front->InsertUKnot(knot, 1, 0);
        front->InsertVKnot(knot, 1, 0);
    }
    constexpr int first_u = 6, last_u = 8, first_v = 5, last_v = 7;  // poles that move, from 1
    constexpr double bulge = 7;                                      // mm
    for (int i = first_u; i <= last_u; ++i)
        for (int j = first_v; j <= last_v; ++j) {
            const double weight = (i == first_u + 1 ? 1 : kBesideTop) * (j == first_v + 1 ? 1 : kBesideTop);
            front->SetPole(i, j, front->Pole(i, j).Translated(gp_Vec{0, -bulge * weight, 0}));
        }
    // Pole i of a cubic acts between the flat knots i and i + 4.
    const auto flat_u = front->UKnotSequence(), flat_v = front->VKnotSequence();
    const double u0 = flat_u(first_u), u1 = flat_u(last_u + 4);
    const double v0 = flat_v(first_v), v1 = flat_v(last_v + 4);
    const Surface region = new Geom_RectangularTrimmedSurface{bottle.front, u0, u1, v0, v1};

    double largest = 0;
    constexpr int grid = 200;
    for (int i = 0; i <= grid; ++i)
        for (int j = 0; j <= grid; ++j) {
            const double u = double(i) / grid, v = double(j) / grid;
            largest = std::max(largest, front->Value(u, v).Distance(bottle.front->Value(u, v)));
        }
    Bottle changed = bottle;
    changed.front = front;
    return {shell_of(changed), area(whole_face(region)) / area(shell_of(bottle)), largest};
}

}  // namespace umbilic::models
