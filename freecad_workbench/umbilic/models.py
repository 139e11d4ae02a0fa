# SPDX-License-Identifier: LGPL-2.1-or-later
"""Models: what a file or a FreeCAD shape holds, read once and used by every other call."""

from __future__ import annotations

import json
import os
from typing import Any, Callable, Dict, Optional, Tuple, Union

import numpy as np

from . import _native

Progress = Optional[Callable[[float, str], Optional[bool]]]

READING_SECONDS = 600.0
"""Default time limit of reading one model."""


class ShapeData:
    """Snapshot of a FreeCAD shape in memory, bit for bit, that any thread may read.

    Make it in FreeCAD's own thread (only that one may touch documents); then hand it to any function of this package
    in any thread. `label` stands for the path in results.
    """

    def __init__(self, shape: Any, label: str = "shape"):
        if not hasattr(shape, "exportBinary"):
            raise TypeError(f"expected a path, a Part.Shape or a model, not {type(shape).__name__}")
        if shape.isNull():
            raise _native.InvalidInput(f"{label}: the shape is empty; choose an object that has a shape")
        self.label = label
        self._memory_file = os.memfd_create("umbilic-shape", os.MFD_CLOEXEC)
        shape.exportBinary(self.path)

    @property
    def path(self) -> str:
        """Where this process and its children find the bytes (FreeCAD's binary BREP)."""
        return f"/proc/{os.getpid()}/fd/{self._memory_file}"

    def __del__(self) -> None:
        if hasattr(self, "_memory_file"):
            os.close(self._memory_file)


class Model:
    """A model as it was read: exact NURBS form of every face, and triangles to show it. Made by `read`."""

    def __init__(self, native: Any, data: Optional[ShapeData]):
        self.native = native
        self._data = data  # keeps the memory file alive: an aligned copy of the model is written from it
        self._info: Optional[Dict[str, Any]] = None

    def info(self) -> Dict[str, Any]:
        """Schema "umbilic.info/1": units, faces by kind, area (mm^2), volume (mm^3), what was skipped or repaired."""
        if self._info is None:
            self._info = json.loads(self.native.info_json())
        return self._info

    def mesh(self) -> Tuple[np.ndarray, np.ndarray]:
        """Points (n, 3) in mm and triangles (m, 3), indices from 0. For pictures: nothing is measured on them."""
        return self.native.mesh()

    def __repr__(self) -> str:
        about = self.info()["input"]
        return f"<umbilic.Model {about['path']}: {about['faces']} faces>"


class Points:
    """Measured points, with the triangles between them if they are a mesh. Made by `read`."""

    def __init__(self, native: Any):
        self.native = native
        self._info: Optional[Dict[str, Any]] = None

    @property
    def points(self) -> np.ndarray:
        """(n, 3), mm; without those that are not finite or repeat another one."""
        return self.native.points()

    @property
    def triangles(self) -> np.ndarray:
        """(m, 3), indices from 0; (0, 3) of a cloud."""
        return self.native.triangles()

    def info(self) -> Dict[str, Any]:
        """What was read and left out, as the "input" of results has it."""
        if self._info is None:
            self._info = json.loads(self.native.info_json())
        return self._info

    def mesh(self) -> Tuple[np.ndarray, np.ndarray]:
        """Points and triangles, as `Model.mesh` gives them."""
        return self.points, self.triangles

    def __repr__(self) -> str:
        about = self.info()
        return f"<umbilic.Points {about['path']}: {about['points']} points, {about['triangles']} triangles>"


ModelLike = Union[str, "os.PathLike[str]", Model, ShapeData, Any]
ShapeLike = Union[ModelLike, Points, np.ndarray]


def points(source: Any, *, triangles: Optional[np.ndarray] = None, label: str = "points",
           progress: Progress = None) -> Points:
    """Measured points from a file (.xyz .csv .asc .ply .stl .obj by content), an array (n, 3) in mm, or a FreeCAD
    `Mesh.Mesh` or `Points.Points`; `triangles` (m, 3), indices from 0, make an array a mesh.

    Raises InvalidInput (missing or damaged file, wrong shape, no finite point), Cancelled.
    """
    if isinstance(source, Points):
        return source
    if isinstance(source, (str, os.PathLike)):
        return Points(_native.read_points(os.fspath(source), progress))
    if hasattr(source, "Topology") and hasattr(source, "Facets"):  # Mesh.Mesh
        corners, triangles = source.Topology
        source = [tuple(corner) for corner in corners]
    elif hasattr(source, "Points") and hasattr(source, "CountPoints"):  # Points.Points
        source = [tuple(point) for point in source.Points]
    array = np.asarray(source, dtype=float)
    corners = None if triangles is None else np.asarray(triangles, dtype=np.int32).reshape(-1, 3)
    return Points(_native.points_from(array, corners, label))


def _is_points(source: Any) -> bool:
    return isinstance(source, (Points, np.ndarray)) or hasattr(source, "Facets") or hasattr(source, "CountPoints")


def read(source: ShapeLike, *, seconds: float = READING_SECONDS, progress: Progress = None) -> Union[Model, Points]:
    """Reads a path, a FreeCAD shape or its snapshot, or measured points: a path to them (told by content), an array
    (n, 3), a FreeCAD `Mesh.Mesh` or `Points.Points`. A Model or Points are returned as they are.

    The kernel works in a child process that may take `seconds`, so that nothing a file contains can end the caller.
    Raises InvalidInput (missing, neither CAD nor points, truncated, no face), NumericFailure (time or memory limit), Cancelled.
    """
    if isinstance(source, Model):
        return source
    if _is_points(source):
        return points(source)
    if isinstance(source, (str, os.PathLike)):
        if _native.holds_points(os.fspath(source)):
            return points(source, progress=progress)
        return Model(_native.read(os.fspath(source), "", seconds, progress), None)
    data = source if isinstance(source, ShapeData) else ShapeData(source)
    return Model(_native.read(data.path, data.label, seconds, progress), data)


def read_model(source: ModelLike, *, seconds: float = READING_SECONDS, progress: Progress = None) -> Model:
    """`read` for what needs surfaces: raises InvalidInput for measured points."""
    model = read(source, seconds=seconds, progress=progress)
    if isinstance(model, Points):
        raise _native.InvalidInput(f"{model.info()['path']}: holds measured points; fit a surface first (umbilic.fit)")
    return model


def info(source: ModelLike, *, seconds: float = READING_SECONDS, progress: Progress = None) -> Dict[str, Any]:
    """What a model holds, as a dict with schema "umbilic.info/1". Arguments and errors as for `read`."""
    return read_model(source, seconds=seconds, progress=progress).info()


def part_of(progress: Progress, low: float, high: float) -> Progress:
    """A callback whose range 0..1 is the part low..high of another one's."""
    if progress is None:
        return None
    return lambda fraction, text: progress(low + (high - low) * fraction, text)
