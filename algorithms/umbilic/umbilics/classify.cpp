// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/umbilic.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace umbilic {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

/// Roots in [0, pi) of h(t) = Im(alpha e^{3it} + conj(beta) e^{it}), the derivative of the cubic form along the unit
/// circle up to a factor; `count` (1 or 3) comes from the discriminant.
std::vector<double> extremal_angles(Complex alpha, Complex beta, int count) {
    const auto value = [&](double t) {
        return std::imag(alpha * std::polar(1.0, 3 * t) + std::conj(beta) * std::polar(1.0, t));
    };
    const auto slope = [&](double t) {
        return std::real(3.0 * alpha * std::polar(1.0, 3 * t) + std::conj(beta) * std::polar(1.0, t));
    };
    // In t, e^{-3it} h is a cubic in the tangent. Its frame is turned so that the leading coefficient is the largest of
    // four; then the roots are finite and moderate.
    double turn = 0.0, greatest = -1.0;
    for (int k = 0; k < 4; ++k)
        if (const double size = std::abs(value(k * pi / 4 + pi / 2)); size > greatest) {
            greatest = size;
            turn = k * pi / 4;
        }
    const Complex a = alpha * std::polar(1.0, 3 * turn), b = std::conj(beta) * std::polar(1.0, turn);
    // h = Im(a (x + i y)^3 + b (x + i y)(x^2 + y^2)) with x = 1, y = tan(t - turn).
    const double c3 = b.real() - a.real(), c2 = b.imag() - 3 * a.imag();
    const double c1 = b.real() + 3 * a.real(), c0 = b.imag() + a.imag();
    const double shift = c2 / (3 * c3);
    const double p = c1 / (3 * c3) - shift * shift;
    const double q = shift * shift * shift - shift * c1 / (2 * c3) + c0 / (2 * c3);
    std::vector<double> roots;
    if (count == 3) {
        const double radius = std::sqrt(std::max(0.0, -p));
        const double cosine = radius > 0.0 ? std::clamp(-q / (radius * radius * radius), -1.0, 1.0) : 0.0;
        for (int k = 0; k < 3; ++k)
            roots.push_back(2 * radius * std::cos((std::acos(cosine) + 2 * pi * k) / 3) - shift);
    } else {
        const double root = std::sqrt(std::max(0.0, q * q + p * p * p));
        const double first = std::cbrt(q > 0.0 ? -q - root : -q + root);
        roots.push_back(first - (first != 0.0 ? p / first : 0.0) - shift);
    }
    std::vector<double> angles;
    for (const double root : roots) {
        double t = std::atan(root) + turn;
        // Two Newton steps bring the closed formula to full accuracy; a step larger than its error is not taken.
        for (int step = 0; step < 2; ++step) {
            const double s = slope(t);
            const double change = s != 0.0 ? value(t) / s : 0.0;
            if (std::abs(change) < 1.0 / 64) t -= change;
        }
        t = std::fmod(t, pi);
        if (t < 0.0) t += pi;
        if (t >= pi) t -= pi;
        angles.push_back(t);
    }
    std::sort(angles.begin(), angles.end());
    return angles;
}

/// beta alpha^{-1/3} conj(alpha)^{-2/3}, of its three values the one with argument in [-pi/3, pi/3).
Complex omega_representative(Complex alpha, Complex beta) {
    const double third = 2 * pi / 3;
    double argument = std::arg(beta) + std::arg(alpha) / 3;
    argument -= third * std::floor((argument + pi / 3) / third);
    if (argument >= pi / 3) argument -= third;
    return std::polar(std::abs(beta) / std::abs(alpha), argument);
}

}  // namespace

UmbilicClass classify(const Cubic& cubic, double margin) {
    UmbilicClass result;
    // C = alpha z^3 + 3 conj(beta) z^2 conj(z) + conjugates, z = x + i y.
    result.alpha = {(cubic.a - 3 * cubic.c) / 8, (cubic.d - 3 * cubic.b) / 8};
    result.beta = {(cubic.a + cubic.c) / 8, (cubic.b + cubic.d) / 8};
    const double size = std::hypot(std::abs(result.alpha), std::abs(result.beta));
    if (!(size > 0.0)) return result;
    const Complex alpha = result.alpha / size, beta = result.beta / size;
    const double aa = std::norm(alpha), bb = std::norm(beta);
    result.delta = aa - bb;
    result.zeta = alpha * beta * beta * beta;
    if (std::abs(alpha) > margin * std::abs(beta)) result.omega = omega_representative(alpha, beta);

    // Discriminants of C (Gamma_1) and of the cubic of its extremal directions (Gamma_2), up to positive factors.
    const double gamma1 = aa * aa - 6 * aa * bb + 8 * result.zeta.real() - 3 * bb * bb;
    const double gamma2 = aa * aa - (18 * aa * bb + 8 * result.zeta.real() + bb * bb) / 27;
    const bool star = result.delta > 0.0;
    result.angles = extremal_angles(alpha, beta, star || gamma2 > 0.0 ? 3 : 1);
    if (std::abs(result.delta) <= margin || std::abs(star ? gamma1 : gamma2) <= margin) return result;
    result.type = star ? UmbilicType::star : gamma2 > 0.0 ? UmbilicType::monstar : UmbilicType::lemon;
    if (star) result.star = gamma1 > 0.0 ? StarKind::elliptic : StarKind::hyperbolic;
    return result;
}

const char* name(UmbilicType type) {
    switch (type) {
        case UmbilicType::star:
            return "star";
        case UmbilicType::monstar:
            return "monstar";
        case UmbilicType::lemon:
            return "lemon";
        case UmbilicType::non_generic:
            return "non-generic";
    }
    return "non-generic";
}

const char* name(StarKind kind) {
    switch (kind) {
        case StarKind::none:
            return "none";
        case StarKind::elliptic:
            return "elliptic";
        case StarKind::hyperbolic:
            return "hyperbolic";
    }
    return "none";
}

const char* name(UmbilicRegionKind kind) {
    switch (kind) {
        case UmbilicRegionKind::planar:
            return "planar";
        case UmbilicRegionKind::spherical:
            return "spherical";
        case UmbilicRegionKind::other:
            return "other";
    }
    return "other";
}

}  // namespace umbilic
