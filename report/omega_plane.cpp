// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/omega_plane.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include <report/color_scale.h>
#include <report/json_geometry.h>
#include <report/mark.h>

namespace umbilic {

namespace {

using Complex = std::complex<double>;

constexpr double half_side = 200.0;  // of the picture
constexpr double half_range = 3.4;   // of the plane: Gamma_2 has its cusps at distance 3
constexpr double marker = 5.0;

double x_of(Complex w) {
    return half_side * (1.0 + w.real() / half_range);
}
double y_of(Complex w) {
    return half_side * (1.0 - w.imag() / half_range);
}

std::string curve(const char* name, const std::function<Complex(double)>& point) {
    constexpr int steps = 180;
    std::string path;
    for (int i = 0; i < steps; ++i) {
        const Complex w = point(2.0 * std::numbers::pi * i / steps);
        path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x_of(w), y_of(w));
    }
    return fmt::format("<path class=\"{}\" d=\"{}Z\"/>", name, path);
}

/// Markers of one model; the representative first, its two equals under the threefold symmetry faintly.
std::string markers(const PreparedShape& prepared, bool of_suspect, bool mirrored) {
    std::string out;
    for (const auto& [face, umbilic] : isolated_umbilics(prepared)) {
        if (!umbilic->kind.omega) continue;
        Complex omega = *umbilic->kind.omega;
        if (face->reversed != mirrored) omega = std::conj(omega);
        for (int turn = 0; turn < 3; ++turn) {
            Complex w = omega * std::polar(1.0, 2.0 * std::numbers::pi * turn / 3.0);
            const double reach = std::max(std::abs(w.real()), std::abs(w.imag()));
            if (reach > half_range) w *= (half_range - 0.15) / reach;  // drawn at the border, on its ray
            const char* const faint = turn == 0 ? "" : " faint";
            if (of_suspect) {
                out += fmt::format("<circle class=\"suspect{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>", faint, x_of(w),
                                   y_of(w), marker + 2.0);
            } else {
                out += fmt::format("<path class=\"original{}\" d=\"M{:.1f} {:.1f}m-{m} 0h{d}m-{m} -{m}v{d}\"/>", faint,
                                   x_of(w), y_of(w), fmt::arg("m", marker), fmt::arg("d", 2.0 * marker));
            }
        }
    }
    return out;
}

/// The element with axes, dividing curves and names, open for markers.
std::string open_plane(const char* description) {
    const auto circle = [](double t) { return std::polar(1.0, t); };
    const auto gamma_1 = [](double t) { return (2.0 * std::polar(1.0, t) + std::polar(1.0, -2.0 * t)) / 3.0; };
    const auto gamma_2 = [](double t) { return -(2.0 * std::polar(1.0, t) + std::polar(1.0, -2.0 * t)); };
    const double side = 2.0 * half_side;
    std::string svg = fmt::format(
        "<svg class=\"omega\" viewBox=\"0 0 {0} {0}\" role=\"img\" aria-label=\"{2}\"><path class=\"axis\" d=\"M0 "
        "{1}H{0}M{1} 0V{0}\"/>",
        side, half_side, description);
    svg += curve("gamma", gamma_2) + curve("circle", circle) + curve("gamma", gamma_1);
    const auto label = [&](Complex w, const char* text) {
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x_of(w), y_of(w), text);
    };
    label({0.0, 2.6}, "lemon");
    label({-1.75, 0.1}, "monstar");
    label({0.0, 0.1}, "elliptic star");
    label({-0.62, -0.72}, "hyperbolic star");
    label({3.1, 0.1}, "Re ω");
    label({0.35, 3.2}, "Im ω");
    return svg;
}

/// The mark at one of the three values of omega; out of range as an arrow at the border, on its ray.
std::string omega_mark(const OmegaMark& mark, Complex w, bool faint) {
    const double reach = std::max(std::abs(w.real()), std::abs(w.imag()));
    const std::string classes = faint ? "faint" : "";
    std::string svg;
    if (reach > half_range) {
        const Complex end = w * ((half_range - 0.05) / reach), start = w * ((half_range - 0.45) / reach);
        const Complex side = Complex(0.0, 1.0) * (end - start) * 0.25;
        const Complex barb = end - 0.45 * (end - start);
        svg += fmt::format(
            "<path class=\"arrow {}\" stroke=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}M{:.1f} {:.1f}L{:.1f} "
            "{:.1f}L{:.1f} "
            "{:.1f}\"/>",
            classes, hex(color_of(mark.type)), x_of(start), y_of(start), x_of(end), y_of(end), x_of(barb + side),
            y_of(barb + side), x_of(end), y_of(end), x_of(barb - side), y_of(barb - side));
        w = start;
    } else {
        const double radius = half_side * mark.uncertainty / half_range;
        if (!faint && radius > marker)
            svg += fmt::format("<circle class=\"uncertain\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>", x_of(w),
                               y_of(w), std::min(radius, 2.0 * half_side));
        svg += mark_svg(mark.type, x_of(w), y_of(w), marker + 1.0, classes);
    }
    if (!faint && !mark.label.empty())
        svg += fmt::format("<text class=\"number\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x_of(w) + 11.0, y_of(w) - 6.0,
                           mark.label);
    return svg;
}

}  // namespace

std::string omega_plane_svg(const PreparedShape& original, const PreparedShape& suspect, bool mirrored) {
    return open_plane("Umbilics of both models in the omega plane") + markers(original, false, false) +
           markers(suspect, true, mirrored) + "</svg>";
}

std::string omega_plane_svg(const std::vector<OmegaMark>& marks) {
    std::string svg = open_plane("Umbilics in the omega plane");
    for (const bool faint : {true, false})
        for (const OmegaMark& mark : marks)
            for (int turn = faint ? 1 : 0; turn < (faint ? 3 : 1); ++turn)
                svg += omega_mark(mark, mark.omega * std::polar(1.0, 2.0 * std::numbers::pi * turn / 3.0), faint);
    return svg + "</svg>";
}

}  // namespace umbilic
