// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/closest_point.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <support/surfaces.h>
#include <umbilic/core/errors.h>

namespace umbilic {
namespace {

/// Rounding of a distance between coordinates of size 1, with room for the condition of a rational evaluation.
constexpr double rounding = 1e-13;

std::vector<Vector3> random_points(unsigned seed, int count, const Vector3& center, double reach) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-reach, reach);
    std::vector<Vector3> points;
    for (int i = 0; i < count; ++i)
        points.push_back(center + Vector3(uniform(random), uniform(random), uniform(random)));
    return points;
}

/// Least distance over a grid, then refined: every grid point that is a local minimum of the grid starts a descent by
/// pattern search within the domain.
double brute_force(const NurbsSurface& surface, const Vector3& point, int n) {
    const ParameterBox domain = surface.domain();
    const auto distance = [&](double s, double t) {
        return (surface.value(domain.u.low + s * domain.u.length(), domain.v.low + t * domain.v.length()) - point)
            .norm();
    };
    std::vector<double> grid((n + 1) * (n + 1));
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) grid[i * (n + 1) + j] = distance(i / double(n), j / double(n));
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            double here = grid[i * (n + 1) + j];
            bool least = true;
            for (int a = std::max(i - 1, 0); a <= std::min(i + 1, n); ++a)
                for (int b = std::max(j - 1, 0); b <= std::min(j + 1, n); ++b)
                    least = least && here <= grid[a * (n + 1) + b];
            if (!least) continue;
            double s = i / double(n), t = j / double(n);
            for (double step = 0.5 / n; step > 1e-9;) {
                double next = here, s_next = s, t_next = t;
                for (int a = -1; a <= 1; ++a)
                    for (int b = -1; b <= 1; ++b) {
                        const double x = std::clamp(s + a * step, 0.0, 1.0), y = std::clamp(t + b * step, 0.0, 1.0);
                        const double d = distance(x, y);
                        if (d < next) next = d, s_next = x, t_next = y;
                    }
                if (next < here) {
                    here = next, s = s_next, t = t_next;
                } else {
                    step *= 0.5;
                }
            }
            best = std::min(best, here);
        }
    return best;
}

void expect_consistent(const NurbsSurface& surface, const Vector3& point, const ClosestPoint& found, double scale) {
    EXPECT_TRUE(found.certified);
    EXPECT_TRUE(surface.domain().contains(found.at.u, found.at.v));
    EXPECT_LE((surface.value(found.at.u, found.at.v) - found.point).norm(), rounding * scale);
    EXPECT_NEAR((found.point - point).norm(), found.distance, rounding * scale);
}

NurbsSurface plane_patch() {
    return NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1),
                        {Vector3(0, 0, 0), Vector3(0, 1, 0), Vector3(2, 0, 0), Vector3(2, 1, 0)});
}

TEST(ClosestPointTree, PlaneRectangleInClosedForm) {
    const NurbsSurface plane = plane_patch();
    const ClosestPointTree tree(plane);
    for (const Vector3& point : random_points(1, 500, Vector3(1, 0.5, 0), 3.0)) {
        const Vector3 foot(std::clamp(point.x(), 0.0, 2.0), std::clamp(point.y(), 0.0, 1.0), 0.0);
        const auto found = tree.closest(point);
        ASSERT_TRUE(found);
        expect_consistent(plane, point, *found, 4.0);
        EXPECT_LE((found->point - foot).norm(), 1e-12);
        const int sides = (foot.x() != point.x()) + (foot.y() != point.y());
        EXPECT_EQ(static_cast<int>(found->kind), sides);
    }
}

TEST(ClosestPointTree, SphereOctantInClosedForm) {
    const double radius = 2.0;
    const NurbsSurface octant = support::ellipsoid_octant(radius, radius, radius);
    const ClosestPointTree tree(octant);
    for (const Vector3& point : random_points(2, 1000, Vector3::Zero(), 5.0)) {
        // The closest point of the octant is the radial one, or that of the nearest of its three sides.
        Vector3 foot = Vector3::Zero();
        if ((point.array() >= 0.0).all()) {
            foot = radius * point.normalized();
        } else {
            double best = std::numeric_limits<double>::infinity();
            for (int axis = 0; axis < 3; ++axis) {
                Vector3 flat = point.cwiseMax(0.0);
                flat[axis] = 0.0;
                for (int corner = 0; corner < 4; ++corner) {
                    Vector3 q = radius * (corner < 3 ? Vector3(Vector3::Unit(corner)) : flat);
                    if (corner == 3) {
                        if (flat.norm() == 0.0) continue;
                        q = radius * flat.normalized();
                    }
                    if ((q - point).norm() < best) best = (q - point).norm(), foot = q;
                }
            }
        }
        const auto found = tree.closest(point);
        ASSERT_TRUE(found);
        expect_consistent(octant, point, *found, 10.0);
        EXPECT_NEAR(found->distance, (foot - point).norm(), 10 * rounding);
    }
}

TEST(ClosestPointTree, CentreOfASphereIsEquallyFarFromAll) {
    const ClosestPointTree tree(support::ellipsoid_octant(2.0, 2.0, 2.0));
    const auto found = tree.closest(Vector3::Zero());
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->certified);
    EXPECT_NEAR(found->distance, 2.0, rounding);
    const auto beside = tree.closest(Vector3(1e-6, 2e-6, -1e-6));
    ASSERT_TRUE(beside);
    EXPECT_TRUE(beside->certified);
    EXPECT_NEAR(beside->distance, 2.0 - std::sqrt(5.0) * 1e-6, 1e-11);
}

TEST(ClosestPointTree, CollapsedEdgeIsOrdinary) {
    const NurbsSurface octant = support::ellipsoid_octant(1.0, 1.0, 1.0);
    const ClosestPointTree tree(octant);
    for (const double height : {0.2, 0.9, 1.0, 1.3, 20.0}) {
        const Vector3 point(0, 0, height);
        const auto found = tree.closest(point);
        ASSERT_TRUE(found);
        EXPECT_TRUE(found->certified) << height;
        EXPECT_NEAR(found->distance, std::abs(height - 1.0), 20 * rounding);
    }
    const Vector3 beside(-1e-3, -1e-3, 1.1);
    EXPECT_LE((tree.closest(beside)->point - Vector3::UnitZ()).norm(), 1e-7);
}

TEST(ClosestPointTree, TorusQuarterInClosedForm) {
    const double major = 3.0, minor = 1.0;
    const NurbsSurface torus = support::torus_quarter(major, minor);
    const ClosestPointTree tree(torus);
    // The patch is 0 <= azimuth <= 90 degrees, upper outer quarter of the tube.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 500; ++i) {
        const double azimuth = uniform(random) * std::numbers::pi / 2, angle = uniform(random) * std::numbers::pi / 2;
        const double height = 4 * uniform(random) - 0.9;
        const Vector3 out(std::cos(azimuth), std::sin(azimuth), 0);
        const Vector3 normal = std::cos(angle) * out + std::sin(angle) * Vector3::UnitZ();
        const Vector3 foot = major * out + minor * normal;
        const Vector3 point = foot + height * normal;
        const auto found = tree.closest(point);
        ASSERT_TRUE(found);
        expect_consistent(torus, point, *found, 10.0);
        EXPECT_NEAR(found->distance, std::abs(height), 10 * rounding);
        EXPECT_LE((found->point - foot).norm(), 1e-9);
    }
    // All of the central circle is equally far.
    const auto found = tree.closest(Vector3(major, 0, 0));
    EXPECT_TRUE(found->certified);
    EXPECT_NEAR(found->distance, minor, rounding);
    // A point of the axis is as far from every point of one circle of latitude.
    const auto axis = tree.closest(Vector3(0, 0, 0.5));
    EXPECT_TRUE(axis->certified);
    EXPECT_NEAR(axis->distance, std::hypot(major, 0.5), 10 * rounding);
}

TEST(ClosestPointTree, AgreesWithBruteForce) {
    const std::vector<NurbsSurface> surfaces = {
        support::smooth_bicubic(8, 1),
        support::rough_bicubic(6, 2),
        support::random_surface(2, 4, 6, 7, 3, 0.2, 5.0),
        support::random_surface(3, 2, 5, 5, 4, 0.5, 20.0),
        support::random_surface(1, 3, 5, 6, 5, 0.2),
        support::table_3_1_patch(),
    };
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        const ClosestPointTree tree(surfaces[k]);
        for (const double reach : {0.6, 4.0})
            for (const Vector3& point : random_points(10 + k, 20, Vector3(0.5, 0.5, 0.0), reach)) {
                const auto found = tree.closest(point);
                ASSERT_TRUE(found);
                expect_consistent(surfaces[k], point, *found, 5.0);
                const double truth = brute_force(surfaces[k], point, 60);
                EXPECT_LE(found->distance, truth + rounding) << k << " at " << point.transpose();
                EXPECT_GE(found->distance, truth - 1e-9) << k << " at " << point.transpose();
            }
    }
}

TEST(ClosestPointTree, PointsOfTheSurfaceAreFoundAgain) {
    const NurbsSurface surface = support::smooth_bicubic(8, 5);
    const ClosestPointTree tree(surface);
    for (int i = 0; i <= 12; ++i)
        for (int j = 0; j <= 12; ++j) {
            const auto found = tree.closest(surface.value(i / 12.0, j / 12.0));
            ASSERT_TRUE(found);
            EXPECT_TRUE(found->certified);
            EXPECT_LE(found->distance, 1e-14);
            EXPECT_NEAR(found->at.u, i / 12.0, 1e-9);
            EXPECT_NEAR(found->at.v, j / 12.0, 1e-9);
        }
}

/// z = x^2 + y^2 over [-1, 1]^2: on the axis above the focal point (0, 0, 1/2) a whole circle is closest.
TEST(ClosestPointTree, MedialAxisOfAParaboloid) {
    const ClosestPointTree tree(support::graph_patch(2, 2, [](double x, double y) { return x * x + y * y; }));
    for (const double height : {-1.0, 0.0, 0.3, 0.5, 0.6, 1.0}) {
        const auto found = tree.closest(Vector3(0, 0, height));
        ASSERT_TRUE(found);
        // Beyond the focal point nothing separates the points of the circle: the answer is right but remains unproved.
        EXPECT_EQ(found->certified, height <= 0.5) << height;
        const double truth = height <= 0.5 ? std::abs(height) : std::sqrt(height - 0.25);
        EXPECT_NEAR(found->distance, truth, rounding) << height;
    }
}

TEST(ClosestPointTree, TieGoesToTheSmallestParameters) {
    // z = x^2 - y^2 / 4: from (0, 0, 1) the points (-a, 0) and (a, 0) are equally far.
    const ClosestPointTree tree(support::graph_patch(2, 2, [](double x, double y) { return x * x - y * y / 4; }));
    const auto found = tree.closest(Vector3(0, 0, 1));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->distance, std::sqrt(0.75), rounding);
    EXPECT_LT(found->point.x(), 0.0);

    const Model twice = support::model_of({plane_patch(), plane_patch()});
    const ClosestPointTree both(twice);
    for (const Vector3& point : random_points(7, 100, Vector3(1, 0.5, 0), 2.0))
        EXPECT_EQ(both.closest(point)->at.face, 1);
}

TEST(ClosestPointTree, NearestOfManyFaces) {
    std::vector<NurbsSurface> surfaces;
    for (unsigned k = 0; k < 12; ++k)
        surfaces.push_back(
            support::transformed(support::smooth_bicubic(6, k), support::random_similarity(k, 1.0, false, 2.0)));
    std::vector<ClosestPointTree> single;
    for (const NurbsSurface& surface : surfaces) single.emplace_back(surface);
    const Model model = support::model_of(surfaces);
    const ClosestPointTree tree(model);
    const std::vector<Vector3> points = random_points(8, 200, Vector3::Zero(), 4.0);
    const std::vector<ClosestPoint> found = tree.closest(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        int face = 0;
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < single.size(); ++k) {
            const double distance = single[k].closest(points[i])->distance;
            if (distance < best) best = distance, face = static_cast<int>(k) + 1;
        }
        EXPECT_NEAR(found[i].distance, best, 10 * rounding);
        EXPECT_EQ(found[i].at.face, face);
        // A batch gives what single queries give, bit by bit.
        const auto alone = tree.closest(points[i]);
        EXPECT_EQ(alone->at.u, found[i].at.u);
        EXPECT_EQ(alone->distance, found[i].distance);
    }
}

TEST(ClosestPointTree, LimitCutsOff) {
    const ClosestPointTree tree(plane_patch());
    EXPECT_FALSE(tree.closest(Vector3(1, 0.5, 2.0), 1.999));
    EXPECT_TRUE(tree.closest(Vector3(1, 0.5, 2.0), 2.001));
    EXPECT_TRUE(tree.closest(Vector3(1, 0.5, 2.0), 2.0));
    EXPECT_TRUE(std::isinf(tree.closest(std::vector<Vector3>{Vector3(1, 0.5, 2.0)}, 1.0)[0].distance));
    EXPECT_THROW(tree.closest(Vector3(std::nan(""), 0, 0)), InvalidInput);
    EXPECT_THROW(tree.closest(Vector3::Zero(), -1.0), InvalidInput);
    EXPECT_FALSE(ClosestPointTree(Model{}).closest(Vector3::Zero()));
}

TEST(ClosestPointTree, FarFromTheOrigin) {
    const NurbsSurface here = support::smooth_bicubic(8, 3);
    SimilarityTransform move;
    move.translation = Vector3(1e6, -2e6, 3e6);
    const NurbsSurface there = support::transformed(here, move);
    const ClosestPointTree near(here), far(there);
    for (const Vector3& point : random_points(9, 100, Vector3(0.5, 0.5, 0), 1.0)) {
        const auto a = near.closest(point);
        const auto b = far.closest(point + move.translation);
        EXPECT_TRUE(b->certified);
        EXPECT_NEAR(a->distance, b->distance, 1e-8);
    }
}

/// Circle of radius `radius` about (x, y) in the parameter plane, four rational quadratic quarters.
TrimmingLoop circle(double x, double y, double radius) {
    const double w = std::numbers::sqrt2 / 2;
    const std::vector<Vector2> unit = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    std::vector<Vector2> poles;
    for (const Vector2& p : unit) poles.push_back(Vector2(x, y) + radius * p);
    return {{.curve = NurbsCurve2(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}), std::move(poles),
                                  {1, w, 1, w, 1, w, 1, w, 1})}};
}

Model trimmed_model(NurbsSurface surface, std::vector<TrimmingLoop> loops) {
    Model model = support::model_of({std::move(surface)});
    const ParameterBox domain = model.faces[0].surface.domain();
    model.faces[0].region = TrimmingRegion(domain, std::move(loops), {}, {});
    return model;
}

NurbsSurface unit_square() {
    return NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1),
                        {Vector3(0, 0, 0), Vector3(0, 1, 0), Vector3(1, 0, 0), Vector3(1, 1, 0)});
}

TEST(ClosestPointTree, TrimmedDiscInClosedForm) {
    const ClosestPointTree tree(trimmed_model(unit_square(), {circle(0.5, 0.5, 0.3)}));
    const Vector3 center(0.5, 0.5, 0.0);
    for (const Vector3& point : random_points(11, 500, center, 1.5)) {
        Vector3 flat = point - center;
        flat.z() = 0.0;
        const bool inside = flat.norm() <= 0.3;
        const Vector3 foot = center + (inside ? flat : Vector3(0.3 * flat.normalized()));
        const auto found = tree.closest(point);
        ASSERT_TRUE(found);
        EXPECT_TRUE(found->certified);
        EXPECT_NEAR(found->distance, (point - foot).norm(), 1e-13);
        EXPECT_LE((found->point - foot).norm(), 1e-10);
        EXPECT_EQ(found->kind == FootKind::interior, inside);
    }
}

TEST(ClosestPointTree, HoleInClosedForm) {
    const TrimmingCurve bottom{.curve = NurbsCurve2(KnotVector::bezier(1), {{0, 0}, {1, 0}})};
    const TrimmingCurve right{.curve = NurbsCurve2(KnotVector::bezier(1), {{1, 0}, {1, 1}})};
    const TrimmingCurve top{.curve = NurbsCurve2(KnotVector::bezier(1), {{1, 1}, {0, 1}})};
    const TrimmingCurve left{.curve = NurbsCurve2(KnotVector::bezier(1), {{0, 1}, {0, 0}})};
    const ClosestPointTree tree(trimmed_model(unit_square(), {{bottom, right, top, left}, circle(0.5, 0.5, 0.3)}));
    const Vector3 center(0.5, 0.5, 0.0);
    for (const Vector3& point : random_points(12, 500, center, 1.0)) {
        Vector3 foot = point.cwiseMax(0.0).cwiseMin(1.0);
        foot.z() = 0.0;
        if ((foot - center).norm() < 0.3) foot = center + 0.3 * (foot - center).normalized();
        const auto found = tree.closest(point);
        ASSERT_TRUE(found);
        EXPECT_TRUE(found->certified);
        EXPECT_NEAR(found->distance, (point - foot).norm(), 1e-13);
    }
    // On the axis of the hole all of its edge is equally far.
    const auto axis = tree.closest(center + Vector3(0, 0, 0.4));
    EXPECT_TRUE(axis->certified);
    EXPECT_NEAR(axis->distance, 0.5, 1e-14);
}

TEST(ClosestPointTree, CurvedLoopOnACurvedSurface) {
    const NurbsSurface surface = support::smooth_bicubic(7, 4);
    const ClosestPointTree tree(trimmed_model(surface, {circle(0.5, 0.5, 0.35)}));
    for (const Vector3& point : random_points(13, 60, Vector3(0.5, 0.5, 0), 1.0)) {
        const auto found = tree.closest(point);
        ASSERT_TRUE(found);
        EXPECT_TRUE(found->certified);
        EXPECT_LE(std::hypot(found->at.u - 0.5, found->at.v - 0.5), 0.35 + 2e-6);
        double truth = std::numeric_limits<double>::infinity();
        const int n = 200;
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j < 4 * n; ++j) {
                const double r = 0.35 * i / n, angle = j * std::numbers::pi / (2 * n);
                const Vector3 p = surface.value(0.5 + r * std::cos(angle), 0.5 + r * std::sin(angle));
                truth = std::min(truth, (p - point).norm());
            }
        EXPECT_LE(found->distance, truth + 1e-12);
        EXPECT_GE(found->distance, truth - 1e-3);
    }
}

/// Quarter of a cylinder of radius 2 about z, 0 <= z <= 3, with native angle and height, cut by a slanted line.
TEST(ClosestPointTree, AngularParameters) {
    const double w = std::numbers::sqrt2 / 2, quarter = std::numbers::pi / 2;
    const NurbsSurface cylinder(
        KnotVector(2, {0, 0, 0, quarter, quarter, quarter}), KnotVector(1, {0, 0, 3, 3}),
        {Vector3(2, 0, 0), Vector3(2, 0, 3), Vector3(2, 2, 0), Vector3(2, 2, 3), Vector3(0, 2, 0), Vector3(0, 2, 3)},
        {1, 1, w, w, 1, 1});
    Model model = support::model_of({cylinder});
    const auto line = [](Vector2 a, Vector2 b) {
        return TrimmingCurve{.curve = NurbsCurve2(KnotVector::bezier(1), {a, b})};
    };
    model.faces[0].region = TrimmingRegion(
        cylinder.domain(), {{line({0, 0}, {quarter, 0}), line({quarter, 0}, {0, 3}), line({0, 3}, {0, 0})}},
        ParameterMap::angular({0, quarter}), {});
    const ClosestPointTree tree(model);
    for (const Vector3& point : random_points(14, 300, Vector3(1, 1, 1.5), 3.0)) {
        // The face in closed form, by a fine scan of its angles: at each the height is clamped exactly.
        double truth = std::numeric_limits<double>::infinity();
        const int n = 20000;
        for (int i = 0; i <= n; ++i) {
            const double angle = quarter * i / n;
            const double height = std::clamp(point.z(), 0.0, 3.0 * (1.0 - i / double(n)));
            truth = std::min(truth, (Vector3(2 * std::cos(angle), 2 * std::sin(angle), height) - point).norm());
        }
        const auto found = tree.closest(point);
        ASSERT_TRUE(found);
        EXPECT_TRUE(found->certified);
        EXPECT_LE(found->distance, truth + 1e-12);
        EXPECT_GE(found->distance, truth - 1e-6);
    }
}

}  // namespace
}  // namespace umbilic
