# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest

import umbilic


def test_model_holds_what_the_file_does(bottle, ground_truth):
    truth = next(model for model in ground_truth["models"] if model["file"] == "bottle.step")
    about = bottle.info()["input"]
    assert about["faces"] == truth["faces"]
    assert about["format"] == "STEP"
    # The kernel is asked for 1e-6 and keeps to it to within a small factor.
    assert about["area"] == pytest.approx(truth["area"], rel=1e-5)


def test_info_of_a_path_is_that_of_the_model(bottle, models):
    assert umbilic.info(models / "bottle.step") == bottle.info()


def test_mesh_is_made_of_arrays(bottle):
    points, triangles = bottle.mesh()
    assert points.dtype == float and points.shape[1] == 3
    assert triangles.shape[1] == 3
    assert triangles.min() == 0 and triangles.max() == len(points) - 1
    corners = points[triangles]
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    # Chords lie inside a curved surface, so their area is a little smaller.
    assert 0.5 * doubled.sum() == pytest.approx(bottle.info()["input"]["area"], rel=0.01)


def test_missing_file_is_named(tmp_path):
    with pytest.raises(umbilic.InvalidInput, match="nowhere.step"):
        umbilic.read(tmp_path / "nowhere.step")


def test_malformed_files_are_errors_in_one_line(models, ground_truth):
    broken = [entry["file"] for entry in ground_truth["malformed"] if entry["expected"] == "error"]
    assert broken
    for file in broken:
        with pytest.raises(umbilic.InvalidInput, match=file.split("/")[-1]) as caught:
            umbilic.read(models / file)
        assert "\n" not in str(caught.value)


def test_other_things_are_not_models():
    with pytest.raises(TypeError, match="int"):
        umbilic.read(5)


def test_errors_share_a_base():
    for kind in (umbilic.InvalidInput, umbilic.Unsupported, umbilic.NumericFailure, umbilic.Cancelled):
        assert issubclass(kind, umbilic.Error)
        assert kind.__module__ == "umbilic"


def test_progress_tells_the_fraction_and_the_stage(models):
    heard = []
    umbilic.read(models / "bottle.step", progress=lambda fraction, text: heard.append((fraction, text)))
    assert heard
    assert all(0.0 <= fraction <= 1.0 and isinstance(text, str) for fraction, text in heard)


def test_false_from_progress_cancels(models):
    with pytest.raises(umbilic.Cancelled):
        umbilic.read(models / "bottle.step", progress=lambda fraction, text: False)


def test_an_exception_from_progress_comes_out(models):
    def fail(fraction, text):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        umbilic.read(models / "bottle.step", progress=fail)
