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


ModelLike = Union[str, "os.PathLike[str]", Model, ShapeData, Any]


def read(source: ModelLike, *, seconds: float = READING_SECONDS, progress: Progress = None) -> Model:
    """Reads a path, a FreeCAD shape or its snapshot; a Model is returned as it is.

    The kernel works in a child process that may take `seconds`, so that nothing a file contains can end the caller.
    Raises InvalidInput (missing, not a CAD file, truncated, no face), NumericFailure (time or memory limit), Cancelled.
    """
    if isinstance(source, Model):
        return source
    if isinstance(source, (str, os.PathLike)):
        return Model(_native.read(os.fspath(source), "", seconds, progress), None)
    data = source if isinstance(source, ShapeData) else ShapeData(source)
    return Model(_native.read(data.path, data.label, seconds, progress), data)


def info(source: ModelLike, *, seconds: float = READING_SECONDS, progress: Progress = None) -> Dict[str, Any]:
    """What a model holds, as a dict with schema "umbilic.info/1". Arguments and errors as for `read`."""
    return read(source, seconds=seconds, progress=progress).info()


def part_of(progress: Progress, low: float, high: float) -> Progress:
    """A callback whose range 0..1 is the part low..high of another one's."""
    if progress is None:
        return None
    return lambda fraction, text: progress(low + (high - low) * fraction, text)
