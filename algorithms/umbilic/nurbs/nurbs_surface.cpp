// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/nurbs/nurbs_surface.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include <umbilic/core/errors.h>
#include <umbilic/nurbs/tabulated_evaluation.h>

namespace umbilic {

namespace {

constexpr int order_count = maximum_derivative + 1;
constexpr std::array<std::array<double, order_count>, order_count> binomial = {
    {{1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}}};

/// Evaluates by the tables of the knot vectors, if there are any for this surface and order.
template <typename Use>
bool evaluate_tabulated(const NurbsSurface& surface, int order, const Use& use) {
    switch (order) {
        case 0:
            return with_tabulated_evaluation<0>(surface, use);
        case 1:
            return with_tabulated_evaluation<1>(surface, use);
        case 2:
            return with_tabulated_evaluation<2>(surface, use);
        default:
            return false;
    }
}

std::vector<double> reversed_knots(const KnotVector& knots) {
    const double sum = knots.domain().low + knots.domain().high;
    std::vector<double> result;
    for (auto knot = knots.knots().rbegin(); knot != knots.knots().rend(); ++knot) result.push_back(sum - *knot);
    return result;
}

}  // namespace

NurbsSurface::NurbsSurface(KnotVector u_knots, KnotVector v_knots, std::vector<Vector3> poles,
                           std::vector<double> weights)
    : u_knots_(std::move(u_knots)),
      v_knots_(std::move(v_knots)),
      poles_(std::move(poles)),
      weights_(std::move(weights)) {
    const auto expected = static_cast<std::size_t>(u_pole_count()) * static_cast<std::size_t>(v_pole_count());
    if (poles_.size() != expected)
        throw InvalidInput("NURBS surface: " + std::to_string(poles_.size()) + " poles where the knots ask for " +
                           std::to_string(u_pole_count()) + " x " + std::to_string(v_pole_count()));
    for (std::size_t i = 0; i < poles_.size(); ++i)
        if (!poles_[i].allFinite()) throw InvalidInput("NURBS surface: pole " + std::to_string(i) + " is not finite");
    if (!weights_.empty() && weights_.size() != expected)
        throw InvalidInput("NURBS surface: " + std::to_string(weights_.size()) + " weights for " +
                           std::to_string(expected) + " poles");
    for (std::size_t i = 0; i < weights_.size(); ++i)
        if (!std::isfinite(weights_[i]) || weights_[i] <= 0.0)
            throw InvalidInput("NURBS surface: weight " + std::to_string(i) + " is " + std::to_string(weights_[i]) +
                               "; weights must be positive");
    if (std::adjacent_find(weights_.begin(), weights_.end(), std::not_equal_to<>()) == weights_.end()) weights_.clear();
}

BoundingBox NurbsSurface::pole_box() const {
    BoundingBox box;
    for (const Vector3& pole : poles_) box.add(pole);
    return box;
}

Vector3 NurbsSurface::value(double u, double v) const {
    return derivatives(u, v, 0).r();
}

SurfaceDerivatives NurbsSurface::derivatives(double u, double v, int order, Side u_side, Side v_side) const {
    assert(0 <= order && order <= maximum_derivative);
    SurfaceDerivatives result;
    if (u_side == Side::right && v_side == Side::right &&
        evaluate_tabulated(*this, order, [&](auto evaluation) { evaluation.point(*this, u, v, result); }))
        return result;
    return span_derivatives(u_knots_.span(u, u_side), v_knots_.span(v, v_side), u, v, order);
}

SurfaceDerivatives NurbsSurface::piece_derivatives(int u_piece, int v_piece, double u, double v, int order) const {
    assert(0 <= order && order <= maximum_derivative);
    SurfaceDerivatives result;
    if (evaluate_tabulated(*this, order,
                           [&](auto evaluation) { evaluation.point(*this, u_piece, v_piece, u, v, result); }))
        return result;
    return span_derivatives(u_knots_.piece_span(u_piece), v_knots_.piece_span(v_piece), u, v, order);
}

SurfaceDerivatives NurbsSurface::span_derivatives(int u_span, int v_span, double u, double v, int order) const {
    SurfaceDerivatives result;
    const int p = u_degree(), q = v_degree();
    std::array<double, order_count*(maximum_degree + 1)> u_basis, v_basis;
    u_knots_.basis(u_span, u, order, u_basis.data());
    v_knots_.basis(v_span, v, order, v_basis.data());

    // Homogeneous derivatives: sums over v first, then over u.
    std::array<std::array<Vector4, order_count>, order_count> homogeneous;
    for (auto& row : homogeneous) row.fill(Vector4::Zero());
    for (int i = 0; i <= p; ++i) {
        const int start = (u_span - p + i) * v_pole_count() + v_span - q;
        std::array<Vector4, order_count> row;
        row.fill(Vector4::Zero());
        for (int j = 0; j <= q; ++j) {
            const double w = weights_.empty() ? 1.0 : weights_[start + j];
            Vector4 point;
            point << w * poles_[start + j], w;
            for (int l = 0; l <= order; ++l) row[l] += v_basis[l * (q + 1) + j] * point;
        }
        for (int k = 0; k <= order; ++k)
            for (int l = 0; l <= order - k; ++l) homogeneous[k][l] += u_basis[k * (p + 1) + i] * row[l];
    }

    result.order = order;
    for (int n = 0; n <= order; ++n)
        for (int l = 0; l <= n; ++l) {
            const int k = n - l;
            Vector3 value = homogeneous[k][l].head<3>();
            if (rational()) {
                for (int i = 0; i <= k; ++i)
                    for (int j = 0; j <= l; ++j)
                        if (i + j > 0)
                            value -= binomial[k][i] * binomial[l][j] * homogeneous[i][j][3] * result(k - i, l - j);
                value /= homogeneous[0][0][3];
            }
            result(k, l) = value;
        }
    return result;
}

void NurbsSurface::derivatives(std::span<const Vector2> parameters, int order,
                               std::span<SurfaceDerivatives> result) const {
    assert(parameters.size() == result.size());
    if (evaluate_tabulated(*this, order, [&](auto evaluation) { evaluation.points(*this, parameters, result); }))
        return;
    for (std::size_t i = 0; i < parameters.size(); ++i)
        result[i] = derivatives(parameters[i].x(), parameters[i].y(), order);
}

NurbsSurface NurbsSurface::swapped() const {
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int j = 0; j < v_pole_count(); ++j)
        for (int i = 0; i < u_pole_count(); ++i) {
            poles.push_back(pole(i, j));
            if (rational()) weights.push_back(weight(i, j));
        }
    return NurbsSurface(v_knots_, u_knots_, std::move(poles), std::move(weights));
}

NurbsSurface NurbsSurface::u_reversed() const {
    std::vector<Vector3> poles;
    std::vector<double> weights;
    for (int i = u_pole_count() - 1; i >= 0; --i)
        for (int j = 0; j < v_pole_count(); ++j) {
            poles.push_back(pole(i, j));
            if (rational()) weights.push_back(weight(i, j));
        }
    return NurbsSurface(KnotVector(u_degree(), reversed_knots(u_knots_)), v_knots_, std::move(poles),
                        std::move(weights));
}

}  // namespace umbilic
