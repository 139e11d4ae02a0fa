// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curvature_points/dependence.h>

#include <algorithm>
#include <cmath>

#include <umbilic/curvature_points/curvature_gradient.h>
#include <umbilic/differential/fundamental_forms.h>
#include <umbilic/differential/recognise.h>

namespace umbilic {

namespace {

/// The gradients of K and H are parallel if the sine of their angle is below this, gradients below the change of
/// rho^2 and rho (rho the greatest curvature) over the whole surface counting as so large.
constexpr double parallel = 1e-6;
/// K is 0 if it is below this part of rho^2.
constexpr double flat = 1e-9;
/// Points looked at in each polynomial piece and direction, and in each direction at most.
constexpr int points_per_piece = 2, most_points = 64;

std::string on(SurfaceKind kind) {
    const std::string word = kind == SurfaceKind::revolution  ? "surface of revolution"
                             : kind == SurfaceKind::extrusion ? "extrusion"
                                                              : name(kind);
    return std::string("on a") + (word[0] == 'e' ? "n " : " ") + word +
           " Gaussian and mean curvature depend on each other";
}

std::vector<double> parameters(const KnotVector& knots) {
    const std::vector<double>& breaks = knots.breaks();
    const int pieces = static_cast<int>(breaks.size()) - 1;
    std::vector<double> result;
    // Off the middle: symmetric designs are degenerate there.
    constexpr double shares[points_per_piece] = {0.2113, 0.7287};
    const int step = std::max(1, pieces * points_per_piece / most_points);
    for (int k = 0; k < pieces; k += step)
        for (const double share : shares) result.push_back(breaks[k] + share * (breaks[k + 1] - breaks[k]));
    return result;
}

}  // namespace

std::optional<std::string> curvature_dependence(const NurbsSurface& surface, double recognition) {
    if (recognition > 0.0)
        if (const auto recognised = recognise(surface, {.tolerance = recognition})) return on(recognised->kind);
    const double length = surface.pole_box().diagonal();
    if (!(length > 0.0)) return "the surface has no size";
    const std::vector<double> us = parameters(surface.u_knots()), vs = parameters(surface.v_knots());
    double largest_gaussian = 0.0, largest = 0.0;
    for (const double u : us)
        for (const double v : vs) {
            const SurfaceDerivatives d = surface.derivatives(u, v, 3);
            if (!regular(d)) continue;
            const CurvatureGradient c = curvature_gradient(d);
            const double rho = std::sqrt(std::max(0.0, 4 * c.mean * c.mean - 2 * c.gaussian));
            largest = std::max(largest, rho);
            largest_gaussian = std::max(largest_gaussian, std::abs(c.gaussian));
            const double k_slope = c.gaussian_slope.norm() + rho * rho / length;
            const double h_slope = c.mean_slope.norm() + rho / length;
            if (std::abs(c.determinant()) > parallel * k_slope * h_slope) return std::nullopt;
        }
    if (largest_gaussian <= flat * largest * largest)
        return "the surface is developable: its Gaussian curvature is 0 everywhere";
    return "Gaussian and mean curvature depend on each other everywhere on the surface";
}

std::optional<std::string> curvature_dependence(const Face& face, double recognition) {
    if (elementary(face.kind) || face.kind == SurfaceKind::revolution || face.kind == SurfaceKind::extrusion)
        return on(face.kind);
    return curvature_dependence(face.surface, recognition);
}

}  // namespace umbilic
