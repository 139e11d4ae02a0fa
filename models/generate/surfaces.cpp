// SPDX-License-Identifier: LGPL-2.1-or-later
#include "surfaces.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BSplCLib.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>

namespace umbilic::models {
namespace {

constexpr double kSewingTolerance = 1e-5;  // mm; the shared edges are equal to rounding
constexpr double kFaceTolerance = 1e-7;    // mm; OpenCASCADE's own Precision::Confusion

struct Knots {
    TColStd_Array1OfReal values;
    TColStd_Array1OfInteger multiplicities;
};

Knots clamped_uniform_knots(int poles, int degree) {
    const int spans = poles - degree;
    assert(spans >= 1);
    Knots knots{{1, spans + 1}, {1, spans + 1}};
    for (int i = 0; i <= spans; ++i) {
        knots.values(i + 1) = double(i) / spans;
        knots.multiplicities(i + 1) = i == 0 || i == spans ? degree + 1 : 1;
    }
    return knots;
}

TColStd_Array1OfReal flat_knots(int poles, int degree) {
    const Knots knots = clamped_uniform_knots(poles, degree);
    TColStd_Array1OfReal flat{1, poles + degree + 1};
    BSplCLib::KnotSequence(knots.values, knots.multiplicities, flat);
    return flat;
}

TColStd_Array1OfReal mapped(const TColStd_Array1OfReal& knots, double first, double last) {
    TColStd_Array1OfReal result = knots;
    const double from = knots.First(), width = knots.Last() - knots.First();
    for (int i = knots.Lower(); i <= knots.Upper(); ++i) result(i) = first + (last - first) * (knots(i) - from) / width;
    return result;
}

// One row of points, interpolated in place at the Greville abscissae of the spline.
void interpolate(TColgp_Array1OfPnt& points, int degree) {
    const int count = points.Length();
    TColStd_Array1OfReal parameters{1, count};
    TColStd_Array1OfInteger contact_order{1, count};
    contact_order.Init(0);
    for (int i = 0; i < count; ++i) parameters(i + 1) = greville(i, count, degree);
    int problem = 0;
    BSplCLib::Interpolate(degree, flat_knots(count, degree), parameters, contact_order, points, problem);
    if (problem != 0) throw std::runtime_error("interpolation failed: singular system");
}

// Smooth, increasing on [0, 1], fixes both ends.
double warp(double t) {
    return t + 0.17 * t * (1 - t);
}

}  // namespace

Net make_net(int size_u, int size_v, const std::function<gp_Pnt(int, int)>& place) {
    Net net(size_u, std::vector<gp_Pnt>(size_v));
    for (int i = 0; i < size_u; ++i)
        for (int j = 0; j < size_v; ++j) net[i][j] = place(i, j);
    return net;
}

BSpline clamped_surface(const Net& net, int degree_u, int degree_v) {
    const int size_u = int(net.size()), size_v = int(net.front().size());
    degree_u = std::min(degree_u, size_u - 1);
    degree_v = std::min(degree_v, size_v - 1);
    TColgp_Array2OfPnt poles{1, size_u, 1, size_v};
    for (int i = 0; i < size_u; ++i)
        for (int j = 0; j < size_v; ++j) poles(i + 1, j + 1) = net[i][j];
    const Knots u = clamped_uniform_knots(size_u, degree_u);
    const Knots v = clamped_uniform_knots(size_v, degree_v);
    return new Geom_BSplineSurface{poles, u.values, v.values, u.multiplicities, v.multiplicities, degree_u, degree_v};
}

double greville(int i, int poles, int degree) {
    const TColStd_Array1OfReal flat = flat_knots(poles, degree);
    double sum = 0;
    for (int k = 1; k <= degree; ++k) sum += flat(i + 1 + k);
    return sum / degree;
}

BSpline reparametrised(const BSpline& surface, int degree_u, int degree_v, const std::vector<double>& knots_u,
                       const std::vector<double>& knots_v) {
    BSpline result = BSpline::DownCast(surface->Copy());
    result->IncreaseDegree(degree_u, degree_v);
    for (double u : knots_u) result->InsertUKnot(u, 1, 0);
    for (double v : knots_v) result->InsertVKnot(v, 1, 0);
    result->ExchangeUV();
    result->SetUKnots(mapped(result->UKnots(), 0, 7.5));
    result->SetVKnots(mapped(result->VKnots(), -2, 3));
    return result;
}

BSpline reapproximated(const BSpline& surface, int degree, int poles_u, int poles_v) {
    const int degree_u = std::min(degree, poles_u - 1), degree_v = std::min(degree, poles_v - 1);
    Net net = make_net(poles_u, poles_v, [&](int i, int j) {
        return surface->Value(warp(greville(i, poles_u, degree_u)), warp(greville(j, poles_v, degree_v)));
    });
    TColgp_Array1OfPnt column{1, poles_u}, row{1, poles_v};
    for (int j = 0; j < poles_v; ++j) {
        for (int i = 0; i < poles_u; ++i) column(i + 1) = net[i][j];
        interpolate(column, degree_u);
        for (int i = 0; i < poles_u; ++i) net[i][j] = column(i + 1);
    }
    for (int i = 0; i < poles_u; ++i) {
        for (int j = 0; j < poles_v; ++j) row(j + 1) = net[i][j];
        interpolate(row, degree_v);
        for (int j = 0; j < poles_v; ++j) net[i][j] = row(j + 1);
    }
    return clamped_surface(net, degree_u, degree_v);
}

double largest_distance(const BSpline& from, const BSpline& to, int grid) {
    double u0, u1, v0, v1, largest = 0;
    from->Bounds(u0, u1, v0, v1);
    for (int i = 0; i <= grid; ++i)
        for (int j = 0; j <= grid; ++j) {
            const gp_Pnt point = from->Value(u0 + (u1 - u0) * i / grid, v0 + (v1 - v0) * j / grid);
            // Over a border the foot of the perpendicular may not exist; the corresponding point bounds
            // the distance then, because both surfaces share their parameter range up to warp().
            double distance = point.Distance(to->Value(warp(double(i) / grid), warp(double(j) / grid)));
            GeomAPI_ProjectPointOnSurf foot{point, to};
            if (foot.NbPoints() > 0) distance = std::min(distance, foot.LowerDistance());
            largest = std::max(largest, distance);
        }
    return largest;
}

TopoDS_Face whole_face(const Surface& surface) {
    return BRepBuilderAPI_MakeFace{surface, kFaceTolerance}.Face();
}

TopoDS_Shape shell_of(const std::vector<TopoDS_Face>& faces) {
    BRepBuilderAPI_Sewing sewing{kSewingTolerance};
    for (const TopoDS_Face& face : faces) sewing.Add(face);
    sewing.Perform();
    return sewing.SewedShape();
}

}  // namespace umbilic::models
