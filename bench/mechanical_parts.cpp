// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mechanical_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>

#include <occ_adapter/shape_file.h>
#include <umbilic/core/errors.h>

namespace umbilic::bench {

namespace {

const gp_Dir x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};

TopoDS_Shape block(double x, double y, double z, double dx, double dy, double dz) {
    return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), dx, dy, dz).Shape();
}

TopoDS_Shape rod(const gp_Pnt& foot, const gp_Dir& axis, double radius, double height) {
    return BRepPrimAPI_MakeCylinder(gp_Ax2(foot, axis), radius, height).Shape();
}

TopoDS_Shape cut(const TopoDS_Shape& body, const TopoDS_Shape& tool) {
    return BRepAlgoAPI_Cut(body, tool).Shape();
}

TopoDS_Shape fused(const TopoDS_Shape& a, const TopoDS_Shape& b) {
    ShapeUpgrade_UnifySameDomain unify(BRepAlgoAPI_Fuse(a, b).Shape());
    unify.Build();
    return unify.Shape();
}

TopoDS_Shape prism(const std::vector<gp_Pnt>& corners, const gp_Vec& height) {
    BRepBuilderAPI_MakePolygon polygon;
    for (const gp_Pnt& corner : corners) polygon.Add(corner);
    polygon.Close();
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), height).Shape();
}

TopoDS_Shape bracket() {
    TopoDS_Shape body = fused(block(0, 0, 0, 100, 60, 10), block(0, 0, 0, 12, 60, 55));
    body = fused(body, rod({70, 28, 5}, z_axis, 14, 20));
    body = cut(body, rod({70, 28, -1}, z_axis, 8, 40));
    body = cut(body, rod({-1, 18, 36}, x_axis, 6, 20));
    body = cut(body, rod({-1, 42, 36}, x_axis, 6, 20));
    body = cut(body, rod({30, 12, -1}, z_axis, 4.5, 20));
    body = cut(body, rod({30, 47, -1}, z_axis, 4.5, 20));
    return cut(body, BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(30, 47, 6), z_axis), 4.5, 9, 4.5).Shape());
}

TopoDS_Shape flange() {
    TopoDS_Shape body = fused(rod({0, 0, 0}, z_axis, 60, 14), rod({0, 0, 0}, z_axis, 32, 40));
    body = cut(body, rod({0, 0, -1}, z_axis, 20, 60));
    for (int k = 0; k < 6; ++k) {
        const double angle = k * std::numbers::pi / 3;
        body = cut(body, rod({46 * std::cos(angle), 46 * std::sin(angle), -1}, z_axis, 5.5, 20));
    }
    return body;
}

TopoDS_Shape shaft() {
    TopoDS_Shape body = fused(rod({0, 0, 0}, x_axis, 15, 40), rod({40, 0, 0}, x_axis, 22, 70));
    body = fused(body, rod({110, 0, 0}, x_axis, 12, 35));
    body = fused(body, BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(145, 0, 0), x_axis), 12, 9, 6).Shape());
    body = cut(body, BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(85, 0, 0), x_axis), 23, 3).Shape());
    return cut(body, block(50, -4, 18, 25, 8, 10));
}

TopoDS_Shape housing() {
    TopoDS_Shape body = cut(block(0, 0, 0, 90, 70, 50), block(8, 8, 10, 74, 54, 60));
    body = fused(body, rod({45, 0, 24}, gp_Dir(0, -1, 0), 18, 12));
    body = cut(body, rod({45, 20, 24}, gp_Dir(0, -1, 0), 11, 50));
    for (const auto& [x, y] : {std::pair(4.0, 4.0), std::pair(86.0, 4.0), std::pair(4.0, 66.0), std::pair(86.0, 66.0)})
        body = cut(body, rod({x, y, 35}, z_axis, 2.2, 30));
    body = cut(body, BRepPrimAPI_MakeSphere(gp_Pnt(90, 35, 25), 12).Shape());
    return cut(body, rod({70, 55, 28}, y_axis, 6, 30));
}

TopoDS_Shape stepped_block() {
    TopoDS_Shape body = fused(block(0, 0, 0, 80, 50, 20), block(0, 0, 0, 35, 50, 42));
    body = fused(body, block(0, 30, 0, 60, 20, 33));
    body = cut(body, block(50, -1, 8, 12, 60, 20));
    return cut(body, block(10, 10, 30, 9, 16, 20));
}

TopoDS_Shape wedge() {
    const TopoDS_Shape body =
        prism({{0, 0, 0}, {70, 0, 0}, {70, 0, 18}, {48, 0, 40}, {20, 0, 47}, {0, 0, 30}}, {0, 44, 0});
    return cut(body, prism({{-1, -1, 20}, {-1, 20, 20}, {-1, -1, 48}}, {90, 0, 0}));
}

TopoDS_Shape plate_with_slot() {
    TopoDS_Shape body = block(0, 0, 0, 120, 70, 8);
    body = cut(body, fused(block(30, 30, -1, 40, 12, 20),
                           fused(rod({30, 36, -1}, z_axis, 6, 20), rod({70, 36, -1}, z_axis, 6, 20))));
    body = cut(body, rod({15, 15, -1}, z_axis, 5, 20));
    body = cut(body, rod({104, 52, -1}, z_axis, 7, 20));
    return cut(body, rod({98, 16, -1}, z_axis, 5, 20));
}

TopoDS_Shape as_nurbs(const TopoDS_Shape& shape) {
    return BRepBuilderAPI_NurbsConvert(shape, true).Shape();
}

}  // namespace

std::vector<MechanicalPart> made_parts() {
    return {{"bracket", bracket()},
            {"flange", flange()},
            {"shaft", shaft()},
            {"housing", housing()},
            {"steps", stepped_block()},
            {"wedge", wedge()},
            {"plate", plate_with_slot()},
            {"bracket as NURBS", as_nurbs(bracket())},
            {"housing as NURBS", as_nurbs(housing())}};
}

TopoDS_Shape plate_with_bosses(int count, unsigned seed) {
    constexpr double pitch = 10.0, thickness = 4.0;
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    TopTools_ListOfShape plate, bosses;
    plate.Append(block(0, 0, 0, side * pitch, side * pitch, thickness));
    for (int k = 0; k < count; ++k) {
        const gp_Pnt foot((k % side + 0.5) * pitch, (k / side + 0.5) * pitch, thickness - 1.0);
        const double radius = uniform(1.0, 4.0), height = uniform(2.0, 8.0);
        if (k % 3 == 0)
            bosses.Append(rod(foot, z_axis, radius, height));
        else if (k % 3 == 1)
            bosses.Append(BRepPrimAPI_MakeCone(gp_Ax2(foot, z_axis), radius, 0.6 * radius, height).Shape());
        else
            bosses.Append(BRepPrimAPI_MakeSphere(foot, radius).Shape());
    }
    BRepAlgoAPI_Fuse fuse;
    fuse.SetArguments(plate);
    fuse.SetTools(bosses);
    fuse.Build();
    return fuse.Shape();
}

std::vector<MechanicalPart> parts_of_file(const std::string& path, const std::string& name, int count) {
    const TopoDS_Shape shape = read_shape_file(path, describe_file(path), Progress()).shape;
    std::vector<MechanicalPart> parts;
    std::vector<double> volumes;
    for (TopExp_Explorer it(shape, TopAbs_SOLID); it.More() && static_cast<int>(parts.size()) < count; it.Next()) {
        GProp_GProps properties;
        BRepGProp::VolumeProperties(it.Current(), properties);
        const double volume = properties.Mass();
        const auto same = [&](double other) { return std::abs(volume - other) < 1e-3 * std::abs(volume); };
        if (std::any_of(volumes.begin(), volumes.end(), same)) continue;
        volumes.push_back(volume);
        parts.push_back({name + (count > 1 ? " " + std::to_string(parts.size() + 1) : ""), it.Current()});
    }
    return parts;
}

TopoDS_Shape inside_ball(const TopoDS_Shape& shape, const Vector3& centre, double radius) {
    const gp_Pnt middle(centre.x(), centre.y(), centre.z());
    const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(middle, radius).Shape();
    TopoDS_Compound result;
    BRep_Builder builder;
    builder.MakeCompound(result);
    for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next()) {
        Bnd_Box box;
        BRepBndLib::Add(it.Current(), box);
        const gp_Pnt low = box.CornerMin(), high = box.CornerMax();
        const Vector3 from(low.X(), low.Y(), low.Z()), to(high.X(), high.Y(), high.Z());
        const Vector3 nearest = centre.cwiseMax(from).cwiseMin(to);
        if ((nearest - centre).norm() >= radius) continue;
        const Vector3 farthest = (from - centre).cwiseAbs().cwiseMax((to - centre).cwiseAbs());
        if (farthest.norm() <= radius) {
            builder.Add(result, it.Current());
            continue;
        }
        const TopoDS_Shape part = BRepAlgoAPI_Common(it.Current(), ball).Shape();
        for (TopExp_Explorer face(part, TopAbs_FACE); face.More(); face.Next()) builder.Add(result, face.Current());
    }
    return result;
}

int face_count(const TopoDS_Shape& shape) {
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    return faces.Extent();
}

TopoDS_Shape with_neighbour(const TopoDS_Shape& shape, const TopoDS_Shape& neighbour) {
    struct Measure {
        double area;
        Vector3 middle;
        double reach;
    };
    const auto measured = [](const TopoDS_Shape& of) {
        GProp_GProps properties;
        BRepGProp::SurfaceProperties(of, properties);
        Bnd_Box box;
        BRepBndLib::Add(of, box);
        const gp_Pnt low = box.CornerMin(), high = box.CornerMax();
        return Measure{properties.Mass(), 0.5 * Vector3(low.X() + high.X(), low.Y() + high.Y(), low.Z() + high.Z()),
                       0.5 * low.Distance(high)};
    };
    const Measure own = measured(shape), other = measured(neighbour);
    SimilarityTransform beside;
    beside.scale = std::sqrt(own.area / other.area);
    const Vector3 place = own.middle + (own.reach + beside.scale * other.reach) * Vector3(0.6, 0.64, 0.48);
    beside.translation = place - beside.scale * other.middle;
    TopoDS_Compound result;
    BRep_Builder builder;
    builder.MakeCompound(result);
    builder.Add(result, shape);
    builder.Add(result, moved(neighbour, beside));
    return result;
}

TopoDS_Shape moved(const TopoDS_Shape& shape, const SimilarityTransform& transform) {
    const Matrix3 linear = transform.scale * transform.orthogonal();
    const Vector3& t = transform.translation;
    gp_Trsf placement;
    placement.SetValues(linear(0, 0), linear(0, 1), linear(0, 2), t.x(), linear(1, 0), linear(1, 1), linear(1, 2),
                        t.y(), linear(2, 0), linear(2, 1), linear(2, 2), t.z());
    return BRepBuilderAPI_Transform(shape, placement, true).Shape();
}

}  // namespace umbilic::bench
