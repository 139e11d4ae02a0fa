// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include <umbilic/umbilics/equations.h>

namespace umbilic {

namespace {

/// factor * polynomial, a power of two: exact.
TensorPolynomial multiplied(TensorPolynomial polynomial, double factor) {
    for (double& value : polynomial.scaled) value *= factor;
    for (double& error : polynomial.errors) error *= std::abs(factor);
    polynomial.magnitude *= std::abs(factor);
    polynomial.bound = {polynomial.bound.rounding * std::abs(factor), polynomial.bound.input * std::abs(factor)};
    return polynomial;
}

/// Divides by the `power`-th power of the distance from an edge; false, and nothing is changed, if the polynomial does
/// not vanish there to that order within the input's rounding.
bool divided(const TensorPolynomial& polynomial, PatchEdge edge, int power, TensorPolynomial& result, bool& exact) {
    result = polynomial;
    const bool across_u = edge == PatchEdge::u_low || edge == PatchEdge::u_high;
    for (int k = 0; k < power; ++k) {
        const double left = edge_magnitude(result, edge);
        if ((across_u ? result.u_degree : result.v_degree) == 0 || left > result.bound.input) return false;
        exact = exact && left <= result.bound.rounding;
        divide_by_edge(result, edge);
    }
    return true;
}

}  // namespace

void UmbilicEquations::form_normal_square(TensorPolynomial& result) {
    if (rational_) {
        const double p = p_, q = q_;
        // P ^ P_u = p P0 ^ P1 with the halves of the net; its components with w are u_.
        Vector3Polynomial low, high, across, minor;
        TensorPolynomial weight_v;
        for (int k = 0; k < 3; ++k) {
            sub_net(k, 0, 1, 0, 0, 1.0, low[k]);
            sub_net(k, 1, 1, 0, 0, p, high[k]);
            difference(k, 0, 1, q, across[k]);
        }
        difference(3, 0, 1, q, weight_v);
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            const ProductTerm minor_terms[] = {{&low[i], &high[j]}, {&low[j], &high[i], -1.0}};
            sum_of_products(minor_terms, minor[k]);
            const ProductTerm terms[] = {{&u_[i], &across[j]}, {&u_[j], &across[i], -1.0}, {&minor[k], &weight_v}};
            sum_of_products(terms, normal_[k]);
        }
    }
    const ProductTerm square[] = {{&normal_[0], &normal_[0]}, {&normal_[1], &normal_[1]}, {&normal_[2], &normal_[2]}};
    sum_of_products(square, result);
}

void UmbilicEquations::form_curvature(CurvatureEquations& result) {
    result.rational = rational_;
    result.exact = true;
    form_normal_square(result.t);
    const ProductTerm determinant[] = {{&l_, &n_}, {&m_, &m_, -1.0}};
    sum_of_unequal_products(determinant, result.q);
    // The rational l, m, n are those of the opposite normal.
    const double sign = rational_ ? -1.0 : 1.0;
    const TensorPolynomial twice_f = multiplied(f_, 2.0);
    const ProductTerm trace[] = {{&e_, &n_, sign}, {&g_, &l_, sign}, {&twice_f, &m_, -sign}};
    sum_of_unequal_products(trace, result.s);
    if (rational_)
        sub_net(3, 0, 0, 0, 0, 1.0, result.w);
    else
        result.w.set_zero(0, 0);

    for (const PatchEdge edge : {PatchEdge::u_low, PatchEdge::u_high, PatchEdge::v_low, PatchEdge::v_high}) {
        if (!singular(edge)) continue;
        bool exact = true;
        TensorPolynomial q, s, t;
        if (!divided(result.q, edge, 4, q, exact) || !divided(result.s, edge, 3, s, exact) ||
            !divided(result.t, edge, 2, t, exact))
            continue;
        result.q = std::move(q);
        result.s = std::move(s);
        result.t = std::move(t);
        result.exact = result.exact && exact;
    }
    TensorPolynomial* const all[] = {&result.q, &result.s, &result.t, &result.w};
    raise_to_common_degree(std::span<TensorPolynomial* const>(all, rational_ ? 4 : 3));
}

}  // namespace umbilic
