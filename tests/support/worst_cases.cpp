// SPDX-License-Identifier: LGPL-2.1-or-later
#include <support/worst_cases.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>

#include <support/reparametrisation.h>
#include <support/surfaces.h>

namespace umbilic::support {

namespace {

/// The net of a 20 x 20 bicubic graph with other heights, given the place of the control point.
NurbsSurface graph(const std::function<double(double x, double y, double rough)>& height) {
    const NurbsSurface net = rough_bicubic(20, 4);
    std::vector<Vector3> poles = net.poles();
    for (Vector3& pole : poles) pole.z() = height(pole.x(), pole.y(), pole.z());
    return NurbsSurface(net.u_knots(), net.v_knots(), std::move(poles));
}

/// Developable of the thesis's figure 3-5 as rebuilt: flat points along u = 0.5754.
NurbsSurface developable() {
    const double z[4] = {0.0, 1.0, -0.3770311209, 0.0};
    std::vector<Vector3> poles;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 2; ++j) poles.emplace_back(i / 3.0, j, z[i]);
    return NurbsSurface(KnotVector::bezier(3), KnotVector::bezier(1), std::move(poles));
}

/// Flat points along an oblique line through 35 of 17 x 17 patches: z is cubic in the distance from it, but for a tilt.
NurbsSurface oblique_line() {
    const NurbsSurface patch = graph_patch(3, 3, [](double x, double y) {
        const double distance = 0.8 * x + 0.6 * y - 0.15;
        return distance * distance * distance + 0.1 * x;
    });
    std::vector<double> knots;
    for (int k = 1; k < 17; ++k) knots.push_back(k / 17.0);
    return with_knots(patch, knots, knots).surface;
}

/// All around, with a cubic meridian of eight control points that bulges and narrows.
NurbsSurface vase() {
    const double w = std::numbers::sqrt2 / 2, radius[8] = {0.3, 0.5, 0.9, 1.0, 0.6, 0.35, 0.3, 0.55};
    const double x[9] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[9] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 8; ++j) {
            poles.emplace_back(radius[j] * x[i], radius[j] * y[i], 0.25 * j);
            weights.push_back(i % 2 == 1 ? w : 1.0);
        }
    return NurbsSurface(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}),
                        KnotVector(3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5}), std::move(poles), std::move(weights));
}

/// Control points of a sphere's octant, of degree (3, 3), off by random 1e-9 of its radius.
NurbsSurface almost_sphere() {
    const NurbsSurface sphere = elevated(ellipsoid_octant(1, 1, 1), 1, 1).surface;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> off(-1e-9, 1e-9);
    std::vector<Vector3> poles = sphere.poles();
    // The pole stays one point.
    for (int i = 0; i < sphere.u_pole_count(); ++i)
        for (int j = 0; j + 1 < sphere.v_pole_count(); ++j)
            for (int k = 0; k < 3; ++k) poles[i * sphere.v_pole_count() + j][k] += off(random);
    return NurbsSurface(sphere.u_knots(), sphere.v_knots(), std::move(poles), sphere.weights());
}

/// Umbilics of index -1/2 at the origin and at x = 2/3 gap (1 + O(gap^2)), y = 0. At the second one the terms of first
/// order of the traceless second form cancel across the x axis up to gap^3: |omega| is 1 within about gap^2.
NurbsSurface pair(double gap) {
    return graph_patch(4, 4, [=](double x, double y) { return (x * x + y * y) / 2 + x * y * y * (x - gap); });
}

/// Two generic umbilics just born: z_xy = y and z_xx - z_yy = x (x - gap). A star and one of index 1/2 at x = 0 and
/// x = gap + gap^4 / 4 (1 + O(gap)), y = 0.
NurbsSurface fold(double gap) {
    return graph_patch(
        4, 4, [=](double x, double y) { return x * x * x * x / 12 + (1 - gap) * x * x * x / 6 + x * y * y / 2; });
}

}  // namespace

std::vector<WorstCase> worst_cases() {
    const double dome_radius = 0.3;
    return {
        {"plane_tilted", transformed(smooth_bicubic(20, 1, 0.0), random_similarity(3, 1.0, false, 100.0)),
         Expected::region, 17 * 17},
        {"sphere_octant", ellipsoid_octant(1, 1, 1), Expected::region, 8},
        {"almost_sphere", almost_sphere(), Expected::anything_bounded, 100000, 1e-9},
        {"developable", developable(), Expected::line, 20000},
        {"inflection_line_20x20", graph([](double x, double, double) { return std::pow(x - 0.5754, 3) + 0.1 * x; }),
         Expected::line, 40000},
        {"oblique_line_20x20", oblique_line(), Expected::line, 30000},
        {"planar_part_20x20", graph([](double x, double y, double rough) {
             return std::max(std::abs(x - 0.5), std::abs(y - 0.5)) < 0.25 ? 0.0 : rough;
         }),
         Expected::region, 100000},
        {"dome_on_plate", graph([=](double x, double y, double) {
             const double r = std::hypot(x - 0.5, y - 0.5) / dome_radius;
             return r < 1 ? 0.2 * std::pow(1 - r * r, 3) : 0.0;
         }),
         Expected::region, 100000},
        {"vase", vase(), Expected::line, 200000},
        {"fold_1e_3", fold(1e-3), Expected::resolved, 2000},
        {"fold_1e_6", fold(1e-6), Expected::resolved_or_index, 2000},
        {"pair_1e_3", pair(1e-3), Expected::resolved_or_index, 20000},
        {"pair_1e_6", pair(1e-6), Expected::resolved_or_index, 20000},
        {"omega_one", pair(0.0), Expected::resolved_or_index, 20000},
        {"circle_of_flat_points",
         graph_patch(6, 6, [](double x, double y) { return std::pow(x * x + y * y - 0.25, 3); }), Expected::line,
         200000},
        {"noise_on_plane", graph([](double, double, double rough) { return 1e-12 * rough; }),
         Expected::anything_bounded, 100000},
    };
}

}  // namespace umbilic::support
