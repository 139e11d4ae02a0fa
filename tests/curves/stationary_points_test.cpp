// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/stationary_points.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>

#include <support/surfaces.h>
#include <umbilic/core/errors.h>

namespace umbilic {
namespace {

constexpr double pi = std::numbers::pi;

/// A whole sphere as a rational biquadratic surface, stretched to half axes a, b, c: seam at u = 0, collapsed edges.
NurbsSurface ellipsoid(double a, double b, double c) {
    const double s = std::sqrt(0.5);
    const double circle[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    const double meridian[5][2] = {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}};
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 5; ++j) {
            poles.emplace_back(a * circle[i][0] * meridian[j][0], b * circle[i][1] * meridian[j][0],
                               c * meridian[j][1]);
            weights.push_back((i % 2 ? s : 1.0) * (j % 2 ? s : 1.0));
        }
    return NurbsSurface(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}), KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 2}),
                        std::move(poles), std::move(weights));
}

/// A whole torus: seams in both directions.
NurbsSurface torus(double major, double minor) {
    const double s = std::sqrt(0.5);
    const double circle[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j) {
            const double radius = major + minor * circle[j][0];
            poles.emplace_back(radius * circle[i][0], radius * circle[i][1], minor * circle[j][1]);
            weights.push_back((i % 2 ? s : 1.0) * (j % 2 ? s : 1.0));
        }
    const std::vector<double> knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
    return NurbsSurface(KnotVector(2, knots), KnotVector(2, knots), std::move(poles), std::move(weights));
}

/// Number of real roots t of sum (a_k p_k / (a_k^2 + t))^2 = 1: one for each normal of the ellipsoid through p.
int normals_through(const Vector3& axes, const Vector3& p) {
    using Coefficients = Eigen::VectorXd;
    const auto times = [](const Coefficients& x, const Coefficients& y) {
        Coefficients result = Coefficients::Zero(x.size() + y.size() - 1);
        for (int i = 0; i < x.size(); ++i)
            for (int j = 0; j < y.size(); ++j) result[i + j] += x[i] * y[j];
        return result;
    };
    std::array<Coefficients, 3> factor;
    for (int k = 0; k < 3; ++k) {
        Coefficients linear(2);
        linear << axes[k] * axes[k], 1.0;
        factor[k] = times(linear, linear);
    }
    Coefficients sextic = -times(times(factor[0], factor[1]), factor[2]);
    for (int k = 0; k < 3; ++k)
        sextic.head(5) += axes[k] * axes[k] * p[k] * p[k] * times(factor[(k + 1) % 3], factor[(k + 2) % 3]);
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(6, 6);
    for (int k = 0; k < 5; ++k) companion(k + 1, k) = 1.0;
    for (int k = 0; k < 6; ++k) companion(k, 5) = -sextic[k] / sextic[6];
    int real = 0;
    const Eigen::VectorXcd roots = companion.eigenvalues();
    for (int k = 0; k < 6; ++k) real += std::abs(roots[k].imag()) < 1e-7;
    return real;
}

std::vector<StationaryPoint> of_kind(const StationaryPoints& found, FootKind kind) {
    std::vector<StationaryPoint> result;
    std::copy_if(found.points.begin(), found.points.end(), std::back_inserter(result),
                 [&](const StationaryPoint& point) { return point.kind == kind; });
    return result;
}

int count_type(const std::vector<StationaryPoint>& points, StationaryType type) {
    return static_cast<int>(
        std::count_if(points.begin(), points.end(), [&](const StationaryPoint& point) { return point.type == type; }));
}

void expect_stationary(const NurbsSurface& surface, const Vector3& p, const StationaryPoints& found) {
    double last = 0.0;
    for (const StationaryPoint& point : found.points) {
        EXPECT_GE(point.distance, last);
        last = point.distance;
        EXPECT_NEAR((point.point - p).norm(), point.distance, 1e-12 * (1 + point.distance));
        if (point.kind != FootKind::interior || !point.certified) continue;
        const SurfaceDerivatives d = surface.derivatives(point.at.u, point.at.v, 1);
        EXPECT_NEAR((d.r() - p).dot(d.r_u()) / d.r_u().norm(), 0.0, 1e-8);
        EXPECT_NEAR((d.r() - p).dot(d.r_v()) / d.r_v().norm(), 0.0, 1e-8);
        EXPECT_LE(point.radius.maxCoeff(), 1e-8);
    }
}

TEST(StationaryPoints, NormalsOfAnEllipsoidAsTheSexticCountsThem) {
    const Vector3 axes(3, 2, 1);
    const NurbsSurface surface = ellipsoid(3, 2, 1);
    std::mt19937 engine(4);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    int counts[8] = {};
    for (int k = 0; k < 120; ++k) {
        // From deep inside the evolute to outside the ellipsoid.
        const double reach = 0.2 + 0.04 * k;
        const Vector3 p = reach * Vector3(number(engine), number(engine), number(engine));
        SCOPED_TRACE(k);
        const StationaryPoints found = find_stationary_points(surface, p);
        EXPECT_TRUE(found.undecided.empty());
        EXPECT_FALSE(found.exhausted);
        EXPECT_TRUE(of_kind(found, FootKind::edge).empty());
        // The two points of collapsed edges.
        EXPECT_EQ(of_kind(found, FootKind::corner).size(), 2u);
        const std::vector<StationaryPoint> interior = of_kind(found, FootKind::interior);
        const int wanted = normals_through(axes, p);
        ASSERT_EQ(static_cast<int>(interior.size()), wanted);
        ++counts[wanted];
        expect_stationary(surface, p, found);
        // Morse: minima - saddles + maxima is the Euler characteristic of the sphere.
        EXPECT_EQ(count_type(interior, StationaryType::minimum) - count_type(interior, StationaryType::saddle) +
                      count_type(interior, StationaryType::maximum),
                  2);
        EXPECT_EQ(count_type(interior, StationaryType::undetermined), 0);
    }
    // Outside the evolute, between its sheets, and inside both.
    EXPECT_GT(counts[2], 10);
    EXPECT_GT(counts[4], 10);
    EXPECT_GT(counts[6], 5);
    EXPECT_EQ(counts[2] + counts[4] + counts[6], 120);
}

TEST(StationaryPoints, CentreOfAnEllipsoidHasSixWithTwoAtItsPoles) {
    const NurbsSurface surface = ellipsoid(3, 2, 1);
    const StationaryPoints found = find_stationary_points(surface, Vector3::Zero());
    EXPECT_TRUE(found.undecided.empty());
    ASSERT_EQ(found.points.size(), 6u);
    const double wanted[6] = {1, 1, 2, 2, 3, 3};
    for (int k = 0; k < 6; ++k) {
        EXPECT_NEAR(found.points[k].distance, wanted[k], 1e-14);
        EXPECT_EQ(found.points[k].kind, FootKind::interior);
        // Of collapsed edges it is known only within rounding.
        EXPECT_EQ(found.points[k].certified, k >= 2);
    }
    EXPECT_EQ(found.points[2].type, StationaryType::saddle);
    EXPECT_EQ(found.points[4].type, StationaryType::maximum);
}

TEST(StationaryPoints, FourOnATorusWithoutEdgesOrCorners) {
    const NurbsSurface surface = torus(2, 0.5);
    const Vector3 p(3.1, 0.4, 0.7);
    const StationaryPoints found = find_stationary_points(surface, p);
    EXPECT_TRUE(found.undecided.empty());
    ASSERT_EQ(found.points.size(), 4u);
    const double near = std::hypot(std::hypot(3.1, 0.4) - 2, 0.7), far = std::hypot(std::hypot(3.1, 0.4) + 2, 0.7);
    const double wanted[4] = {near - 0.5, near + 0.5, far - 0.5, far + 0.5};
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(found.points[k].distance, wanted[k], 1e-12);
    EXPECT_EQ(count_type(found.points, StationaryType::saddle), 2);
    // On the seams of both directions: each point appears once.
    const StationaryPoints on_seam = find_stationary_points(surface, Vector3(3, 0, 0));
    EXPECT_EQ(on_seam.points.size(), 4u);
}

TEST(StationaryPoints, CentreOfASphereIsOneUndecidedRegion) {
    const NurbsSurface surface = ellipsoid(2, 2, 2);
    const StationaryPoints found = find_stationary_points(surface, Vector3::Zero());
    ASSERT_EQ(found.undecided.size(), 1u);
    EXPECT_EQ(found.undecided[0].boxes.size(), 8u);
    EXPECT_EQ(found.boxes, 8);
    for (const StationaryPoint& point : found.points) {
        EXPECT_NEAR(point.distance, 2.0, 1e-12);
    }
    // A little beside the centre there are two again, or the sphere cannot be told from its rounding.
    const StationaryPoints beside = find_stationary_points(surface, Vector3(1e-3, 2e-3, 1e-3));
    EXPECT_TRUE(beside.undecided.empty());
    EXPECT_EQ(of_kind(beside, FootKind::interior).size(), 2u);
}

TEST(StationaryPoints, AxisOfATorusIsACircleInFewBoxes) {
    const StationaryPoints found = find_stationary_points(torus(2, 0.5), Vector3(0, 0, 0.3));
    EXPECT_TRUE(of_kind(found, FootKind::interior).empty());
    // The nearest and the farthest circle, each along the whole of u.
    EXPECT_EQ(found.undecided.size(), 2u);
    // A circle is 10^8 tolerances long in each of the 16 patches; the search does not follow it that finely.
    EXPECT_LT(found.boxes, 16 * 1000);
    for (const StationaryCluster& cluster : found.undecided) {
        double covered = 0.0;
        for (const ParameterBox& box : cluster.boxes) covered += box.u.length();
        EXPECT_GE(covered, 4.0 - 1e-9);
    }
}

/// The function's stationary points by another way: Newton's method from every point of a grid.
std::vector<Vector2> by_grid(const NurbsSurface& surface, const Vector3& p, int side) {
    std::vector<Vector2> result;
    const ParameterBox domain = surface.domain();
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            Vector2 at(domain.u.low + (i + 0.5) / side * domain.u.length(),
                       domain.v.low + (j + 0.5) / side * domain.v.length());
            bool converged = false;
            for (int step = 0; step < 30 && !converged; ++step) {
                const SurfaceDerivatives d = surface.derivatives(at.x(), at.y(), 2);
                const Vector3 gap = d.r() - p;
                const Vector2 f(gap.dot(d.r_u()), gap.dot(d.r_v()));
                Matrix2 h;
                h << d.r_u().dot(d.r_u()) + gap.dot(d.r_uu()), d.r_u().dot(d.r_v()) + gap.dot(d.r_uv()),
                    d.r_u().dot(d.r_v()) + gap.dot(d.r_uv()), d.r_v().dot(d.r_v()) + gap.dot(d.r_vv());
                if (std::abs(h.determinant()) < 1e-12) break;
                const Vector2 change = h.inverse() * f;
                at -= change;
                if (!domain.contains(at.x(), at.y())) break;
                converged = change.norm() < 1e-13;
            }
            if (!converged) continue;
            const bool known = std::any_of(result.begin(), result.end(),
                                           [&](const Vector2& other) { return (other - at).norm() < 1e-9; });
            if (!known) result.push_back(at);
        }
    return result;
}

TEST(StationaryPoints, NoneMissedOnRandomSurfaces) {
    std::mt19937 engine(9);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    int met = 0, edges = 0;
    for (unsigned k = 0; k < 40; ++k) {
        SCOPED_TRACE(k);
        const int p_degree = 2 + k % 3, q_degree = 2 + k / 3 % 3;
        const NurbsSurface surface =
            support::random_surface(p_degree, q_degree, p_degree + 3, q_degree + 2, k, 0.3, k % 2 == 0 ? 1.0 : 3.0);
        const Vector3 p(number(engine), number(engine), 0.8 * number(engine));
        const StationaryPoints found = find_stationary_points(surface, p);
        EXPECT_TRUE(found.undecided.empty());
        expect_stationary(surface, p, found);
        const std::vector<StationaryPoint> interior = of_kind(found, FootKind::interior);
        const std::vector<Vector2> wanted = by_grid(surface, p, 25);
        EXPECT_EQ(interior.size(), wanted.size());
        for (const Vector2& at : wanted) {
            ++met;
            EXPECT_TRUE(std::any_of(interior.begin(), interior.end(), [&](const StationaryPoint& point) {
                return std::abs(point.at.u - at.x()) < 1e-9 && std::abs(point.at.v - at.y()) < 1e-9;
            }));
        }
        EXPECT_EQ(of_kind(found, FootKind::corner).size(), 4u);
        // Along each edge the distance's slope changes sign at the edge's points, and nowhere else.
        int changes = 0;
        for (int side = 0; side < 4; ++side) {
            double last = 0.0;
            for (int s = 0; s <= 2000; ++s) {
                const double t = s / 2000.0, fixed = side % 2;
                const SurfaceDerivatives d =
                    side < 2 ? surface.derivatives(fixed, t, 1) : surface.derivatives(t, fixed, 1);
                const double slope = (d.r() - p).dot(side < 2 ? d.r_v() : d.r_u());
                changes += s > 0 && slope * last < 0.0;
                last = slope;
            }
        }
        EXPECT_EQ(static_cast<int>(of_kind(found, FootKind::edge).size()), changes);
        edges += changes;
        // The nearest of all is the global minimum.
        const std::optional<ClosestPoint> closest = ClosestPointTree(surface).closest(p);
        ASSERT_TRUE(closest);
        EXPECT_NEAR(found.points[0].distance, closest->distance, 1e-10);
    }
    EXPECT_GT(met, 40);
    EXPECT_GT(edges, 100);
}

TEST(StationaryPoints, CreasesAreEdgesAndSmoothKnotsAreNot) {
    // A roof: two planes that meet in the line x = 1.
    std::vector<Vector3> poles;
    for (const double x : {0.0, 1.0, 2.0})
        for (const double y : {0.0, 2.0}) poles.emplace_back(x, y, x == 1.0 ? 1.0 : 0.0);
    const NurbsSurface roof(KnotVector(1, {0, 0, 0.5, 1, 1}), KnotVector(1, {0, 0, 1, 1}), poles);
    const StationaryPoints over = find_stationary_points(roof, Vector3(1, 0.7, 2));
    ASSERT_FALSE(over.points.empty());
    EXPECT_EQ(over.points[0].kind, FootKind::edge);
    EXPECT_EQ(over.points[0].type, StationaryType::minimum);
    EXPECT_NEAR((over.points[0].point - Vector3(1, 0.7, 1)).norm(), 0.0, 1e-14);
    EXPECT_EQ(of_kind(over, FootKind::corner).size(), 6u);
    EXPECT_EQ(of_kind(over, FootKind::edge).size(), 3u);
    // The same knots on one plane.
    for (Vector3& pole : poles) pole.z() = 0.0;
    const NurbsSurface flat(KnotVector(1, {0, 0, 0.5, 1, 1}), KnotVector(1, {0, 0, 1, 1}), poles);
    const StationaryPoints on_knot = find_stationary_points(flat, Vector3(1, 0.7, 2));
    EXPECT_EQ(of_kind(on_knot, FootKind::interior).size(), 1u);
    EXPECT_EQ(of_kind(on_knot, FootKind::edge).size(), 4u);
    EXPECT_EQ(of_kind(on_knot, FootKind::corner).size(), 4u);
}

TEST(StationaryPoints, FarFromTheOriginAndInOtherUnits) {
    const NurbsSurface surface = support::random_surface(3, 3, 6, 6, 5, 0.3);
    const Vector3 p(0.4, 0.5, 0.6);
    const StationaryPoints plain = find_stationary_points(surface, p);
    for (const double scale : {1e-3, 25.4, 1e4}) {
        SimilarityTransform move = support::random_similarity(3, scale, false, 1e3 * scale);
        const StationaryPoints moved = find_stationary_points(support::transformed(surface, move), move.apply(p));
        ASSERT_EQ(plain.points.size(), moved.points.size());
        for (std::size_t k = 0; k < plain.points.size(); ++k) {
            EXPECT_NEAR(moved.points[k].at.u, plain.points[k].at.u, 1e-9);
            EXPECT_NEAR(moved.points[k].distance, scale * plain.points[k].distance, 1e-9 * scale);
            EXPECT_EQ(moved.points[k].type, plain.points[k].type);
        }
    }
}

TEST(StationaryPoints, BadInputAndCancelling) {
    const NurbsSurface surface = support::table_3_1_patch();
    EXPECT_THROW(find_stationary_points(surface, Vector3(0, 0, std::numeric_limits<double>::quiet_NaN())),
                 InvalidInput);
    StationaryPointsOptions options;
    options.tolerance = 0.0;
    EXPECT_THROW(find_stationary_points(surface, Vector3::Zero(), options), InvalidInput);
    options = {};
    options.boxes_per_patch = 0;
    EXPECT_THROW(find_stationary_points(surface, Vector3::Zero(), options), InvalidInput);
    const Progress progress([](double, std::string_view) { return false; });
    EXPECT_THROW(find_stationary_points(surface, Vector3::Zero(), {}, progress), Cancelled);
}

}  // namespace
}  // namespace umbilic
