// SPDX-License-Identifier: LGPL-2.1-or-later
#include "regions.h"

#include <cmath>
#include <numbers>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Ax1.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include "surfaces.h"

namespace umbilic::models {

using std::numbers::pi;

// The rounding is a tube round (foot_radius, fillet height) that touches the sphere from outside.
double DomePlate::foot_radius() const {
    return std::sqrt(std::pow(radius + fillet, 2) - std::pow(fillet - centre_height, 2));
}

double DomePlate::opening_angle() const {
    return std::acos((fillet - centre_height) / (radius + fillet));
}

double DomePlate::dome_area() const {
    return 2 * pi * radius * radius * (1 - std::cos(opening_angle()));
}

double DomePlate::fillet_area() const {
    return 2 * pi * fillet * (foot_radius() * opening_angle() - fillet * (1 - std::cos(opening_angle())));
}

double DomePlate::plate_area() const {
    return length * width - pi * foot_radius() * foot_radius();
}

TopoDS_Shape dome_plate(const DomePlate& m) {
    const double foot = m.foot_radius(), angle = m.opening_angle();
    const auto section = [&](double r, double z) { return gp_Pnt{m.dome_x + r, m.dome_y, z}; };
    const auto on_sphere = [&](double t) {
        return section(m.radius * std::sin(t), m.centre_height + m.radius * std::cos(t));
    };
    const auto on_tube = [&](double t) {
        return section(foot - m.fillet * std::sin(t), m.fillet - m.fillet * std::cos(t));
    };
    BRepBuilderAPI_MakeWire profile;
    profile.Add(
        BRepBuilderAPI_MakeEdge{GC_MakeArcOfCircle{on_sphere(0), on_sphere(angle / 2), on_sphere(angle)}.Value()});
    profile.Add(BRepBuilderAPI_MakeEdge{GC_MakeArcOfCircle{on_tube(angle), on_tube(angle / 2), on_tube(0)}.Value()});
    const gp_Ax1 axis{section(0, 0), gp_Dir{0, 0, 1}};
    const TopoDS_Shape round = BRepPrimAPI_MakeRevol{profile.Wire(), axis}.Shape();

    const gp_Circ rim{gp_Ax2{section(0, 0), gp_Dir{0, 0, 1}, gp_Dir{1, 0, 0}}, foot};
    BRepBuilderAPI_MakeFace plate{gp_Pln{gp_Pnt{0, 0, 0}, gp_Dir{0, 0, 1}}, -m.length / 2, m.length / 2, -m.width / 2,
                                  m.width / 2};
    plate.Add(TopoDS::Wire(BRepBuilderAPI_MakeWire{BRepBuilderAPI_MakeEdge{rim}.Edge()}.Wire().Reversed()));

    std::vector<TopoDS_Face> faces;
    for (TopExp_Explorer it{round, TopAbs_FACE}; it.More(); it.Next()) faces.push_back(TopoDS::Face(it.Current()));
    faces.push_back(plate.Face());
    return BRepBuilderAPI_NurbsConvert{shell_of(faces)}.Shape();
}

TopoDS_Shape planar_block() {
    constexpr int size_u = 10, size_v = 8;
    constexpr int flat_u = 7, flat_v = 6;  // poles in z = 0 from the corner on
    return whole_face(clamped_surface(make_net(size_u, size_v, [](int i, int j) {
        const double rise_u = std::max(0, i - flat_u + 1), rise_v = std::max(0, j - flat_v + 1);
        return gp_Pnt{90 * greville(i, size_u), 70 * greville(j, size_v),
                      4.0 * rise_u * rise_u + 3.0 * rise_v * rise_v + 0.5 * rise_u * rise_v};
    })));
}

}  // namespace umbilic::models
