# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws docs/images/omega_plane.svg: the types of umbilics in the omega plane. Run it from this folder."""

import cmath
import math

SIDE, RANGE = 440.0, 3.4
COLORS = {"lemon": "#0072b2", "monstar": "#009e73", "hyperbolic star": "#d55e00", "elliptic star": "#e69f00"}


def place(w):
    return SIDE / 2 * (1 + w.real / RANGE), SIDE / 2 * (1 - w.imag / RANGE)


def curve(point, steps=360):
    corners = (place(point(2 * math.pi * i / steps)) for i in range(steps))
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in corners) + "Z"


def gamma(t):
    return 2 * cmath.exp(1j * t) + cmath.exp(-2j * t)


def label(w, text, extra=""):
    x, y = place(w)
    return f'<text x="{x:.1f}" y="{y:.1f}"{extra}>{text}</text>'


def picture():
    fill = '<path d="{}" fill="{}" fill-opacity=".28" stroke="#26547c" stroke-width="1.3"{}/>'
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIDE:.0f} {SIDE:.0f}" width="{SIDE:.0f}" '
        'font-family="DejaVu Sans, Arial, sans-serif" font-size="12" text-anchor="middle" fill="#1c2128">',
        f'<rect width="{SIDE:.0f}" height="{SIDE:.0f}" fill="#fff"/>',
        f'<rect width="{SIDE:.0f}" height="{SIDE:.0f}" fill="{COLORS["lemon"]}" fill-opacity=".16"/>',
        f'<path d="M0 {SIDE / 2}H{SIDE}M{SIDE / 2} 0V{SIDE}" stroke="#9aa3ad" stroke-width=".7"/>',
    ]
    white = '<path d="{}" fill="#fff"/>'
    for point, name, extra in (
        (lambda t: -gamma(t), "monstar", ""),
        (lambda t: cmath.exp(1j * t), "hyperbolic star", ' stroke-dasharray="5 3"'),
        (lambda t: gamma(t) / 3, "elliptic star", ""),
    ):
        path = curve(point)
        parts += [white.format(path), fill.format(path, COLORS[name], extra)]
    parts += [
        label(0.2 + 2.45j, "lemon: index +½, 1 line"),
        label(-1.9 + 0.1j, "monstar:"),
        label(-1.9 - 0.15j, "+½, 3 lines"),
        label(0.08 + 0.08j, "elliptic"),
        label(0.08 - 0.13j, "star"),
        label(1.15 - 0.95j, "hyperbolic star:", ' text-anchor="start"'),
        label(1.15 - 1.2j, "−½, 3 lines", ' text-anchor="start"'),
        '<path d="M{:.1f} {:.1f}L{:.1f} {:.1f}" stroke="#1c2128" stroke-width=".8"/>'.format(
            *place(1.1 - 0.85j), *place(0.62 - 0.55j)),
        label(0.42 + 0.44j, "Γ₁", ' font-style="italic"'),
        label(-1.0 + 1.05j, "|ω| = 1", ' font-style="italic"'),
        label(1.75 + 1.6j, "Γ₂", ' font-style="italic"'),
        label(3.05 + 0.1j, "Re ω"),
        label(0.35 + 3.2j, "Im ω"),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


if __name__ == "__main__":
    with open("omega_plane.svg", "w", encoding="utf-8") as file:
        file.write(picture())
