// SPDX-License-Identifier: LGPL-2.1-or-later
#include <support/swept_surfaces.h>

#include <cmath>
#include <numbers>

namespace umbilic::support {

Profile arc(const Vector2& centre, double radius, double from, double to) {
    const int arcs = static_cast<int>(std::ceil((to - from) / (std::numbers::pi / 2) - 1e-12));
    const double half = (to - from) / (2 * arcs);
    std::vector<double> knots(3, 0.0);
    for (int k = 1; k < arcs; ++k) knots.insert(knots.end(), 2, static_cast<double>(k));
    knots.insert(knots.end(), 3, static_cast<double>(arcs));
    std::vector<Vector2> poles;
    std::vector<double> weights;
    for (int k = 0; k <= 2 * arcs; ++k) {
        const double reach = k % 2 == 0 ? 1.0 : 1.0 / std::cos(half), angle = from + k * half;
        poles.push_back(centre + radius * reach * Vector2(std::cos(angle), std::sin(angle)));
        weights.push_back(k % 2 == 0 ? 1.0 : std::cos(half));
    }
    return {KnotVector(2, knots), poles, weights};
}

Profile segment(const Vector2& from, const Vector2& to) {
    return {KnotVector::bezier(1), {from, to}, {1.0, 1.0}};
}

Profile spline(int degree, std::vector<Vector2> poles) {
    std::vector<double> knots(degree + 1, 0.0);
    const int spans = static_cast<int>(poles.size()) - degree;
    for (int k = 1; k < spans; ++k) knots.push_back(static_cast<double>(k) / spans);
    knots.insert(knots.end(), degree + 1, 1.0);
    std::vector<double> weights(poles.size(), 1.0);
    return {KnotVector(degree, knots), std::move(poles), std::move(weights)};
}

NurbsSurface revolved(const Profile& profile, double angle) {
    const Profile around = arc(Vector2::Zero(), 1.0, 0.0, angle);
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (std::size_t i = 0; i < around.poles.size(); ++i)
        for (std::size_t j = 0; j < profile.poles.size(); ++j) {
            const Vector2 flat = profile.poles[j].x() * around.poles[i];
            poles.emplace_back(flat.x(), flat.y(), profile.poles[j].y());
            weights.push_back(around.weights[i] * profile.weights[j]);
        }
    return NurbsSurface(around.knots, profile.knots, std::move(poles), std::move(weights));
}

NurbsSurface extruded(const Profile& profile, double height) {
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (std::size_t i = 0; i < profile.poles.size(); ++i)
        for (const double z : {0.0, height}) {
            poles.emplace_back(profile.poles[i].x(), profile.poles[i].y(), z);
            weights.push_back(profile.weights[i]);
        }
    return NurbsSurface(profile.knots, KnotVector::bezier(1), std::move(poles), std::move(weights));
}

}  // namespace umbilic::support
