# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest

import umbilic


def test_points_and_types_are_the_known_ones(models, ground_truth):
    truth = next(model for model in ground_truth["models"] if model["file"] == "monge_umbilics.step")
    known = truth["face_list"][0]["umbilics"]
    marks = umbilic.umbilics(models / "monge_umbilics.step").overlay()
    assert len(marks.types) == len(known)
    for expected in known:
        nearest = np.argmin(np.linalg.norm(marks.points - expected["point"], axis=1))
        # The file holds 13 digits of a patch of size 1.
        assert np.allclose(marks.points[nearest], expected["point"], rtol=0.0, atol=1e-9)
        assert marks.types[nearest] == expected["type"]


def test_result_is_the_contracts_json(bottle):
    result = umbilic.umbilics(bottle)
    data = result.to_dict()
    assert data["schema"] == "umbilic.umbilics/1"
    assert data["faces"] == result.faces
    assert data["shells"] == result.shells
    assert sorted(face for shell in result.shells for face in shell["faces"]) == [face["face"] for face in result.faces]
    assert all(shell["why"] for shell in result.shells)
    data["faces"].clear()
    assert result.faces, "to_dict() must be a copy"


def test_one_face_alone_is_the_same_as_among_all(bottle):
    every = umbilic.umbilics(bottle).faces
    one = umbilic.umbilics(bottle, face=1)
    assert one.faces == every[:1]
    assert one.shells == []


def test_types_within_the_accuracy(models):
    file = models / "monge_umbilics.step"
    exact = umbilic.umbilics(file)
    assert sorted(umbilic.type_words(entry) for entry in exact.isolated) == ["hyperbolic star"] * 4 + ["monstar"]
    assert all(entry["margin"] > 0 and not entry["neighbours"] for entry in exact.isolated)
    assert umbilic.certificate_words(exact.faces[0]) == "complete"
    rough = umbilic.umbilics(file, accuracy=1.2 * max(entry["margin"] for entry in exact.isolated))
    for entry in rough.isolated:
        assert entry["type"] == "non-generic" and entry["certified"]
        assert " or " in umbilic.type_words(entry)
    assert all(label.startswith("non-generic (") for label in rough.overlay().labels)
    with pytest.raises(umbilic.InvalidInput):
        umbilic.umbilics(file, accuracy=-1.0)


def test_unknown_face_is_an_error(bottle):
    with pytest.raises(umbilic.InvalidInput, match="99"):
        umbilic.umbilics(bottle, face=99)


def test_cancel(bottle):
    with pytest.raises(umbilic.Cancelled):
        umbilic.umbilics(bottle, progress=lambda fraction, text: False)
