// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <umbilic/differential/edge_smoothness.h>

#include <support/surfaces.h>

namespace umbilic {
namespace {

/// Unit square from the y axis towards the direction (cos, sin) of the x, z plane.
NurbsSurface leaf(double angle) {
    const Vector3 out(std::cos(angle), 0, std::sin(angle)), along = Vector3::UnitY();
    return NurbsSurface(KnotVector::bezier(1), KnotVector::bezier(1), {Vector3::Zero(), along, out, out + along});
}

/// Quarter of a cylinder of radius r that leaves the y axis along +x and turns upwards.
NurbsSurface quarter(double r) {
    const double w = std::sqrt(0.5);
    const Vector3 along = Vector3::UnitY(), side(r, 0, 0), top(r, 0, r);
    return NurbsSurface(KnotVector::bezier(2), KnotVector::bezier(1),
                        {Vector3::Zero(), along, side, side + along, top, top + along}, {1, 1, w, w, 1, 1});
}

EdgeSmoothness of_shared_edge(std::vector<NurbsSurface> surfaces) {
    const Model model = support::model_of(std::move(surfaces));
    const FaceAdjacency adjacency = face_adjacency(model);
    const std::vector<EdgeSmoothness> all = edge_smoothness(adjacency);
    EdgeSmoothness result;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (adjacency.edges[i].uses.size() == 2)
            result = all[i];
        else
            EXPECT_EQ(all[i].samples, 0);
    EXPECT_GT(result.samples, 0);
    return result;
}

TEST(EdgeSmoothness, BendIsTheAngleBetweenTwoLeaves) {
    for (const double angle : {0.0, 1e-4, 0.3, 2.0, 3.0}) {
        for (const NurbsSurface& other : {leaf(angle), leaf(angle).swapped(), leaf(angle).u_reversed()}) {
            const EdgeSmoothness edge = of_shared_edge({leaf(std::numbers::pi), other});
            EXPECT_NEAR(edge.bend, angle, 1e-12);
            EXPECT_EQ(edge.smooth(1e-3), angle < 1e-3);
            EXPECT_NEAR(edge.curvature, 0.0, 1e-12);
        }
    }
}

TEST(EdgeSmoothness, CurvatureJumpsFromPlaneToCylinder) {
    for (const double r : {0.5, 1.0, 40.0}) {
        for (const NurbsSurface& plane : {leaf(std::numbers::pi), leaf(std::numbers::pi).swapped()}) {
            const EdgeSmoothness edge = of_shared_edge({plane, quarter(r)});
            EXPECT_LE(edge.bend, 1e-12);
            EXPECT_NEAR(edge.curvature_jump, 1 / r, 1e-11 / r);
            EXPECT_NEAR(edge.curvature, 1 / r, 1e-11 / r);
        }
    }
}

TEST(EdgeSmoothness, OneSmoothSurfaceCutInTwoHasNoJump) {
    // The graph of one cubic over [-2, 0] x [-1, 1] and [0, 2] x [-1, 1].
    const auto half = [](double middle) {
        const NurbsSurface graph = support::graph_patch(3, 3, [&](double x, double y) {
            const double at = x + middle;
            return 0.4 * at * at + 0.2 * at * at * at - 0.3 * at * y * y + 0.5 * at * y;
        });
        SimilarityTransform shift;
        shift.translation = Vector3(middle, 0, 0);
        return support::transformed(graph, shift);
    };
    const EdgeSmoothness edge = of_shared_edge({half(-1), half(1).swapped()});
    EXPECT_LE(edge.bend, 1e-12);
    EXPECT_LE(edge.curvature_jump, 1e-11);
    EXPECT_GT(edge.curvature, 0.1);
    EXPECT_LE(edge.direction_jump, 1e-9);
}

TEST(EdgeSmoothness, DirectionsJumpByTheAngleBetweenThem) {
    // Graphs z = (k x^2 + 2 m x y + l y^2) / 2 that meet along x = 0: m and l agree there, k jumps.
    const auto half = [](double side, double k, double m, double l) {
        SimilarityTransform shift;
        shift.translation = Vector3(side, 0, 0);
        return support::transformed(support::graph_patch(2, 2,
                                                         [&](double x, double y) {
                                                             const double at = x + side;
                                                             return (k * at * at + 2 * m * at * y + l * y * y) / 2;
                                                         }),
                                    shift);
    };
    for (const auto& [k, m] : {std::pair{3.0, 0.0}, {0.5, 0.0}, {3.0, 0.4}, {-2.0, 0.7}}) {
        // Nearly flat, so that the frames of the edge are those of the plane. kappa = -II.
        constexpr double flat = 1e-3;
        const auto angle = [&](double kx) { return 0.5 * std::atan2(-2 * m, -(kx - 1)); };
        const double expected = std::abs(std::remainder(angle(k) - angle(2), std::numbers::pi));
        for (const NurbsSurface& other :
             {half(1, k * flat, m * flat, flat), half(1, k * flat, m * flat, flat).swapped(),
              half(1, k * flat, m * flat, flat).u_reversed()}) {
            const EdgeSmoothness edge = of_shared_edge({half(-1, 2 * flat, m * flat, flat), other});
            EXPECT_NEAR(edge.direction_jump, expected, 1e-5) << k << ' ' << m;
            EXPECT_LE(edge.bend, 1e-12);
        }
    }
}

Face face_of(const NurbsSurface& surface) {
    return support::model_of({surface}).faces.front();
}

TEST(KnotSmoothness, ShapesCanBeSmootherThanTheirKnots) {
    for (const NurbsSurface& surface : {support::full_torus(3, 1), support::ellipsoid_octant(3, 2, 1).swapped()}) {
        const EdgeSmoothness knots = knot_smoothness(face_of(surface));
        EXPECT_LE(knots.bend, 1e-12);
        EXPECT_LE(knots.curvature_jump, 1e-11);
        EXPECT_LE(knots.direction_jump, 1e-9);
    }
    EXPECT_GT(knot_smoothness(face_of(support::full_torus(3, 1))).samples, 0);
    EXPECT_EQ(knot_smoothness(face_of(support::smooth_bicubic(8, 1))).samples, 0);
}

TEST(KnotSmoothness, BiquadraticsJumpAndPolygonsBend) {
    const NurbsSurface biquadratic = support::random_surface(2, 2, 6, 6, 1, 0.1);
    const EdgeSmoothness jumping = knot_smoothness(face_of(biquadratic));
    EXPECT_LE(jumping.bend, 1e-12);
    EXPECT_GT(jumping.curvature_jump, 0.1);
    EXPECT_GT(jumping.direction_jump, 0.1);
    const EdgeSmoothness bent = knot_smoothness(face_of(support::random_surface(1, 3, 6, 6, 1, 0.1)));
    EXPECT_GT(bent.bend, 0.01);
}

}  // namespace
}  // namespace umbilic
