// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/foot_point.h>

#include <limits>

#include <Eigen/LU>

#include <umbilic/core/errors.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

namespace {

constexpr int newton_steps = 50;
constexpr double newton_accuracy = 1e-14;

}  // namespace

std::optional<Vector2> foot_point(const NurbsSurface& surface, const Vector3& point, const Vector2& guess) {
    if (!point.allFinite() || !guess.allFinite()) throw InvalidInput("foot point: point and guess must be finite");
    const ParameterBox domain = surface.domain();
    Vector2 x = guess;
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < newton_steps; ++i) {
        const SurfaceDerivatives d = surface.derivatives(x.x(), x.y(), 2);
        if (!regular(d)) return std::nullopt;
        const Vector3 offset = d.r() - point;
        Matrix2 J;
        const double uv = d.r_u().dot(d.r_v()) + offset.dot(d.r_uv());
        J << d.r_u().squaredNorm() + offset.dot(d.r_uu()), uv, uv, d.r_v().squaredNorm() + offset.dot(d.r_vv());
        const Vector2 move = -J.inverse() * Vector2(offset.dot(d.r_u()), offset.dot(d.r_v()));
        if (!move.allFinite()) return std::nullopt;
        const Vector2 next = x + move;
        const Vector2 inside(domain.u.clamp(next.x()), domain.v.clamp(next.y()));
        const double length = (d.r_u() * move.x() + d.r_v() * move.y()).norm();
        const double scale = d.r_u().norm() * domain.u.length() + d.r_v().norm() * domain.v.length();
        x = inside;
        if (length <= newton_accuracy * scale || (length >= before && length <= 1e3 * newton_accuracy * scale)) {
            // A step out of the domain is none that converges.
            return (next - inside).cwiseAbs().maxCoeff() <= 1e3 * newton_accuracy ? std::optional(x) : std::nullopt;
        }
        before = length;
    }
    return std::nullopt;
}

std::vector<StationaryPoint> feet(const Face& face, const Vector3& point, const Progress& progress) {
    std::vector<StationaryPoint> result;
    for (StationaryPoint& found : find_stationary_points(face.surface, point, {}, progress).points) {
        const bool inside = face.region.classify(found.at.u, found.at.v) != Containment::outside;
        if (found.kind != FootKind::interior || !inside) continue;
        found.at.face = face.number;
        result.push_back(found);
    }
    return result;
}

Matrix2 projection_matrix(const SurfaceDerivatives& d, const Vector3& point) {
    const double rho = (d.r() - point).dot(unit_normal(d));
    const auto [E, F, G] = first_form(d);
    const auto [L, M, N] = second_form(d);
    Matrix2 K;
    K << E + rho * L, F + rho * M, F + rho * M, G + rho * N;
    return K;
}

double evolute_margin(const SurfaceDerivatives& d, const Vector3& point) {
    return projection_matrix(d, point).determinant() / first_form(d).determinant();
}

std::optional<Vector2> foot_rates(const SurfaceDerivatives& target, const Vector3& point, const Vector3& velocity,
                                  double sign) {
    if (!regular(target)) return std::nullopt;
    const Matrix2 K = projection_matrix(target, point);
    if (!(sign * K.determinant() > least_evolute_margin * first_form(target).determinant())) return std::nullopt;
    return Vector2(K.inverse() * Vector2(velocity.dot(target.r_u()), velocity.dot(target.r_v())));
}

}  // namespace umbilic
