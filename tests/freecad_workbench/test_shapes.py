# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD shapes as models. Skipped where FreeCAD's modules cannot be imported."""

import threading

import numpy as np
import pytest

import umbilic

FreeCAD = pytest.importorskip("FreeCAD")
Part = pytest.importorskip("Part")


@pytest.fixture
def shape(models):
    return Part.read(str(models / "bottle.step"))


def test_shape_and_file_hold_the_same(shape, bottle):
    found = umbilic.info(shape)
    assert found["input"]["format"] == "shape"
    assert found["faces"] == bottle.info()["faces"]


def test_placement_of_a_shape_counts(shape):
    box = Part.makeBox(1, 2, 3)
    box.Placement = FreeCAD.Placement(FreeCAD.Vector(100, 0, 0), FreeCAD.Rotation())
    assert umbilic.info(box)["input"]["box"][0] == pytest.approx([100.0, 0.0, 0.0])


def test_empty_shape_is_an_error():
    with pytest.raises(umbilic.InvalidInput, match="empty"):
        umbilic.read(Part.Shape())


def test_snapshot_outlives_the_shape_and_can_be_read_in_a_thread(shape, bottle):
    data = umbilic.ShapeData(shape, "Bottle")
    shape.nullify()
    found = []
    thread = threading.Thread(target=lambda: found.append(umbilic.read(data)))
    thread.start()
    thread.join()
    about = found[0].info()["input"]
    assert about["path"] == "Bottle"
    assert about["area"] == pytest.approx(bottle.info()["input"]["area"], rel=1e-12)


def test_moved_shape_is_found_moved(shape, tmp_path):
    moved = shape.copy()
    placement = FreeCAD.Placement(FreeCAD.Vector(10, -20, 30), FreeCAD.Rotation(FreeCAD.Vector(1, 2, 3), 40))
    moved.Placement = placement
    result = umbilic.compare(shape, umbilic.ShapeData(moved, "Moved bottle"))
    assert result.answer.kind == "moved"
    back = FreeCAD.Placement(FreeCAD.Matrix(*result.alignment.matrix().ravel())).multiply(placement)
    assert back.Base.Length == pytest.approx(0.0, abs=1e-6)
    umbilic.report(result, tmp_path)
    assert np.allclose(umbilic.read(tmp_path / "aligned.step").info()["input"]["box"],
                       umbilic.info(shape)["input"]["box"], atol=1e-6)
