// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <support/random_faces.h>
#include <support/surfaces.h>
#include <umbilic/curvature_points/curvature_points.h>
#include <umbilic/curvature_points/dependence.h>

namespace umbilic {
namespace {

NurbsSurface tilted(const NurbsSurface& surface) {
    return support::transformed(surface, support::random_similarity(5, 3.0, false));
}

TEST(Dependence, ElementaryAndSweptSurfacesAreNamed) {
    const auto why = [](const NurbsSurface& surface) { return curvature_dependence(tilted(surface)).value_or(""); };
    EXPECT_NE(why(support::smooth_bicubic(8, 1, 0.0)).find("plane"), std::string::npos);
    EXPECT_NE(why(support::full_sphere(2.0)).find("sphere"), std::string::npos);
    EXPECT_NE(why(support::full_cone(1.0, 1.0, 3.0)).find("cylinder"), std::string::npos);
    EXPECT_NE(why(support::full_cone(1.0, 2.0, 3.0)).find("cone"), std::string::npos);
    EXPECT_NE(why(support::full_torus(3.0, 1.0)).find("torus"), std::string::npos);
    const KnotVector knots(2, {0, 0, 0, 1, 2, 2, 2});
    EXPECT_NE(why(support::revolved(knots, {{1, 0}, {2, 1}, {1.5, 2}, {2.5, 4}}, {1, 1, 1, 1})).find("revolution"),
              std::string::npos);
    const NurbsSurface extrusion = support::graph_patch(
        5, 1, [](double x, double) { return 0.3 * x * x * x - 0.2 * x * x + 0.1 * std::pow(x, 5); });
    EXPECT_NE(why(extrusion).find("extrusion"), std::string::npos);
}

TEST(Dependence, DevelopablesAndHelicalSweepsAreNoticed) {
    // Tangent developable of (t, t^2, t^3): r = c(t) + s c'(t), s in [1, 2].
    const KnotVector cubic(3, {0, 0, 0, 0, 1, 1, 1, 1}), linear(1, {1, 1, 2, 2});
    std::vector<Vector3> poles;
    const auto blossom = [](double a, double b, double c) {
        return Vector3((a + b + c) / 3, (a * b + b * c + c * a) / 3, a * b * c);
    };
    const auto tangent = [](double a, double b) { return Vector3(1, a + b, 3 * a * b); };
    for (int i = 0; i <= 3; ++i)
        for (const double s : {1.0, 2.0}) {
            const double t[3] = {i > 2 ? 1.0 : 0.0, i > 1 ? 1.0 : 0.0, i > 0 ? 1.0 : 0.0};
            // The quadratic tangent raised to degree 3.
            const Vector3 slope = (tangent(t[0], t[1]) + tangent(t[1], t[2]) + tangent(t[2], t[0])) / 3;
            poles.push_back(blossom(t[0], t[1], t[2]) + s * slope);
        }
    const auto why = curvature_dependence(tilted(NurbsSurface(cubic, linear, poles)));
    ASSERT_TRUE(why.has_value());
    EXPECT_NE(why->find("developable"), std::string::npos) << *why;
}

TEST(Dependence, FreeFormIsIndependent) {
    for (unsigned seed = 1; seed <= 60; ++seed)
        EXPECT_FALSE(curvature_dependence(support::random_face(seed).surface).has_value()) << seed;
    EXPECT_FALSE(curvature_dependence(support::ellipsoid_octant(1.0, 2.0, 3.0)).has_value());
}

TEST(Dependence, TheSearchRefusesWithTheReason) {
    const CurvatureQuery query{0.5, 1.0};
    const CurvaturePoints found = find_curvature_points(support::full_torus(3.0, 1.0), {&query, 1});
    ASSERT_TRUE(found.refused.has_value());
    EXPECT_NE(found.refused->find("torus"), std::string::npos);
    EXPECT_TRUE(found.points.empty());
}

TEST(Dependence, CurvesOfSolutionsAreLeftWithinTheBudget) {
    // On the torus asked without recognition, the points of one parallel are solutions.
    const NurbsSurface torus = support::full_torus(3.0, 1.0);
    const Curvature there = curvature(torus, 0.3, 0.4);
    const CurvatureQuery query{there.gaussian(), there.mean()};
    const CurvaturePoints found = find_curvature_points(torus, {&query, 1}, {.recognition = 0.0});
    ASSERT_FALSE(found.points.empty());
    EXPECT_LT(found.boxes, 1000000);
    for (const CurvaturePoint& point : found.points) EXPECT_FALSE(point.certified);
}

}  // namespace
}  // namespace umbilic
