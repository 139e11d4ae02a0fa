# SPDX-License-Identifier: LGPL-2.1-or-later
"""Umbilical points of a model, each with its type, its index and the proof that it exists."""

from __future__ import annotations

import copy
import json
import os
from dataclasses import dataclass
from typing import Any, Dict, List, Optional

import numpy as np

from . import _native
from .models import READING_SECONDS, ModelLike, Progress, part_of, read_model


@dataclass(frozen=True)
class UmbilicMarks:
    """Isolated umbilics inside their faces, as columns of equal length n, to be drawn."""

    points: np.ndarray
    """(n, 3), mm."""
    types: List[str]
    """"star", "monstar", "lemon" or "non-generic"."""
    labels: List[str]
    """Face, parameters and curvature, for people."""

    @staticmethod
    def of(umbilics: List[Dict[str, Any]]) -> "UmbilicMarks":
        """From entries that have a point, a type and a label."""
        return UmbilicMarks(
            points=np.array([umbilic["point"] for umbilic in umbilics], dtype=float).reshape(-1, 3),
            types=[umbilic["type"] for umbilic in umbilics],
            labels=[umbilic["label"] for umbilic in umbilics],
        )


def type_words(umbilic: Dict[str, Any]) -> str:
    """The type of an entry for people, with the types that a non-generic one may have."""
    if umbilic["star"]:
        return umbilic["star"] + " star"
    words = umbilic["type"]
    neighbours = umbilic["neighbours"]
    if len(neighbours) > 1:
        words += " (" + ", ".join(neighbours[:-1]) + " or " + neighbours[-1] + ")"
    return words


def certificate_words(face: Dict[str, Any]) -> str:
    """What is proved about the list of umbilics of a face, for people."""
    certificate = face["certificate"]
    if certificate["complete"] is None:
        return "completeness " + certificate["why"]
    if not certificate["complete"]:
        return "not complete: " + certificate["why"]
    if face["undecided"]:
        return "complete but for undecided places"
    if face["lines"] or face["regions"]:
        return "complete" if face["umbilics"] else "no other umbilic, proved"
    return "complete" if face["umbilics"] else "no umbilic, proved"


class Umbilics:
    """Every isolated umbilic, umbilic line and umbilic region of a model, face by face."""

    def __init__(self, result: Dict[str, Any]):
        self._result = result

    @property
    def faces(self) -> List[Dict[str, Any]]:
        """One entry a face, as in the JSON result: umbilics, lines, regions, certificate."""
        return self._result["faces"]

    @property
    def shells(self) -> List[Dict[str, Any]]:
        """One entry a shell, as in the JSON result: faces, genus, sum of the indices and what it proves. Empty where
        only one face was searched."""
        return self._result["shells"]

    @property
    def isolated(self) -> List[Dict[str, Any]]:
        """The isolated umbilics of all faces, each with the number of its "face"; also those outside the loops."""
        return [{"face": face["face"], **umbilic} for face in self.faces for umbilic in face["umbilics"]]

    @property
    def complete(self) -> Optional[bool]:
        """True if the certificate of every face holds, False if one fails, None if one could not be evaluated."""
        held = [face["certificate"]["complete"] for face in self.faces]
        return False if False in held else None if None in held else True

    @property
    def source_name(self) -> str:
        """Name of the file or shape, without its folder."""
        return os.path.basename(self._result["input"]["path"])

    def overlay(self) -> UmbilicMarks:
        """The isolated umbilics inside their faces as arrays."""
        return UmbilicMarks.of(
            [
                {
                    "point": umbilic["point"],
                    "type": umbilic["type"],
                    "label": "{words}, face {face}, u {u:.6g}, v {v:.6g}, \u03ba {kappa:.4g} 1/mm".format(
                        words=type_words(umbilic), **umbilic),
                }
                for umbilic in self.isolated
                if umbilic["inside"]
            ]
        )

    def to_dict(self) -> Dict[str, Any]:
        """The result with schema "umbilic.umbilics/1", the same as the command `umbilic umbilics` gives."""
        return copy.deepcopy(self._result)

    def __repr__(self) -> str:
        return f"<umbilic.Umbilics: {len(self.isolated)} isolated on {len(self.faces)} faces>"


def umbilics(
    source: ModelLike,
    *,
    face: Optional[int] = None,
    tolerance: Optional[float] = None,
    accuracy: float = 0.0,
    seconds: float = READING_SECONDS,
    progress: Progress = None,
) -> Umbilics:
    """Finds all umbilics of a model, or of its face with the number `face` (from 1).

    `tolerance` is the side of the smallest box of the search relative to the sides of the face's domain. `accuracy`
    (mm) says how far control points may be from where they should be: a type that this could change is called
    "non-generic", with the types it may have as "neighbours". Raises InvalidInput if it is negative, the model cannot be
    read or has no such face, and Cancelled.
    """
    model = read_model(source, seconds=seconds, progress=part_of(progress, 0.0, 0.1))
    found = _native.umbilics_json(model.native, face, tolerance, accuracy, part_of(progress, 0.1, 1.0))
    return Umbilics(json.loads(found))
