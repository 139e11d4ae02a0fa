# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import threading

import numpy as np
import pytest

import umbilic


def pair(ground_truth, original, suspect):
    return next(p for p in ground_truth["pairs"] if (p["original"], p["suspect"]) == (original, suspect))


def test_pose_is_the_known_one(comparison, ground_truth):
    truth = pair(ground_truth, "bottle.step", "bottle_suspect.igs")["transform"]
    found = comparison.alignment
    assert found.found
    assert found.mirrored == truth["mirrored"]
    # IGES holds nine decimals of a bottle 72 mm long.
    assert found.scale == pytest.approx(truth["scale"], rel=1e-6)
    assert np.allclose(found.rotation, truth["rotation"], rtol=0.0, atol=1e-6)
    assert np.allclose(found.translation, truth["translation"], rtol=0.0, atol=1e-4)


def test_answer_and_level_are_the_known_ones(comparison, ground_truth):
    truth = pair(ground_truth, "bottle.step", "bottle_suspect.igs")
    assert comparison.answer.kind == truth["answer"]
    assert comparison.verdict.level == truth["level"]
    assert comparison.answer.text


def test_matrix_maps_as_the_contract_says(comparison):
    pose = comparison.alignment
    point = np.array([1.0, 2.0, 3.0])
    mirror = np.diag([-1.0 if pose.mirrored else 1.0, 1.0, 1.0])
    expected = pose.scale * pose.rotation @ mirror @ point + pose.translation
    assert np.allclose(pose.matrix() @ [*point, 1.0], [*expected, 1.0])


def test_match_finds_the_same_pose_as_compare(bottle, models, comparison):
    found = umbilic.match(bottle, models / "bottle_suspect.igs")
    assert found.to_dict()["schema"] == "umbilic.match/1"
    assert found.alignment.scale == comparison.alignment.scale
    assert np.array_equal(found.alignment.rotation, comparison.alignment.rotation)


def test_result_is_the_contracts_json(comparison):
    data = comparison.to_dict()
    assert data["schema"] == "umbilic.compare/1"
    json.dumps(data, allow_nan=False)
    for key in ("tool", "inputs", "parameters", "alignment", "tests", "similarity", "coverage", "answer", "verdict"):
        assert key in data


def test_overlay_lies_on_the_original(comparison):
    overlay = comparison.overlay()
    assert overlay.posed
    assert overlay.suspect.deviation.shape == (len(overlay.suspect.points),)
    assert np.abs(overlay.suspect.deviation).max() == overlay.largest
    # The suspect is the bottle again, written with other surfaces.
    assert overlay.largest < overlay.tolerance
    assert np.allclose(overlay.suspect.points.min(axis=0), overlay.original.points.min(axis=0), atol=0.1)
    assert sorted(overlay.original_umbilics.types) == sorted(overlay.suspect_umbilics.types)
    assert overlay.suspect.triangles.max() < len(overlay.suspect.points)
    assert np.allclose(np.linalg.norm(overlay.suspect.normals, axis=1), 1.0)


def test_nodes_are_those_of_the_statistics(comparison):
    nodes = comparison.nodes("suspect")
    statistics = comparison.tests["weak"]["distance"]
    assert len(nodes["distance"]) == statistics["count"]
    assert nodes["distance"].max() == statistics["max"]
    assert set(map(len, nodes.values())) == {statistics["count"]}


def test_report_is_written_whole(comparison, tmp_path):
    page = umbilic.report(comparison, tmp_path / "report")
    assert open(page, encoding="utf-8").read().rstrip().endswith("</html>")
    assert json.loads((tmp_path / "report" / "result.json").read_text()) == comparison.to_dict()
    assert {path.name for path in (tmp_path / "report").iterdir()} >= {"deviation.csv", "aligned.step"}


def test_aligned_copy_in_the_report_needs_no_move(comparison, bottle, tmp_path):
    umbilic.report(comparison, tmp_path)
    found = umbilic.match(bottle, tmp_path / "aligned.step").alignment
    assert found.scale == pytest.approx(1.0, abs=1e-6)
    assert np.allclose(found.rotation, np.eye(3), atol=1e-6)


@pytest.mark.parametrize(
    "options, word",
    [
        ({"distance": -1.0}, "distance"),
        ({"distance": float("nan")}, "distance"),
        ({"method": "guessing"}, "method"),
        ({"scale": (2.0, 1.0)}, "scale"),
        ({"scale": "any"}, "scale"),
        ({"algorithm": 3}, "algorithm"),
        ({"initial": {"rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 2]]}}, "rotation"),
        ({"pairs": [1, 2]}, "pairs"),
        ({"kh_solver": "fast"}, "kh_solver"),
        ({"tolerence": 0.1}, "tolerence"),
    ],
)
def test_wrong_options_are_named(bottle, options, word):
    with pytest.raises(umbilic.InvalidInput, match=word):
        umbilic.compare(bottle, bottle, **options)


def test_wrong_pairs_are_named(bottle):
    points = [(0.0, 0.0, 0.0), (30.0, 0.0, 0.0), (0.0, 40.0, 0.0), (0.0, 0.0, 50.0), (20.0, 20.0, 20.0)]
    pairs = [(p, p) for p in points]
    pairs[2] = (points[2], points[4])
    found = umbilic.match(bottle, bottle, pairs=pairs).alignment
    assert found.found
    assert [entry["outlier"] for entry in found.pairs] == [False, False, True, False, False]
    assert found.pairs[2]["residual"] == pytest.approx(np.sqrt(3.0) * 20.0)


@pytest.mark.parametrize("method", ["umbilics-lines", "umbilics-kh", "kh"])
def test_the_methods_of_the_thesis_can_be_chosen(bottle, method):
    found = umbilic.match(bottle, bottle, method=method, kh_solver="approximated", scale="fixed").alignment
    assert found.found
    assert found.method == method


def test_a_users_tolerance_is_used_and_reported(bottle, models):
    result = umbilic.compare(bottle, models / "bottle_reapproximated.step", distance=0.05)
    assert result.tests["weak"]["tolerance"] == 0.05
    assert result.parameters["distance"]["origin"] == "user"


def test_cancel_is_heard_while_other_threads_run(bottle, models):
    seen = []

    def progress(fraction, text):
        seen.append(threading.current_thread())
        return len(seen) < 3

    with pytest.raises(umbilic.Cancelled):
        umbilic.compare(bottle, models / "bottle_reapproximated.step", progress=progress)
    assert set(seen) == {threading.current_thread()}


def test_other_python_threads_run_meanwhile(bottle, models):
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.wait(0.005):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        umbilic.compare(bottle, models / "bottle_suspect.igs")
    finally:
        stop.set()
        thread.join()
    assert len(ticks) > 3, "the GIL was held"
