// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/characterise.h>

#include <algorithm>
#include <cmath>

#include <umbilic/bernstein/rounding.h>
#include <umbilic/differential/fundamental_forms.h>

namespace umbilic {

namespace {

double place(const ParameterInterval& interval, double local) {
    return interval.low + local * interval.length();
}

/// Rounding of a parameter formed from a local one, absolute.
double parameter_rounding(const ParameterInterval& interval) {
    return 4 * unit_roundoff * (std::abs(interval.low) + std::abs(interval.high));
}

/// Bound on the error of the normal curvature: the input's rounding seen by the second derivatives (a difference of
/// order 2 of control points multiplies it by at most 4), that of the first, and the way to the true umbilic.
double curvature_error(const NurbsSurface& surface, const BezierPatch& patch, const InputRounding& input,
                       const SurfaceDerivatives& d, const Umbilic& umbilic, double distance) {
    const double p = surface.u_degree(), q = surface.v_degree();
    const double du = patch.domain.u.length(), dv = patch.domain.v.length();
    double lightest = 1.0, heaviest = 1.0;
    if (patch.rational) {
        lightest = heaviest = patch.poles[0][3];
        for (const Vector4& pole : patch.poles) {
            lightest = std::min(lightest, pole[3]);
            heaviest = std::max(heaviest, pole[3]);
        }
    }
    // Evaluation sums (p + 1)(q + 1) products of rounded numbers.
    const double terms = 2 * (p + q) + 4;
    const double position = terms * input.position * heaviest / lightest;
    const auto [E, F, G] = first_form(d);
    const double determinant = E * G - F * F;
    const double second =
        4 * position *
        (p * (p - 1) / (du * du) * G + 2 * p * q / (du * dv) * std::abs(F) + q * (q - 1) / (dv * dv) * E) /
        (2 * determinant);
    const double first = 4 * position * std::abs(umbilic.kappa) * (p / du / std::sqrt(E) + q / dv / std::sqrt(G)) *
                         std::sqrt(E * G / determinant);
    return second + first + distance * std::sqrt(umbilic.cubic.squared_norm());
}

}  // namespace

std::optional<Umbilic> characterise(const NurbsSurface& surface, const BezierPatch& patch, const IsolatedZero& zero,
                                    const InputRounding& input, double generic_margin) {
    const ParameterBox& domain = patch.domain;
    const ParameterBox whole = surface.domain();
    Umbilic result;
    result.at.u = domain.u.clamp(place(domain.u, zero.at.x()));
    result.at.v = domain.v.clamp(place(domain.v, zero.at.y()));
    const Side u_side = result.at.u >= domain.u.high ? Side::left : Side::right;
    const Side v_side = result.at.v >= domain.v.high ? Side::left : Side::right;
    const SurfaceDerivatives d = surface.derivatives(result.at.u, result.at.v, 3, u_side, v_side);
    if (!regular(d)) return std::nullopt;

    result.point = d.r();
    const MongeForm monge = monge_form(d);
    result.normal = monge.normal;
    result.x_axis = monge.x;
    result.cubic = monge.cubic;
    const auto [E, F, G] = first_form(d);
    const auto [L, M, N] = second_form(d);
    result.kappa = -(E * N + G * L - 2 * F * M) / (2 * (E * G - F * F));
    result.kind = classify(monge.cubic, generic_margin);
    result.index = 0.5 * zero.sign;
    for (const double angle : result.kind.angles)
        result.directions.push_back(std::cos(angle) * monge.x + std::sin(angle) * monge.y);

    // A zero outside the patch by less than its radius is moved onto the edge, by no more than the radius again.
    const double u_radius = (zero.radius.x() * domain.u.length() + parameter_rounding(domain.u)) * bound_slack;
    const double v_radius = (zero.radius.y() * domain.v.length() + parameter_rounding(domain.v)) * bound_slack;
    const double u_moved = std::max({0.0, zero.at.x() - 1.0, -zero.at.x()}) * domain.u.length();
    const double v_moved = std::max({0.0, zero.at.y() - 1.0, -zero.at.y()}) * domain.v.length();
    result.radius = std::max((u_radius + u_moved) / whole.u.length(), (v_radius + v_moved) / whole.v.length());
    result.box = {{place(domain.u, zero.box.u.low), place(domain.u, zero.box.u.high)},
                  {place(domain.v, zero.box.v.low), place(domain.v, zero.box.v.high)}};
    result.certified = true;
    const double distance = (u_radius + u_moved) * std::sqrt(E) + (v_radius + v_moved) * std::sqrt(G);
    result.flat = std::abs(result.kappa) <= curvature_error(surface, patch, input, d, result, distance);
    return result;
}

}  // namespace umbilic
