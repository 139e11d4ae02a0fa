// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include <Eigen/Geometry>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>
#include <umbilic/wireframe/wireframe.h>

namespace umbilic {
namespace {

int euler(const FaceWireframe& face) {
    return static_cast<int>(face.nodes.size()) - static_cast<int>(face.edges.size()) +
           static_cast<int>(face.cells.size());
}

/// What must hold of every meshed face.
void expect_sound(const Model& model, const FaceWireframe& face, double step) {
    EXPECT_EQ(face.why, "");
    EXPECT_EQ(face.coverage, 1.0);
    EXPECT_LE(face.farthest, step);
    const NurbsSurface& surface = model.face(face.face).surface;
    for (const WireNode& node : face.nodes) {
        EXPECT_EQ(node.at.face, face.face);
        EXPECT_LT((surface.value(node.at.u, node.at.v) - node.curvature.point).norm(), 1e-6 * step);
    }
    std::map<std::pair<int, int>, int> sides;
    for (const std::vector<int>& cell : face.cells) {
        EXPECT_TRUE(cell.size() == 3 || cell.size() == 4);
        EXPECT_EQ(std::set<int>(cell.begin(), cell.end()).size(), cell.size());
        for (std::size_t i = 0; i < cell.size(); ++i) {
            const int a = cell[i], b = cell[(i + 1) % cell.size()];
            ++sides[{std::min(a, b), std::max(a, b)}];
        }
    }
    ASSERT_EQ(sides.size(), face.edges.size());
    for (const WireEdge& edge : face.edges) {
        const auto found = sides.find({std::min(edge.from, edge.to), std::max(edge.from, edge.to)});
        ASSERT_NE(found, sides.end());
        EXPECT_EQ(found->second, edge.kind == WireKind::boundary ? 1 : 2);
        const double chord = (face.nodes[edge.from].curvature.point - face.nodes[edge.to].curvature.point).norm();
        EXPECT_GE(edge.length, chord * (1 - 1e-9));
        EXPECT_LE(edge.length, 1.6 * chord);
        // The points between lie in order along it.
        double way = 0.0;
        Vector3 before = face.nodes[edge.from].curvature.point;
        for (const Vector3& p : edge.between) {
            way += (p - before).norm();
            before = p;
        }
        way += (face.nodes[edge.to].curvature.point - before).norm();
        EXPECT_LE(way, edge.length * 1.01);
    }
}

struct Shape {
    const char* name;
    NurbsSurface surface;
    double least_quads;  ///< share of the cells
};

std::vector<Shape> shapes() {
    return {{"plane", support::smooth_bicubic(6, 1, 0.0), 0.5},
            {"torus", support::torus_quarter(3, 1), 0.5},
            {"sphere", support::ellipsoid_octant(1, 1, 1), 0.4},
            {"ellipsoid", support::ellipsoid_octant(3, 2, 1), 0.4},
            {"five umbilics", support::table_3_1_patch(), 0.4},
            {"smooth 1", support::smooth_bicubic(8, 1), 0.4},
            {"smooth 2", support::smooth_bicubic(8, 2), 0.4},
            {"smooth 3", support::smooth_bicubic(12, 3), 0.4},
            {"rough", support::rough_bicubic(8, 1), 0.1},
            {"rational", support::random_surface(4, 3, 7, 6, 3, 0.1, 4.0), 0.2}};
}

TEST(Wireframe, CoversDiscsWithTriangulatedOrQuadrilateralCells) {
    for (const Shape& shape : shapes()) {
        SCOPED_TRACE(shape.name);
        const Model model = support::model_of({shape.surface});
        const Wireframe result = wireframe(model);
        ASSERT_EQ(result.faces.size(), 1u);
        EXPECT_NEAR(result.step, 0.05 * model.size(), 1e-12);
        const FaceWireframe& face = result.faces.front();
        expect_sound(model, face, result.step);
        EXPECT_EQ(euler(face), 1);
        EXPECT_GE(face.quadrilaterals, shape.least_quads * static_cast<double>(face.cells.size()));
    }
}

TEST(Wireframe, HasTheSameNodesEdgesAndCellsUndrawn) {
    const Model model = support::model_of({support::smooth_bicubic(8, 2), support::torus_quarter(3, 1)});
    const Wireframe drawn = wireframe(model), undrawn = wireframe(model, {.drawn = false});
    ASSERT_EQ(drawn.faces.size(), undrawn.faces.size());
    for (std::size_t f = 0; f < drawn.faces.size(); ++f) {
        const FaceWireframe &one = drawn.faces[f], &other = undrawn.faces[f];
        ASSERT_EQ(one.nodes.size(), other.nodes.size());
        for (std::size_t i = 0; i < one.nodes.size(); ++i) {
            EXPECT_EQ(one.nodes[i].curvature.point, other.nodes[i].curvature.point);
            EXPECT_EQ(one.nodes[i].area, other.nodes[i].area);
        }
        ASSERT_EQ(one.edges.size(), other.edges.size());
        for (std::size_t i = 0; i < one.edges.size(); ++i) {
            EXPECT_EQ(one.edges[i].length, other.edges[i].length);
            EXPECT_FALSE(one.edges[i].between.empty());
            EXPECT_TRUE(other.edges[i].between.empty() || other.edges[i].kind == WireKind::boundary);
        }
        EXPECT_EQ(one.cells, other.cells);
        EXPECT_EQ(other.coverage, 0.0);
    }
}

TEST(Wireframe, FollowsPrincipalDirections) {
    const Model model = support::model_of({support::table_3_1_patch()});
    const FaceWireframe face = wireframe(model).faces.front();
    int lines = 0;
    for (const WireEdge& edge : face.edges) {
        if (edge.kind != WireKind::maximum && edge.kind != WireKind::minimum) continue;
        const Curvature &a = face.nodes[edge.from].curvature, &b = face.nodes[edge.to].curvature;
        // Away from umbilics, where directions turn slowly.
        if (std::min(a.kappa_max - a.kappa_min, b.kappa_max - b.kappa_min) < 4.0) continue;
        ++lines;
        const Vector3 chord = (b.point - a.point).normalized();
        const Vector3 across_a = edge.kind == WireKind::maximum ? a.direction_min : a.direction_max;
        const Vector3 across_b = edge.kind == WireKind::maximum ? b.direction_min : b.direction_max;
        // The chord of a curve makes opposite angles with its ends to first order.
        EXPECT_NEAR(std::abs(chord.dot(across_a)), std::abs(chord.dot(across_b)), 0.05);
        EXPECT_LT(std::abs(chord.dot(across_a)), 0.35);
    }
    EXPECT_GT(lines, 100);
}

TEST(Wireframe, HasLinesOfATorusForItsSides) {
    const double major = 3, minor = 1;
    const Model model = support::model_of({support::torus_quarter(major, minor)});
    const FaceWireframe face = wireframe(model).faces.front();
    const auto tube = [&](const Vector3& p) { return std::atan2(p.z(), std::hypot(p.x(), p.y()) - major); };
    for (const WireEdge& edge : face.edges) {
        const Vector3 &p = face.nodes[edge.from].curvature.point, &q = face.nodes[edge.to].curvature.point;
        if (edge.kind == WireKind::maximum) {
            EXPECT_NEAR(edge.length, minor * std::abs(tube(p) - tube(q)), 1e-6);
        } else if (edge.kind == WireKind::minimum) {
            EXPECT_NEAR(p.z(), q.z(), 1e-6);
            EXPECT_NEAR(edge.length,
                        std::hypot(p.x(), p.y()) * std::abs(std::atan2(p.y(), p.x()) - std::atan2(q.y(), q.x())), 1e-6);
        }
    }
}

TEST(Wireframe, MeasuresGeodesicsOfASphere) {
    const double radius = 2.0;
    const Model model = support::model_of({support::ellipsoid_octant(radius, radius, radius)});
    const FaceWireframe face = wireframe(model).faces.front();
    for (const WireEdge& edge : face.edges) {
        const Curvature &from = face.nodes[edge.from].curvature, &to = face.nodes[edge.to].curvature;
        // At the pole of the parametrisation no normal is known.
        if (edge.kind != WireKind::geodesic || !from.regular || !to.regular) continue;
        const Vector3 &p = from.point, &q = to.point;
        const double great_circle = radius * std::atan2(p.cross(q).norm(), p.dot(q));
        EXPECT_NEAR(edge.length, great_circle, 1e-9 * great_circle);
    }
}

TEST(Wireframe, IsTheSameEveryTime) {
    const Model model = support::model_of({support::smooth_bicubic(8, 2), support::torus_quarter(3, 1)});
    const Wireframe one = wireframe(model), two = wireframe(model);
    for (std::size_t f = 0; f < one.faces.size(); ++f) {
        ASSERT_EQ(one.faces[f].nodes.size(), two.faces[f].nodes.size());
        for (std::size_t i = 0; i < one.faces[f].nodes.size(); ++i) {
            EXPECT_EQ(one.faces[f].nodes[i].at.u, two.faces[f].nodes[i].at.u);
            EXPECT_EQ(one.faces[f].nodes[i].at.v, two.faces[f].nodes[i].at.v);
        }
    }
}

TEST(Wireframe, BeginsAtARegularPointIfAsked) {
    const Model model = support::model_of({support::smooth_bicubic(8, 2)});
    const Wireframe star = wireframe(model), regular = wireframe(model, {.umbilics = false});
    expect_sound(model, star.faces.front(), star.step);
    expect_sound(model, regular.faces.front(), regular.step);
    // The star is a node of the one.
    const auto at_umbilic = [](const FaceWireframe& face) {
        return std::any_of(face.nodes.begin(), face.nodes.end(), [](const WireNode& node) {
            return !node.on_border && node.curvature.kappa_max - node.curvature.kappa_min < 1e-9;
        });
    };
    EXPECT_TRUE(at_umbilic(star.faces.front()));
    EXPECT_FALSE(at_umbilic(regular.faces.front()));
}

TEST(Wireframe, MeshesFacesSmallerThanTheStep) {
    const Model model = support::model_of({support::smooth_bicubic(8, 2)});
    for (const double step : {0.9, 5.0, 1e6}) {
        const FaceWireframe face = wireframe(model, {.step = step}).faces.front();
        EXPECT_EQ(face.why, "");
        EXPECT_EQ(euler(face), 1);
        EXPECT_EQ(face.coverage, 1.0);
    }
}

TEST(Wireframe, RefusesLengthsThatAreNone) {
    const Model model = support::model_of({support::torus_quarter(3, 1)});
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const double step : {0.0, -1.0, nan, infinity}) {
        EXPECT_THROW(wireframe(model, {.step = step}), InvalidInput);
        EXPECT_THROW(wireframe(model, {.relative_step = step}), InvalidInput);
    }
    EXPECT_THROW(wireframe(model, {.face = 2}), InvalidInput);
    EXPECT_THROW(wireframe(model, {.most_nodes = 0.0}), InvalidInput);
    EXPECT_THROW(wireframe(Model{}), InvalidInput);
    const Progress progress;
    progress.cancel();
    EXPECT_THROW(wireframe(model, {}, progress), Cancelled);
}

TEST(Wireframe, SaysWhenItsBudgetIsSpent) {
    const Model model = support::model_of({support::smooth_bicubic(8, 2)});
    const FaceWireframe face = wireframe(model, {.relative_step = 0.02, .most_nodes = 0.01}).faces.front();
    EXPECT_NE(face.why, "");
}

/// A square face with straight trimming loops.
Model trimmed(const NurbsSurface& surface, const std::vector<std::vector<Vector2>>& polygons) {
    Model model = support::model_of({surface});
    std::vector<TrimmingLoop> loops;
    int edge = 0;
    for (const std::vector<Vector2>& polygon : polygons) {
        TrimmingLoop loop;
        for (std::size_t i = 0; i < polygon.size(); ++i)
            loop.push_back(
                {.curve = NurbsCurve2(KnotVector::bezier(1), {polygon[i], polygon[(i + 1) % polygon.size()]}),
                 .edge = ++edge});
        loops.push_back(std::move(loop));
    }
    model.faces[0].region = TrimmingRegion(surface.domain(), std::move(loops), {}, {});
    return model;
}

TEST(Wireframe, GoesAroundHoles) {
    const Model model = trimmed(support::smooth_bicubic(8, 2), {{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                                                {{0.3, 0.4}, {0.5, 0.7}, {0.7, 0.3}},
                                                                {{0.1, 0.1}, {0.1, 0.2}, {0.2, 0.2}, {0.2, 0.1}}});
    const FaceWireframe face = wireframe(model).faces.front();
    expect_sound(model, face, 0.05 * model.size());
    EXPECT_EQ(euler(face), -1);
    for (const WireNode& node : face.nodes)
        EXPECT_NE(model.faces[0].region.classify(node.at.u, node.at.v), Containment::outside);
}

TEST(Wireframe, MeshesSlivers) {
    for (const double width : {1e-2, 1e-4, 1e-6}) {
        const Model model = trimmed(support::smooth_bicubic(8, 2), {{{0.1, 0.1}, {0.9, 0.8}, {0.1, 0.1 + width}}});
        const FaceWireframe face = wireframe(model).faces.front();
        EXPECT_EQ(face.why, "");
        EXPECT_EQ(euler(face), 1);
        EXPECT_EQ(face.coverage, 1.0) << width << " " << face.farthest << " " << face.nodes.size();
    }
}

}  // namespace
}  // namespace umbilic
