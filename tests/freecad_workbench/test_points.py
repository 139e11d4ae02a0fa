# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest

import umbilic


def heights(points):
    return 0.4 * np.sin(2.0 * points[:, 0]) * np.cos(1.5 * points[:, 1]) + 0.2 * points[:, 0] ** 3


def cloud(count, noise, seed=1):
    random = np.random.default_rng(seed)
    points = random.uniform(-1.0, 1.0, (count, 3))
    points[:, 2] = heights(points)
    return points + noise * random.standard_normal(points.shape)


@pytest.fixture(scope="module")
def surface(tmp_path_factory):
    """A free-form design as a STEP file."""
    path = tmp_path_factory.mktemp("points") / "surface.step"
    umbilic.fit(cloud(6000, 0.0)).write(path)
    return umbilic.read(path)


def moved(points):
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    return 0.5 * points @ turn.T + [3.0, -2.0, 1.0]


def test_arrays_and_files_give_the_same(surface, tmp_path):
    scan = moved(cloud(2500, 5e-4, seed=2))
    path = tmp_path / "scan.xyz"
    np.savetxt(path, scan, fmt="%.17g")
    from_array = umbilic.compare(surface, scan, mirror="never")
    from_file = umbilic.compare(surface, path, mirror="never")
    assert from_array.alignment.scale == from_file.alignment.scale
    assert from_array.alignment.found, from_array.alignment.why
    assert from_array.alignment.method == "points"
    assert from_array.alignment.scale == pytest.approx(2.0, rel=0.01)
    assert from_array.answer.kind == "scaled"
    assert from_array.to_dict()["inputs"]["suspect"]["points"] == 2500
    assert from_array.tests["strong"]["passed"] is None
    match = umbilic.match(surface, scan, mirror="never")
    assert match.alignment.scale == from_array.alignment.scale


def test_overlay_and_report_of_points(surface, tmp_path):
    result = umbilic.compare(surface, moved(cloud(1500, 5e-4, seed=3)), mirror="never")
    overlay = result.overlay()
    assert overlay.suspect.points.shape == (1500, 3)
    assert overlay.suspect.triangles.shape == (0, 3)
    assert np.abs(overlay.suspect.deviation).max() == overlay.largest
    umbilic.report(result, tmp_path / "report")
    assert {path.name for path in (tmp_path / "report").iterdir()} == {
        "report.html", "result.json", "deviation.csv", "aligned.ply"}
    nodes = result.nodes("suspect")
    assert np.isfinite(nodes["distance"]).all()


def test_points_are_read_cleaned_and_told_from_models(models, tmp_path):
    array = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0], [np.nan, 0, 0]])
    mesh = umbilic.points(array, triangles=[[0, 1, 2], [1, 3, 2]])
    assert mesh.points.shape == (3, 3)
    assert mesh.triangles.tolist() == [[0, 1, 2]]
    assert mesh.info()["not_finite"] == 1 and mesh.info()["merged"] == 1
    path = tmp_path / "p.xyz"
    path.write_text("0 0 0\n1 0 0\n0 1 0\n")
    assert isinstance(umbilic.read(path), umbilic.Points)
    assert isinstance(umbilic.read(models / "hood.step"), umbilic.Model)
    for call in (umbilic.umbilics, umbilic.wireframe, umbilic.info):
        with pytest.raises(umbilic.InvalidInput, match="measured points"):
            call(path)


@pytest.mark.parametrize(
    "bad", [np.zeros((5, 2)), np.zeros((0, 3)), np.full((9, 3), np.nan), np.zeros((100, 3)), np.ones(7)])
def test_bad_points_are_refused(surface, bad):
    with pytest.raises(umbilic.InvalidInput):
        umbilic.compare(surface, bad)
    with pytest.raises(umbilic.InvalidInput):
        umbilic.fit(bad)


def test_a_model_is_no_suspect_of_points(surface):
    with pytest.raises(umbilic.Unsupported, match="exchange"):
        umbilic.match(cloud(500, 0.0), surface)


def test_fit_leaves_the_noise(tmp_path):
    noise = 1e-3
    fit = umbilic.fit(cloud(4000, noise, seed=4))
    assert fit.rms == pytest.approx(noise, rel=0.15)
    assert fit.noise == pytest.approx(noise, rel=0.2)
    assert fit.points.shape == (4000, 3) and fit.parameters.shape == (4000, 2)
    assert fit.rms == pytest.approx(np.sqrt(np.mean(fit.distances**2)), rel=1e-9)
    assert fit.control_points.shape == tuple(fit.surface["poles"]) + (3,)
    assert fit.to_dict()["schema"] == "umbilic.fit/1"
    fit.write(tmp_path / "out.step")
    assert umbilic.info(tmp_path / "out.step")["input"]["nurbs_faces"] == 1
    assert fit.report(tmp_path / "report").endswith("report.html")


def test_fit_of_a_grid():
    u, v = np.meshgrid(np.linspace(-1, 1, 25), np.linspace(-1, 1, 20), indexing="ij")
    grid = np.stack([u, v, 0.3 * u * v], axis=-1)
    fit = umbilic.fit(grid, net=(6, 5), degree=2)
    assert fit.to_dict()["method"] == "grid"
    assert fit.surface["poles"] == [6, 5] and fit.surface["degree"] == [2, 2]
    assert fit.rms < 1e-12
    with pytest.raises(umbilic.InvalidInput):
        umbilic.fit(grid.reshape(-1, 3), grid=(25, 21))
    with pytest.raises(umbilic.InvalidInput):
        umbilic.fit(grid, method="guessing", degree=3, net=(2, 2))
