// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/curves/stationary_equations.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include <umbilic/bernstein/rounding.h>

namespace umbilic {

namespace {

/// Components x, y, z, w of the control points relative to the given point.
using Net = std::array<MultivariatePolynomial, 4>;

/// Most factors of the distance from a collapsed edge that the equations can contain.
constexpr int maximum_pole_order = 4;

Net relative_net(const BezierPatch& patch, const InputRounding& input, const Vector3& point) {
    Net net;
    const Vector3 shift = point - patch.origin;
    double largest_weight = 0.0;
    for (const Vector4& pole : patch.poles) largest_weight = std::max(largest_weight, pole[3]);
    for (int k = 0; k < 4; ++k) {
        MultivariatePolynomial& x = net[k];
        x.degrees = {patch.u_degree, patch.v_degree};
        double size = 0.0;
        for (const Vector4& pole : patch.poles) {
            const double moved = k < 3 ? shift[k] * pole[3] : 0.0;
            x.coefficients.push_back(pole[k] - moved);
            size = std::max(size, std::abs(pole[k]) + std::abs(moved));
        }
        // The subtraction of the origin, the product and the difference.
        x.error = k < 3 ? patch.position_error + largest_weight * input.position +
                              std::abs(shift[k]) * (patch.weight_error + input.weight) + gamma_bound(4) * size
                        : patch.weight_error + input.weight;
        x.error *= bound_slack;
    }
    return net;
}

/// The rows of one unknown without the last (`first` = 0) or without the first one (1).
MultivariatePolynomial half(const MultivariatePolynomial& x, int unknown, int first) {
    MultivariatePolynomial result;
    result.degrees = x.degrees;
    --result.degrees[unknown];
    result.error = x.error;
    const std::size_t inner = coefficient_count(std::span(x.degrees).subspan(unknown + 1));
    const std::size_t row = inner * (x.degrees[unknown] + 1);
    for (std::size_t start = first * inner; start < x.coefficients.size(); start += row)
        result.coefficients.insert(result.coefficients.end(), x.coefficients.begin() + start,
                                   x.coefficients.begin() + start + row - inner);
    return result;
}

MultivariatePolynomial slope(const Net& net, bool rational, int unknown) {
    const auto component = [&](int k) {
        if (!rational) return net[k] * derivative(net[k], unknown);
        return net[k] * (half(net[3], unknown, 0) * half(net[k], unknown, 1) -
                         half(net[k], unknown, 0) * half(net[3], unknown, 1));
    };
    return component(0) + component(1) + component(2);
}

bool across_u(PatchEdge edge) {
    return edge == PatchEdge::u_low || edge == PatchEdge::u_high;
}

bool high(PatchEdge edge) {
    return edge == PatchEdge::u_high || edge == PatchEdge::v_high;
}

/// Indices, in an array of (p + 1) x (q + 1), of the coefficients on an edge, increasing along it.
std::vector<std::size_t> on_edge(std::span<const int> degrees, PatchEdge edge) {
    const std::size_t p = degrees[0], q = degrees[1];
    std::vector<std::size_t> result;
    if (across_u(edge))
        for (std::size_t j = 0; j <= q; ++j) result.push_back((high(edge) ? p : 0) * (q + 1) + j);
    else
        for (std::size_t i = 0; i <= p; ++i) result.push_back(i * (q + 1) + (high(edge) ? q : 0));
    return result;
}

bool is_collapsed(const Net& net, PatchEdge edge) {
    const std::vector<std::size_t> at = on_edge(net[0].degrees, edge);
    const MultivariatePolynomial& w = net[3];
    for (int k = 0; k < 3; ++k) {
        const MultivariatePolynomial& x = net[k];
        const double bound = 4.0 * (x.error * magnitude(w) + (w.error + unit_roundoff) * magnitude(x));
        for (const std::size_t a : at)
            if (std::abs(x.coefficients[a] * w.coefficients[at[0]] - x.coefficients[at[0]] * w.coefficients[a]) > bound)
                return false;
    }
    return true;
}

/// Divides by the factors that vanish on the edge as far as the coefficients there are 0 within the error; how many.
int divide_by_edge(MultivariatePolynomial& f, PatchEdge edge) {
    const int unknown = across_u(edge) ? 0 : 1;
    int order = 0;
    for (; order < maximum_pole_order && f.degrees[unknown] > 0; ++order) {
        for (const std::size_t a : on_edge(f.degrees, edge))
            if (std::abs(f.coefficients[a]) > f.error) return order;
        const double size = magnitude(f);
        const int degree = f.degrees[unknown];
        f = half(f, unknown, high(edge) ? 0 : 1);
        const std::size_t inner = unknown == 0 ? f.degrees[1] + 1 : 1;
        for (std::size_t a = 0; a < f.coefficients.size(); ++a) {
            const int i = static_cast<int>(a / inner % degree);
            f.coefficients[a] *= static_cast<double>(degree) / (high(edge) ? degree - i : i + 1);
        }
        f.error = degree * (f.error + gamma_bound(2) * size) * bound_slack;
    }
    return order;
}

}  // namespace

StationaryEquations stationary_equations(const BezierPatch& patch, const InputRounding& input, const Vector3& point) {
    const Net net = relative_net(patch, input, point);
    StationaryEquations result;
    for (int unknown = 0; unknown < 2; ++unknown) result.f[unknown] = slope(net, patch.rational, unknown);
    for (const PatchEdge edge : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high}) {
        const int k = static_cast<int>(edge);
        result.collapsed[k] = is_collapsed(net, edge);
        if (!result.collapsed[k]) continue;
        divide_by_edge(result.f[across_u(edge) ? 1 : 0], edge);
        result.stationary_pole[k] = divide_by_edge(result.f[across_u(edge) ? 0 : 1], edge) > 0;
    }
    return result;
}

bool collapsed(const BezierPatch& patch, const InputRounding& input, PatchEdge edge) {
    return is_collapsed(relative_net(patch, input, patch.origin), edge);
}

MultivariatePolynomial stationary_edge_equation(const BezierPatch& patch, const InputRounding& input,
                                                const Vector3& point, PatchEdge edge) {
    Net net = relative_net(patch, input, point);
    const std::vector<std::size_t> at = on_edge(net[0].degrees, edge);
    for (MultivariatePolynomial& x : net) {
        MultivariatePolynomial restriction{{static_cast<int>(at.size()) - 1}, {}, x.error};
        for (const std::size_t a : at) restriction.coefficients.push_back(x.coefficients[a]);
        x = std::move(restriction);
    }
    return slope(net, patch.rational, 0);
}

}  // namespace umbilic
