# SPDX-License-Identifier: LGPL-2.1-or-later
"""Comparing an original with a suspect: where it lies, how well it fits, what follows."""

from __future__ import annotations

import copy
import json
import os
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Union

import numpy as np

from . import _native
from .models import READING_SECONDS, Model, Points, Progress, ShapeLike, part_of, read
from .umbilical_points import UmbilicMarks


@dataclass(frozen=True)
class Answer:
    """The first thing a person reads."""

    kind: str
    """"same", "moved", "scaled", "mirrored", "piece", "contains", "reapproximated", "partly" or "different"."""
    text: str
    """The same in plain words."""


@dataclass(frozen=True)
class Verdict:
    """What the decision algorithms of the thesis say."""

    level: str
    """Highest test passed: "none", "weak", "intermediate" or "strong"."""
    derived: bool
    """Whether the level is not "none"."""
    explanation: str
    """One sentence that needs no mathematics."""


@dataclass(frozen=True)
class Alignment:
    """Similarity that maps the suspect onto the original: p_original = scale * rotation * M * p_suspect + translation.

    M is diag(-1, 1, 1) if `mirrored` and the identity otherwise. The numbers are those of the best pose tried unless
    `status` is "not found"; `found` is true only if that pose is clearly the one.
    """

    found: bool
    status: str
    """"found", "ambiguous" (several different poses fit), "compatible" (it fits, too little evidence), "not found"."""
    why: str
    method: Optional[str]
    scope: Optional[str]
    """"global" or "partial"."""
    mirrored: Optional[bool]
    scale: Optional[float]
    rotation: Optional[np.ndarray]
    """(3, 3), determinant +1."""
    translation: Optional[np.ndarray]
    """(3,), mm of the original."""
    rms: Optional[float]
    """Root mean square distance of what lies on the original, mm of the original."""
    max: Optional[float]
    relative_max: Optional[float]
    """`max` / sqrt(area of the original)."""
    pairs: List[Dict[str, Any]]
    """Given pairs of points in their order: dicts with "residual" (mm of the original) and "outlier"."""
    free_motions: List[Dict[str, Any]]
    """What the pose leaves open: dicts with "kind" ("turn", "slide", "slide_in_plane", "turn_about_point", "screw",
    "size" or "spiral"), "point" (mm of the original), "direction" (or None) and, of screws and spirals, "pitch"."""

    @staticmethod
    def of(entry: Dict[str, Any]) -> "Alignment":
        """From the "alignment" of a JSON result."""
        names = ("found", "status", "why", "method", "scope", "mirrored", "scale", "rms", "max", "relative_max")
        arrays = {
            name: None if entry.get(name) is None else np.array(entry[name], dtype=float)
            for name in ("rotation", "translation")
        }
        return Alignment(**{name: entry.get(name) for name in names}, **arrays,
                         pairs=entry.get("pairs") or [], free_motions=entry.get("free_motions") or [])

    def matrix(self) -> np.ndarray:
        """The homogeneous matrix (4, 4) of the map from suspect to original. Raises ValueError without a pose."""
        if self.rotation is None or self.translation is None or self.scale is None:
            raise ValueError("no pose was found, so there is no matrix")
        matrix = np.eye(4)
        matrix[:3, :3] = self.scale * self.rotation @ np.diag([-1.0 if self.mirrored else 1.0, 1.0, 1.0])
        matrix[:3, 3] = self.translation
        return matrix


@dataclass(frozen=True)
class Mesh:
    """Triangles of a model, for pictures."""

    points: np.ndarray
    """(n, 3), mm of the original."""
    normals: np.ndarray
    """(n, 3), unit."""
    triangles: np.ndarray
    """(m, 3), indices from 0, counter-clockwise seen from outside."""
    edges: np.ndarray
    """(k, 2), indices of the points that the borders of the faces connect."""
    deviation: np.ndarray
    """(n,), signed distance to the original in mm, positive on its outward side; (0,) where it was not measured."""


@dataclass(frozen=True)
class Overlay:
    """What a picture of the comparison shows, in the frame and unit of the original."""

    original: Mesh
    suspect: Mesh
    """In the pose that was found, with deviations; beside the original if none was found."""
    posed: bool
    """Whether a pose was found."""
    range: float
    """Deviation (mm) at the end of the colour scale, a round number."""
    largest: float
    """Largest deviation that occurs, mm."""
    tolerance: float
    """The weak test's, mm."""
    original_umbilics: UmbilicMarks
    suspect_umbilics: UmbilicMarks


class Match:
    """Result of `match`: the pose alone."""

    def __init__(self, result: Dict[str, Any]):
        self._result = result

    @property
    def alignment(self) -> Alignment:
        return Alignment.of(self._result["alignment"])

    def to_dict(self) -> Dict[str, Any]:
        """The result with schema "umbilic.match/1", the same as the command `umbilic match` gives."""
        return copy.deepcopy(self._result)


class Comparison:
    """Result of `compare`. Attributes are the main numbers; `to_dict` holds everything."""

    def __init__(self, native: Any, original: Union[Model, Points], suspect: Union[Model, Points], options: Dict[str, Any]):
        self.native = native
        self.original = original
        self.suspect = suspect
        self.options = options
        self._result: Dict[str, Any] = json.loads(native.json())

    @property
    def answer(self) -> Answer:
        answer = self._result["answer"]
        return Answer(kind=answer["class"], text=answer["text"])

    @property
    def verdict(self) -> Verdict:
        verdict = self._result["verdict"]
        return Verdict(verdict["level"], verdict["derived"], verdict["explanation"])

    @property
    def alignment(self) -> Alignment:
        return Alignment.of(self._result["alignment"])

    @property
    def tests(self) -> Dict[str, Any]:
        """The weak, intermediate and strong tests, as in the JSON result (mm, 1/mm, radians)."""
        return self._result["tests"]

    @property
    def similarity(self) -> Dict[str, Any]:
        """Local similarity: percent of the area within tolerance, as in the JSON result."""
        return self._result["similarity"]

    @property
    def coverage(self) -> Dict[str, Any]:
        """Shares of area that lie on the other model, as in the JSON result."""
        return self._result["coverage"]

    @property
    def parameters(self) -> Dict[str, Any]:
        """Every option and tolerance as it was used: value, unit, origin."""
        return self._result["parameters"]

    @property
    def has_pose(self) -> bool:
        """Whether there is a pose in which the models can be laid on each other."""
        return self._result["alignment"]["status"] != "not found"

    def overlay(self, progress: Progress = None) -> Overlay:
        """Meshes with deviations and umbilics, as arrays. Raises Cancelled."""
        scene = self.native.scene(progress)
        shown = {"original": [], "suspect": []}
        for umbilic in scene["umbilics"]:
            shown["suspect" if umbilic["of_suspect"] else "original"].append(umbilic)
        return Overlay(
            original=Mesh(**scene["original"]),
            suspect=Mesh(**scene["suspect"]),
            posed=scene["posed"],
            range=scene["range"],
            largest=scene["largest"],
            tolerance=scene["tolerance"],
            original_umbilics=UmbilicMarks.of(shown["original"]),
            suspect_umbilics=UmbilicMarks.of(shown["suspect"]),
        )

    def nodes(self, of: str = "suspect") -> Dict[str, np.ndarray]:
        """The points at which the tests were made, as columns.

        `points` (n, 3) in the original's frame, `face`, `weight` (mm^2), `distance` and `signed_distance` (mm),
        `kappa_max` and `kappa_min` (differences, 1/mm), `direction` (radians), `covered`; NaN where not defined.
        """
        if of not in ("suspect", "original"):
            raise _native.InvalidInput(f"of = {of!r}: expected 'suspect' or 'original'")
        return self.native.nodes(of == "suspect")

    def to_dict(self) -> Dict[str, Any]:
        """The result with schema "umbilic.compare/1", the same as the command `umbilic compare` gives."""
        return copy.deepcopy(self._result)

    def __repr__(self) -> str:
        return f"<umbilic.Comparison: {self.answer.text}>"


def match(
    original: ShapeLike,
    suspect: ShapeLike,
    *,
    seconds: float = READING_SECONDS,
    progress: Progress = None,
    **options: Any,
) -> Match:
    """Finds how the suspect lies on the original. Arguments, options and errors as for `compare`."""
    first = read(original, seconds=seconds, progress=part_of(progress, 0.0, 0.1))
    second = read(suspect, seconds=seconds, progress=part_of(progress, 0.1, 0.2))
    found = _native.match_json(first.native, second.native, options, part_of(progress, 0.2, 1.0))
    return Match(json.loads(found))


def compare(
    original: ShapeLike,
    suspect: ShapeLike,
    *,
    seconds: float = READING_SECONDS,
    progress: Progress = None,
    **options: Any,
) -> Comparison:
    """Tells whether the suspect, or a piece of it, is a copy of the original.

    Either is what `read` takes; measured points as the original need points as the suspect. `seconds` limits the
    reading of each model. Options, all optional, named as on the command line:

    method            "auto", "analytic", "umbilics", "moments" or "curvature", and the thesis's "umbilics-lines",
                      "umbilics-kh" and "kh"; of measured points "auto", "curvature" or "points", which are the same
    scale             "auto", "fixed" (it is 1) or (low, high)
    scale_search      "golden" (section) or "brent": how "kh" searches a scale that is not fixed
    kh_solver         "direct", or the thesis's "auxiliary" or "approximated": how "kh" and "umbilics-kh" find points
    mirror            "auto" or "never"
    scope             "auto", "global" or "partial"
    initial           dict with scale, rotation, translation, mirrored: a pose to start from
    pairs             known corresponding points [(on original, on suspect), ...], mm
    nodes             "wireframe" (default) or "area": where the models are compared
    match_seconds     time after which the best pose so far is judged; results then depend on the machine
    algorithm         1 or 2 (default): the decision algorithm that gives the verdict
    distance          tolerance of the weak test, mm of the original
    kappa             tolerance of curvatures, 1/mm of the original
    direction         tolerance of principal directions, radians
    umbilic_distance  tolerance of the strong test, mm of the original
    cell              side of a cell of the local similarity, relative to a face's domain
    most_points       points of a larger cloud that are used, chosen at random
    point_samples     points of a cloud at which it is measured
    seed              shifts the sampling, a whole number from 0

    Raises InvalidInput (a model cannot be read, an option is unknown or out of range), NumericFailure, Cancelled.
    """
    first = read(original, seconds=seconds, progress=part_of(progress, 0.0, 0.1))
    second = read(suspect, seconds=seconds, progress=part_of(progress, 0.1, 0.2))
    native = _native.compare(first.native, second.native, options, part_of(progress, 0.2, 1.0))
    return Comparison(native, first, second, options)


def report(comparison: Comparison, directory: "str | os.PathLike[str]", *, progress: Progress = None) -> str:
    """Writes the report of a comparison into a folder, which is made, and returns the path of its report.html.

    The folder holds report.html (complete in itself), result.json, deviation.csv and, if a pose was found,
    aligned.step (aligned.ply of measured points). Raises NumericFailure if something cannot be written, and Cancelled;
    then nothing was.
    """
    inputs = comparison.to_dict()["inputs"]
    words = [repr(inputs[which]["path"]) for which in ("original", "suspect")]
    words += [f"{name}={value!r}" for name, value in comparison.options.items()]
    call = f"umbilic.compare({', '.join(words)})"
    return _native.write_report(comparison.native, os.fspath(directory), call, progress)
