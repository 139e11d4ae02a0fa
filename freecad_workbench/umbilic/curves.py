# SPDX-License-Identifier: LGPL-2.1-or-later
"""Single curves on the faces of a model: lines of curvature, geodesics, orthogonal projections."""

from __future__ import annotations

import copy
import json
import math
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _native
from .models import READING_SECONDS, ModelLike, Progress, part_of, read_model

FAMILIES = ("maximum", "minimum")


@dataclass(frozen=True)
class Curve:
    """A curve as points in order along it; where it passes from face to face the same point stands twice."""

    family: Optional[str]
    """"maximum", "minimum" or "geodesic"; None for the projection of given points."""
    points: np.ndarray
    """(n, 3), mm."""
    s: np.ndarray
    """(n,), arc length from the first point, mm."""
    faces: np.ndarray
    """(n,), face numbers."""
    parameters: np.ndarray
    """(n, 2), u and v of the face's own surface in the file."""
    closed: bool
    started: str
    ended: str
    """"length", "boundary", "trim", "umbilic", "closed", "evolute" or "point"."""
    length: float
    error: float
    """Estimated (for projections: measured) distance from the true curve, mm."""
    left_target: bool = False
    """A projection ended at the border of what it was projected onto."""
    original: Optional["Curve"] = None
    """The curve whose projection this is, if it was computed."""

    @staticmethod
    def of(entry: Dict[str, Any], family: Optional[str]) -> "Curve":
        """From an entry of the JSON result."""
        points = entry["points"]
        original = entry.get("original")
        return Curve(
            family=family,
            points=np.array([point["point"] for point in points], dtype=float).reshape(-1, 3),
            s=np.array([point["s"] for point in points], dtype=float),
            faces=np.array([point["face"] for point in points], dtype=int),
            parameters=np.array([[point["u"], point["v"]] for point in points], dtype=float).reshape(-1, 2),
            closed=entry["closed"],
            started=entry["started"],
            ended=entry["ended"],
            length=entry["length"],
            error=entry["error"],
            left_target=entry.get("left_target", False),
            original=Curve.of(original, family) if original else None,
        )


class Curves(Sequence):
    """The curves of one call, in order: of geodesics the shortest comes first."""

    def __init__(self, result: Dict[str, Any]):
        self._result = result
        self._curves = [Curve.of(entry, entry["family"]) for entry in result["curves"]]

    def __getitem__(self, index):
        return self._curves[index]

    def __len__(self) -> int:
        return len(self._curves)

    def __iter__(self) -> Iterator[Curve]:
        return iter(self._curves)

    @property
    def kind(self) -> str:
        """"lines-of-curvature", "geodesic" or "project"."""
        return self._result["kind"]

    @property
    def why(self) -> str:
        """Why there is no curve; empty if there is one."""
        return self._result.get("why", "")

    def to_dict(self) -> Dict[str, Any]:
        """The result with schema "umbilic.curve/1", the same as the command `umbilic curve` gives."""
        return copy.deepcopy(self._result)

    def __repr__(self) -> str:
        return f"<umbilic.Curves: {len(self)} {self.kind}>"


Parameters = Tuple[float, float]
Vector = Sequence[float]


def _positive(name: str, value: Optional[float]) -> None:
    if value is not None and not (math.isfinite(value) and value > 0):
        raise _native.InvalidInput(f"{name}: must be a positive number, not {value}")


def line_of_curvature(
    source: ModelLike,
    start: Parameters,
    *,
    face: Optional[int] = None,
    family: str = "both",
    length: Optional[float] = None,
    spacing: float = 0.0,
    tolerance: Optional[float] = None,
    seconds: float = READING_SECONDS,
    progress: Progress = None,
) -> Curves:
    """The lines of curvature through the point `start` = (u, v) of a face (which may be left out if there is one only).

    `family` is "maximum", "minimum" or "both"; the maximum family follows the greater normal curvature. Each branch
    ends after `length` mm, at a border or an umbilic, or where the line closes. `spacing` (mm) is the distance between
    the points returned, 0 for the integration's own steps. Raises InvalidInput for a start outside of the face or in an
    umbilic, NumericFailure, Cancelled.
    """
    if family not in FAMILIES + ("both",):
        raise _native.InvalidInput(f'family: must be "maximum", "minimum" or "both", not "{family}"')
    model = read_model(source, seconds=seconds, progress=part_of(progress, 0.0, 0.8))
    return Curves(
        json.loads(
            _native.lines_of_curvature_json(
                model.native, face, start, family, length, spacing, tolerance, part_of(progress, 0.8, 1.0)
            )
        )
    )


def geodesic(
    source: ModelLike,
    start: Parameters,
    *,
    to: Optional[Parameters] = None,
    direction: Optional[Vector] = None,
    length: Optional[float] = None,
    face: Optional[int] = None,
    to_face: Optional[int] = None,
    longest: Optional[float] = None,
    most: int = 16,
    one_face: bool = False,
    spacing: float = 0.0,
    tolerance: Optional[float] = None,
    seconds: float = READING_SECONDS,
    progress: Progress = None,
) -> Curves:
    """Geodesics from the point `start` = (u, v) of a face.

    With `to` (u, v, on the same face or on `to_face`): all that are found up to `longest` mm (default: twice the
    model's diagonal), the shortest first, at most `most`; none is an empty result with `why`. With `direction` and
    `length` (mm): the one that leaves the start so. They go on to other faces over smooth edges unless `one_face`.
    Raises InvalidInput, NumericFailure, Cancelled.
    """
    if (to is None) == (direction is None):
        raise _native.InvalidInput("geodesic: give either to=(u, v) or direction=(x, y, z) with length=mm")
    if direction is not None and length is None:
        raise _native.InvalidInput("geodesic: direction needs length=mm")
    _positive("longest", longest)
    model = read_model(source, seconds=seconds, progress=part_of(progress, 0.0, 0.3))
    return Curves(
        json.loads(
            _native.geodesics_json(
                model.native,
                face,
                start,
                to,
                to_face,
                direction,
                length,
                longest or 0.0,
                most,
                one_face,
                spacing,
                tolerance,
                part_of(progress, 0.3, 1.0),
            )
        )
    )


def project(
    curve: Union[Curves, Curve, np.ndarray, ModelLike],
    onto: ModelLike,
    *,
    onto_face: Optional[int] = None,
    foot: Optional[Parameters] = None,
    start: Optional[Parameters] = None,
    face: Optional[int] = None,
    family: str = "geodesic",
    direction: Optional[Vector] = None,
    length: Optional[float] = None,
    to: Optional[Parameters] = None,
    one_face: bool = False,
    spacing: float = 0.0,
    tolerance: Optional[float] = None,
    seconds: float = READING_SECONDS,
    progress: Progress = None,
) -> Curves:
    """The orthogonal projection of a curve onto a face of the model `onto`.

    `curve` is a result of this module, an array of points (n, 3) in mm taken as a polyline, or a model: then the curve
    is a geodesic or a line of curvature (`family` "geodesic", "maximum" or "minimum") that leaves the point `start` =
    (u, v) of its face along `direction` for `length` mm, or the geodesic from there `to` another point of the face, and
    both are computed together. `foot` chooses the foot (u, v) of the curve's start; the nearest one by default. A
    projection ends at the border of `onto` or at a centre of curvature: that is no error. Raises InvalidInput,
    NumericFailure, Cancelled.
    """
    target = read_model(onto, seconds=seconds, progress=part_of(progress, 0.0, 0.3))
    rest = part_of(progress, 0.6, 1.0)
    if start is None:
        curves: List[np.ndarray]
        if isinstance(curve, Curves):
            curves = [one.points for one in curve]
        elif isinstance(curve, Curve):
            curves = [curve.points]
        else:
            if not isinstance(curve, (np.ndarray, list, tuple)):
                raise _native.InvalidInput("project: a curve on a model needs start=(u, v)")
            curves = [np.asarray(curve, dtype=float)]
        for points in curves:
            if points.ndim != 2 or points.shape[1] != 3:
                raise _native.InvalidInput("project: points must be an array of shape (n, 3)")
        # A point on an edge stands there for both faces.
        distinct = [
            points[np.concatenate([[True], np.any(np.diff(points, axis=0) != 0, axis=1)])] for points in curves
        ]
        found = _native.project_points_json(distinct, target.native, onto_face, foot, one_face, spacing, tolerance, rest)
        return Curves(json.loads(found))
    if family not in FAMILIES + ("geodesic",):
        raise _native.InvalidInput(f'family: must be "geodesic", "maximum" or "minimum", not "{family}"')
    if (to is None) == (direction is None) or (direction is not None and length is None):
        raise _native.InvalidInput("project: start needs direction=(x, y, z) with length=mm, or to=(u, v)")
    if to is not None and family != "geodesic":
        raise _native.InvalidInput("project: only a geodesic is given by its ends")
    model = read_model(curve, seconds=seconds, progress=part_of(progress, 0.3, 0.6))
    found = _native.project_started_json(
        model.native,
        face,
        start,
        family,
        direction,
        length,
        to,
        target.native,
        onto_face,
        foot,
        one_face,
        spacing,
        tolerance,
        rest,
    )
    return Curves(json.loads(found))
