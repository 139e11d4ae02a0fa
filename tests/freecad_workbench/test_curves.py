# SPDX-License-Identifier: LGPL-2.1-or-later
import math

import numpy as np
import pytest

import umbilic


def centre_of_sphere(path):
    """From points of the sphere: |p|^2 = 2 p.c + (r^2 - |c|^2)."""
    points, _ = umbilic.read(path).mesh()
    rows = np.hstack([2 * points, np.ones((len(points), 1))])
    return np.linalg.lstsq(rows, np.sum(points**2, axis=1), rcond=None)[0][:3]


def test_lines_of_curvature_of_a_torus_are_its_circles(models):
    lines = umbilic.line_of_curvature(models / "torus.step", (0.5, 0.7), spacing=1.0)
    assert [line.family for line in lines] == ["maximum", "minimum"]
    # Radii 40 and 12 mm: seen from outside the small circles are the stronger curved.
    assert all(line.closed and line.ended == "closed" for line in lines)
    assert lines[0].length == pytest.approx(2 * math.pi * 12, rel=1e-6)
    height = lines[1].points[:, 2]
    assert np.ptp(height) < 1e-5
    assert lines.to_dict()["schema"] == "umbilic.curve/1"


def test_geodesics_on_a_sphere_are_both_arcs(models):
    found = umbilic.geodesic(models / "sphere.igs", (0.3, 0.2), to=(1.4, -0.5))
    assert len(found) == 2
    assert found[0].length + found[1].length == pytest.approx(2 * math.pi * 25, rel=1e-8)
    distances = np.linalg.norm(found[0].points - centre_of_sphere(models / "sphere.igs"), axis=1)
    assert distances == pytest.approx(25, abs=1e-6)
    assert found[0].parameters[-1] == pytest.approx([1.4, -0.5])


def test_geodesic_crosses_smooth_edges(models):
    crossed = umbilic.geodesic(models / "bottle.step", (0.5, 0.5), face=1, direction=(1, 0, 0), length=120)
    stayed = umbilic.geodesic(models / "bottle.step", (0.5, 0.5), face=1, direction=(1, 0, 0), length=120, one_face=True)
    assert set(crossed[0].faces) == {1, 2}
    assert crossed[0].ended == "length"
    assert set(stayed[0].faces) == {1}
    assert stayed[0].ended == "boundary"


def test_no_geodesic_is_said(models):
    # The two leaves of the blade meet at sharp edges only.
    found = umbilic.geodesic(models / "blade.step", (0.5, 0.5), face=1, to=(0.5, 0.5), to_face=2)
    assert len(found) == 0
    assert "no geodesic" in found.why


def test_projection_onto_a_concentric_sphere_is_radial(models):
    centre = centre_of_sphere(models / "sphere.igs")
    great_circle = centre + 40 * np.array([[math.cos(t), math.sin(t), 0.0] for t in np.linspace(0.1, 2.0, 50)])
    projected = umbilic.project(great_circle, models / "sphere.igs")
    offset = projected[0].points - centre
    assert np.linalg.norm(offset, axis=1) == pytest.approx(25, abs=1e-6)
    assert offset[-1] == pytest.approx(25 / 40 * (great_circle[-1] - centre), abs=1e-6)
    assert projected[0].length == pytest.approx(25 * 1.9, rel=1e-6)
    both = umbilic.project(models / "sphere.igs", models / "sphere.igs", start=(0.3, 0.2), direction=(0, 0, 1), length=10)
    assert both[0].original.points == pytest.approx(both[0].points, abs=1e-6)


def test_bad_input_is_an_error(models, bottle):
    with pytest.raises(umbilic.InvalidInput, match="outside"):
        umbilic.line_of_curvature(bottle, (7.0, 0.5), face=1)
    with pytest.raises(umbilic.InvalidInput, match="choose one"):
        umbilic.line_of_curvature(bottle, (0.5, 0.5))
    with pytest.raises(umbilic.InvalidInput, match="umbilic"):
        umbilic.line_of_curvature(models / "sphere.igs", (0.5, 0.5))
    with pytest.raises(umbilic.InvalidInput, match="either"):
        umbilic.geodesic(bottle, (0.5, 0.5), face=1)
    for length in (0.0, -1.0, math.nan):
        with pytest.raises(umbilic.InvalidInput, match="length"):
            umbilic.geodesic(bottle, (0.5, 0.5), face=1, direction=(1, 0, 0), length=length)
    with pytest.raises(umbilic.InvalidInput, match="shape"):
        umbilic.project(np.zeros((4, 2)), models / "sphere.igs")
    with pytest.raises(umbilic.InvalidInput, match="start"):
        umbilic.project(bottle, models / "sphere.igs")
    with pytest.raises(umbilic.Cancelled):
        umbilic.geodesic(bottle, (0.5, 0.5), face=1, to=(0.6, 0.6), progress=lambda fraction, text: False)
