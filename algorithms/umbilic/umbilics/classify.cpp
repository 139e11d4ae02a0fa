// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/umbilic.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

/// A form scaled to norm 1 as a point of the unit sphere of C^2: (p, s) proportional to (alpha, sqrt(3) beta), whose
/// length is that of the cubic form. `size` is that length where |alpha|^2 + |beta|^2 = 1.
struct Form {
    Complex p, s;
    double size = 1.0;
};

Form normalised(Complex alpha, Complex beta) {
    const double size = std::hypot(std::abs(alpha), std::sqrt(3.0) * std::abs(beta));
    return {alpha / size, std::sqrt(3.0) * beta / size, size};
}

/// A polynomial of the form whose sign tells two types apart, with a bound on its change: at distance t from the form
/// it differs by at most polynomial(t) = c_1 t + ... + c_4 t^4. For a homogeneous polynomial of degree n whose absolute
/// value on the unit sphere is at most 1 Banach's theorem on symmetric multilinear forms gives c_k <= binomial(n, k);
/// c_1 is the length of the gradient.
struct Discriminant {
    double value = 0.0;
    std::array<double, 4> change{};

    double change_within(double t) const { return t * (change[0] + t * (change[1] + t * (change[2] + t * change[3]))); }
    bool may_be_positive(double error) const { return value + change_within(error) >= 0.0; }
    bool may_be_negative(double error) const { return value - change_within(error) <= 0.0; }
    bool decided(double error) const { return !(may_be_positive(error) && may_be_negative(error)); }

    /// Distance from the form up to which the sign cannot change, at most 1.
    double reach() const {
        const double size = std::abs(value);
        if (change_within(1.0) < size) return 1.0;
        // The change is convex in t, so Newton's method comes down to its root from 1.
        double t = 1.0;
        for (int step = 0; step < reach_steps; ++step) {
            const double slope = change[0] + t * (2 * change[1] + t * (3 * change[2] + t * 4 * change[3]));
            const double next = t - (change_within(t) - size) / slope;
            if (!(next < t)) break;
            t = next;
        }
        return std::max(0.0, t * (1.0 - reach_rounding));
    }

    /// Steps from 1 to any root that is no rounding error: each one halves it at least until the change is linear.
    static constexpr int reach_steps = 2 * std::numeric_limits<double>::digits;
    static constexpr double reach_rounding = 1e-12;
};

/// |alpha|^2 - |beta|^2.
Discriminant unit_circle(const Form& form) {
    const double pp = std::norm(form.p), ss = std::norm(form.s);
    return {pp - ss / 3, {2 * std::sqrt(pp + ss / 9), 1.0, 0.0, 0.0}};
}

/// k_0 |p|^4 + k_1 |p|^2 |s|^2 + k_2 Re(p s^3) + k_3 |s|^4, at most 1 on the unit sphere.
Discriminant quartic(const Form& form, double k0, double k1, double k2, double k3) {
    const Complex p = form.p, s = form.s;
    const double pp = std::norm(p), ss = std::norm(s);
    const Complex by_p = (4 * k0 * pp + 2 * k1 * ss) * p + k2 * std::conj(s * s * s);
    const Complex by_s = (4 * k3 * ss + 2 * k1 * pp) * s + 3 * k2 * std::conj(p * s * s);
    return {k0 * pp * pp + k1 * pp * ss + k2 * std::real(p * s * s * s) + k3 * ss * ss,
            {std::hypot(std::abs(by_p), std::abs(by_s)), 6.0, 4.0, 1.0}};
}

/// Discriminant of C, |alpha|^4 - 6 |alpha|^2 |beta|^2 + 8 Re(alpha beta^3) - 3 |beta|^4: positive inside Gamma_1.
Discriminant gamma_1(const Form& form) {
    return quartic(form, 1.0, -2.0, 8 / (3 * std::sqrt(3.0)), -1.0 / 3);
}

/// Discriminant of the cubic of its extremal directions, |alpha|^4 - (18 |alpha|^2 |beta|^2 + 8 Re(alpha beta^3) +
/// |beta|^4) / 27: positive inside Gamma_2.
Discriminant gamma_2(const Form& form) {
    return quartic(form, 1.0, -2.0 / 9, -8 / (81 * std::sqrt(3.0)), -1.0 / 243);
}

/// Greatest |zeta|, at |beta|^2 = 3 |alpha|^2, and greatest change of zeta per radian on the sphere |alpha|^2 +
/// |beta|^2 = 1, at the same place.
constexpr double greatest_zeta = 3 * std::numbers::sqrt3 / 16, zeta_slope = 3 * std::numbers::sqrt3 / 4;

/// For |alpha|^2 + |beta|^2 = 1 and an error of the form of `error` times `size`.
ClassUncertainty uncertainty(Complex alpha, Complex beta, double size, double error) {
    ClassUncertainty result;
    const double moved = error * size;
    const double angle = moved < 1.0 ? std::asin(moved) : std::numbers::pi;
    // delta is the cosine of twice the angle from beta = 0.
    result.delta = std::min(2.0, 2 * angle);
    result.zeta = std::min(2 * greatest_zeta, zeta_slope * angle);
    const double omega = std::abs(beta) / std::abs(alpha);
    if (moved < std::abs(alpha)) result.omega = (moved / std::sqrt(3.0) + omega * moved) / (std::abs(alpha) - moved);
    return result;
}

}  // namespace

UmbilicClass classify(const Cubic& cubic, double relative_error) {
    UmbilicClass result;
    // C = alpha z^3 + 3 conj(beta) z^2 conj(z) + conjugates, z = x + i y.
    result.alpha = {(cubic.a - 3 * cubic.c) / 8, (cubic.d - 3 * cubic.b) / 8};
    result.beta = {(cubic.a + cubic.c) / 8, (cubic.b + cubic.d) / 8};
    const double size = std::hypot(std::abs(result.alpha), std::abs(result.beta));
    if (!(size > 0.0)) {
        result.neighbours = {GenericType::elliptic_star, GenericType::hyperbolic_star, GenericType::monstar,
                             GenericType::lemon};
        result.uncertainty = {2.0, 2.0 * greatest_zeta, std::nullopt};
        return result;
    }
    const Complex alpha = result.alpha / size, beta = result.beta / size;
    result.delta = std::norm(alpha) - std::norm(beta);
    result.zeta = alpha * beta * beta * beta;

    const Form form = normalised(alpha, beta);
    const double error = std::min(relative_error, 1.0);
    const Discriminant circle = unit_circle(form), gamma1 = gamma_1(form), gamma2 = gamma_2(form);
    const bool inside = circle.value > 0.0;
    const Discriminant& inner = inside ? gamma1 : gamma2;
    result.angles = extremal_angles(alpha, beta, inside || gamma2.value > 0.0 ? 3 : 1);
    result.margin = std::min(circle.reach(), inner.reach());
    if (gamma1.decided(error)) result.ridges = gamma1.value > 0.0 ? 3 : 1;

    std::vector<GenericType> possible;
    if (circle.may_be_positive(error)) {
        if (gamma1.may_be_positive(error)) possible.push_back(GenericType::elliptic_star);
        if (gamma1.may_be_negative(error)) possible.push_back(GenericType::hyperbolic_star);
    }
    if (circle.may_be_negative(error)) {
        if (gamma2.may_be_positive(error)) possible.push_back(GenericType::monstar);
        if (gamma2.may_be_negative(error)) possible.push_back(GenericType::lemon);
    }
    if (possible.size() == 1) {
        result.type = type_of(possible.front());
        result.star = star_of(possible.front());
    } else {
        result.neighbours = std::move(possible);
    }

    const double alpha_error = error * form.size;
    if (std::abs(alpha) > alpha_error) result.omega = omega_representative(alpha, beta);
    result.uncertainty = uncertainty(alpha, beta, form.size, error);
    return result;
}

std::vector<GenericType> UmbilicClass::possible_types() const {
    if (const std::optional<GenericType> generic = generic_type(type, star)) return {*generic};
    return neighbours;
}

Cubic cubic_of_omega(Complex omega) {
    return {6 * omega.real() + 2, 2 * omega.imag(), 2 * omega.real() - 2, 6 * omega.imag()};
}

double omega_distance(Complex a, Complex b) {
    double least = std::abs(a - b);
    for (const double turn : {-1.0, 1.0})
        least = std::min(least, std::abs(a - b * std::polar(1.0, turn * 2 * std::numbers::pi / 3)));
    return least;
}

UmbilicType type_of(GenericType type) {
    switch (type) {
        case GenericType::elliptic_star:
        case GenericType::hyperbolic_star:
            return UmbilicType::star;
        case GenericType::monstar:
            return UmbilicType::monstar;
        case GenericType::lemon:
            return UmbilicType::lemon;
    }
    return UmbilicType::non_generic;
}

StarKind star_of(GenericType type) {
    switch (type) {
        case GenericType::elliptic_star:
            return StarKind::elliptic;
        case GenericType::hyperbolic_star:
            return StarKind::hyperbolic;
        default:
            return StarKind::none;
    }
}

std::optional<GenericType> generic_type(UmbilicType type, StarKind star) {
    switch (type) {
        case UmbilicType::star:
            return star == StarKind::elliptic ? GenericType::elliptic_star : GenericType::hyperbolic_star;
        case UmbilicType::monstar:
            return GenericType::monstar;
        case UmbilicType::lemon:
            return GenericType::lemon;
        case UmbilicType::non_generic:
            return std::nullopt;
    }
    return std::nullopt;
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

const char* name(GenericType type) {
    switch (type) {
        case GenericType::elliptic_star:
            return "elliptic star";
        case GenericType::hyperbolic_star:
            return "hyperbolic star";
        case GenericType::monstar:
            return "monstar";
        case GenericType::lemon:
            return "lemon";
    }
    return "non-generic";
}

const char* name(LineEnd end) {
    switch (end) {
        case LineEnd::closed:
            return "closed";
        case LineEnd::border:
            return "border";
        case LineEnd::knot:
            return "knot";
        case LineEnd::singular:
            return "singular";
    }
    return "singular";
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
