// SPDX-License-Identifier: LGPL-2.1-or-later
#include "umbilic_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <GeomLProp_SLProps.hxx>
#include <Geom_BSplineSurface.hxx>
#include <gp_Vec.hxx>

namespace umbilic::models {
namespace {

using Complex = std::complex<double>;

constexpr int kNewtonSteps = 40;
constexpr double kNewtonStep = 1e-13;  // of the parameter range: converged
constexpr double kSamePoint = 1e-6;    // of the parameter range: two starts, one umbilic
constexpr double kNoCurvature = 1e-7;  // times 1/size: equal principal curvatures
constexpr double kDegenerate = 1e-9;   // |r_u x r_v| below this share of its largest: a pole
constexpr double kVanishing = 1e-8;    // |alpha| / |beta|; rounding leaves about 1e-12
constexpr int kDiagramSteps = 4000;    // samples of Gamma_1 and Gamma_2

struct Derivatives {
    gp_Pnt p;
    gp_Vec u, v, uu, uv, vv, uuu, uuv, uvv, vvv;
};

Derivatives evaluate(const Surface& surface, double u, double v) {
    Derivatives d;
    surface->D3(u, v, d.p, d.u, d.v, d.uu, d.vv, d.uv, d.uuu, d.vvv, d.uuv, d.uvv);
    return d;
}

// Half difference and mixed part of the second form in the orthonormal frame (r_u, n x r_u):
// both vanish exactly at umbilics.
Complex deviator(const Surface& surface, double u, double v, double& area) {
    gp_Pnt p;
    gp_Vec ru, rv, ruu, rvv, ruv;
    surface->D2(u, v, p, ru, rv, ruu, rvv, ruv);
    gp_Vec n = ru.Crossed(rv);
    area = n.Magnitude();
    if (area == 0) return {1, 0};
    n /= area;
    const double e = ru * ru, f = ru * rv, l = n * ruu, m = n * ruv, q = n * rvv;
    const double h11 = l / e, h12 = (e * m - f * l) / (e * area);
    const double h22 = (q - 2 * f / e * m + f * f / (e * e) * l) * e / (area * area);
    return {(h11 - h22) / 2, h12};
}

// One Newton step for E M - F L = 0, E N - G L = 0, with the normal left unnormalised.
std::optional<std::pair<double, double>> newton_step(const Derivatives& d) {
    const gp_Vec n = d.u.Crossed(d.v);
    const gp_Vec nu = d.uu.Crossed(d.v) + d.u.Crossed(d.uv);
    const gp_Vec nv = d.uv.Crossed(d.v) + d.u.Crossed(d.vv);
    const double e = d.u * d.u, f = d.u * d.v, g = d.v * d.v;
    const double eu = 2 * (d.u * d.uu), ev = 2 * (d.u * d.uv);
    const double fu = d.uu * d.v + d.u * d.uv, fv = d.uv * d.v + d.u * d.vv;
    const double gu = 2 * (d.v * d.uv), gv = 2 * (d.v * d.vv);
    const double l = n * d.uu, m = n * d.uv, q = n * d.vv;
    const double lu = nu * d.uu + n * d.uuu, lv = nv * d.uu + n * d.uuv;
    const double mu = nu * d.uv + n * d.uuv, mv = nv * d.uv + n * d.uvv;
    const double qu = nu * d.vv + n * d.uvv, qv = nv * d.vv + n * d.vvv;
    const double a = e * m - f * l, b = e * q - g * l;
    const double au = eu * m + e * mu - fu * l - f * lu, av = ev * m + e * mv - fv * l - f * lv;
    const double bu = eu * q + e * qu - gu * l - g * lu, bv = ev * q + e * qv - gv * l - g * lv;
    const double determinant = au * bv - av * bu;
    if (determinant == 0 || !std::isfinite(determinant)) return std::nullopt;
    return std::pair{(av * b - bv * a) / determinant, (bu * a - au * b) / determinant};
}

double discriminant(double a, double b, double c, double d) {
    return 18 * a * b * c * d - 4 * b * b * b * d + b * b * c * c - 4 * a * c * c * c - 27 * a * a * d * d;
}

double distance_to_dividing_curves(Complex alpha, Complex beta) {
    if (alpha == 0.0) return std::numeric_limits<double>::infinity();
    // Any cube root will do: the diagram has the threefold symmetry of the choice.
    const Complex omega = beta / (std::pow(alpha, 1.0 / 3) * std::pow(std::conj(alpha), 2.0 / 3));
    double distance = std::abs(std::abs(omega) - 1);
    for (int k = 0; k < kDiagramSteps; ++k) {
        const double t = 2 * std::numbers::pi * k / kDiagramSteps;
        const Complex curve = 2.0 * std::polar(1.0, t) + std::polar(1.0, -2 * t);
        distance = std::min({distance, std::abs(omega - curve / 3.0), std::abs(omega + curve)});
    }
    return distance;
}

double knot_margin(const Surface& surface, double u, double v) {
    const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface);
    if (spline.IsNull()) return 1;
    const auto margin = [](const TColStd_Array1OfReal& knots, double t) {
        double result = 1;
        for (int i = knots.Lower(); i < knots.Upper(); ++i) {
            const double low = knots(i), high = knots(i + 1);
            if (t < low || t > high) continue;
            if (i > knots.Lower()) result = std::min(result, (t - low) / (high - low));
            if (i + 1 < knots.Upper()) result = std::min(result, (high - t) / (high - low));
        }
        return result;
    };
    return std::min(margin(spline->UKnots(), u), margin(spline->VKnots(), v));
}

// The Monge form at a point known to be an umbilic: the covariant derivative of the second form.
Umbilic describe(const Surface& surface, double u, double v) {
    const Derivatives d = evaluate(surface, u, v);
    const gp_Vec first[2] = {d.u, d.v};
    const gp_Vec second[2][2] = {{d.uu, d.uv}, {d.uv, d.vv}};
    const gp_Vec third[4] = {d.uuu, d.uuv, d.uvv, d.vvv};
    const gp_Vec cross = d.u.Crossed(d.v), n = cross.Normalized();
    const double e = d.u * d.u, f = d.u * d.v, g = d.v * d.v, w = e * g - f * f;
    const double curvature = (n * d.uu) / e;
    // At an umbilic II = curvature * I, so II(r_a, tangential part of r_bc) = curvature r_a . r_bc.
    double c[2][2][2];
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            for (int k = 0; k < 2; ++k)
                c[i][j][k] = n * third[i + j + k] -
                             curvature * (first[i] * second[j][k] + first[j] * second[i][k] + first[k] * second[i][j]);
    const gp_Vec x = d.u.Normalized(), y = n.Crossed(x);
    const gp_Vec axes[2] = {x, y};
    double to_frame[2][2];  // components of the axes in the basis (r_u, r_v)
    for (int k = 0; k < 2; ++k) {
        const double s = axes[k] * d.u, t = axes[k] * d.v;
        to_frame[k][0] = (g * s - f * t) / w;
        to_frame[k][1] = (e * t - f * s) / w;
    }
    const auto component = [&](int p, int q, int r) {
        double sum = 0;
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
                for (int k = 0; k < 2; ++k) sum += c[i][j][k] * to_frame[p][i] * to_frame[q][j] * to_frame[r][k];
        return sum;
    };
    Umbilic result;
    result.u = u, result.v = v, result.point = d.p, result.normal = gp_Dir{n};
    result.kappa = -curvature;
    const double a = component(0, 0, 0), b = component(0, 0, 1), cc = component(0, 1, 1), dd = component(1, 1, 1);
    result.cubic = {a, b, cc, dd};
    result.alpha = {(a - 3 * cc) / 8, (dd - 3 * b) / 8};
    result.beta = {(a + cc) / 8, (b + dd) / 8};
    if (std::abs(result.alpha) <= kVanishing * std::abs(result.beta)) result.alpha = 0;
    if (std::abs(result.beta) < std::abs(result.alpha)) {
        result.type = "star";
        result.star = discriminant(a, 3 * b, 3 * cc, dd) > 0 ? "elliptic" : "hyperbolic";
        result.index = -0.5;
    } else {
        // Three lines of curvature run into a monstar, one into a lemon: roots of the Jacobian cubic.
        result.type = discriminant(b, 2 * cc - a, dd - 2 * b, -cc) > 0 ? "monstar" : "lemon";
        result.index = 0.5;
    }
    result.type_margin = distance_to_dividing_curves(result.alpha, result.beta);
    result.knot_margin = knot_margin(surface, u, v);
    return result;
}

double turn(Complex from, Complex to) {
    return std::arg(to * std::conj(from));
}

}  // namespace

std::vector<double> sample_parameters(const Surface& surface, bool along_u, double low, double high,
                                      int cells_per_span) {
    std::vector<double> breaks{low, high};
    if (const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface); !spline.IsNull())
        for (double knot : along_u ? spline->UKnots() : spline->VKnots())
            if (knot > low && knot < high) breaks.push_back(knot);
    std::sort(breaks.begin(), breaks.end());
    std::vector<double> result{low};
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
        for (int k = 1; k <= cells_per_span; ++k)
            result.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / cells_per_span);
    return result;
}

std::vector<Umbilic> scan_umbilics(const Surface& surface, double u0, double u1, double v0, double v1,
                                   const ScanOptions& options) {
    const std::vector<double> us = sample_parameters(surface, true, u0, u1, options.cells_per_span);
    const std::vector<double> vs = sample_parameters(surface, false, v0, v1, options.cells_per_span);
    const std::size_t nu = us.size(), nv = vs.size();
    std::vector<Complex> field(nu * nv);
    std::vector<double> area(nu * nv);
    for (std::size_t i = 0; i < nu; ++i)
        for (std::size_t j = 0; j < nv; ++j) field[i * nv + j] = deviator(surface, us[i], vs[j], area[i * nv + j]);
    const double pole = kDegenerate * *std::max_element(area.begin(), area.end());
    const auto at = [&](std::size_t i, std::size_t j) { return field[i * nv + j]; };
    const auto regular = [&](std::size_t i, std::size_t j) { return area[i * nv + j] > pole; };

    std::vector<std::pair<double, double>> starts;
    for (std::size_t i = 0; i + 1 < nu; ++i)
        for (std::size_t j = 0; j + 1 < nv; ++j) {
            if (!regular(i, j) || !regular(i + 1, j) || !regular(i, j + 1) || !regular(i + 1, j + 1)) continue;
            const double around = turn(at(i, j), at(i + 1, j)) + turn(at(i + 1, j), at(i + 1, j + 1)) +
                                  turn(at(i + 1, j + 1), at(i, j + 1)) + turn(at(i, j + 1), at(i, j));
            bool least = i > 0 && j > 0;  // a local minimum may hide a star and a lemon in one cell
            for (int di = -1; least && di <= 1; ++di)
                for (int dj = -1; least && dj <= 1; ++dj) least = std::norm(at(i, j)) <= std::norm(at(i + di, j + dj));
            if (std::abs(around) > std::numbers::pi || least)
                starts.push_back({(us[i] + us[i + 1]) / 2, (vs[j] + vs[j + 1]) / 2});
        }

    std::vector<Umbilic> found;
    const double wide_u = u1 - u0, wide_v = v1 - v0;
    for (auto [u, v] : starts) {
        bool converged = false;
        for (int step = 0; step < kNewtonSteps && !converged; ++step) {
            const auto move = newton_step(evaluate(surface, u, v));
            if (!move) break;
            u = std::clamp(u + move->first, u0, u1);
            v = std::clamp(v + move->second, v0, v1);
            converged = std::abs(move->first) < kNewtonStep * wide_u && std::abs(move->second) < kNewtonStep * wide_v;
        }
        const bool known = std::any_of(found.begin(), found.end(), [&](const Umbilic& other) {
            return std::abs(other.u - u) < kSamePoint * wide_u && std::abs(other.v - v) < kSamePoint * wide_v;
        });
        const Derivatives d = evaluate(surface, u, v);
        if (converged && !known && d.u.Crossed(d.v).Magnitude() > pole) found.push_back(describe(surface, u, v));
    }
    std::sort(found.begin(), found.end(), [](const Umbilic& a, const Umbilic& b) {
        return std::pair{a.u, a.v} < std::pair{b.u, b.v};
    });
    return found;
}

bool all_umbilic(const Surface& surface, double u0, double u1, double v0, double v1, double size) {
    constexpr int steps = 7;  // inner points only: borders may be poles
    for (int i = 1; i < steps; ++i)
        for (int j = 1; j < steps; ++j) {
            double area = 0;
            const Complex d = deviator(surface, u0 + (u1 - u0) * i / steps, v0 + (v1 - v0) * j / steps, area);
            if (std::abs(d) * size > kNoCurvature) return false;
        }
    return true;
}

}  // namespace umbilic::models
