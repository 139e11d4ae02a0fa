# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fitting a NURBS surface to measured points."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, Optional, Tuple

import numpy as np

from . import _native
from .models import Points, Progress, part_of
from .models import points as read_points


class Fit:
    """Result of `fit`: the surface and what it leaves of the points."""

    def __init__(self, native: Any, call: str):
        self.native = native
        self._call = call
        self._output = ""
        columns = native.points()
        self.points: np.ndarray = columns["points"]
        """(n, 3), mm: the points that were fitted, after the low-pass filter if there was one."""
        self.parameters: np.ndarray = columns["parameters"]
        """(n, 2): parameters u, v in [0, 1] of their foot points."""
        self.distances: np.ndarray = columns["distance"]
        """(n,), mm: signed distances from the surface, positive on the side of r_u x r_v."""

    @property
    def surface(self) -> Dict[str, Any]:
        """Degree, numbers of poles, knots and control points, as in the JSON result."""
        return self.to_dict()["surface"]

    @property
    def control_points(self) -> np.ndarray:
        """(m, n, 3), mm."""
        return np.array(self.surface["control_points"], dtype=float)

    @property
    def rms(self) -> float:
        """Root mean square of the distances, mm."""
        return self.to_dict()["residuals"]["rms"]

    @property
    def noise(self) -> float:
        """Noise of the points (standard deviation along the normal, mm) as polynomials over neighbourhoods see it."""
        return self.to_dict()["noise"]

    def write(self, path: "str | os.PathLike[str]") -> None:
        """Writes the surface as a STEP file in mm, which appears whole or not at all. Raises NumericFailure."""
        self.native.write_step(os.fspath(path))
        self._output = os.fspath(path)

    def report(self, directory: "str | os.PathLike[str]", *, progress: Progress = None) -> str:
        """Writes report.html and fit.json into a folder, which is made; returns the path of the page. Raises
        NumericFailure, Cancelled; then nothing was written."""
        return _native.write_fit_report(self.native, os.fspath(directory), self._call, progress)

    def to_dict(self) -> Dict[str, Any]:
        """The result with schema "umbilic.fit/1", the same as the command `umbilic fit` gives."""
        return json.loads(self.native.json(self._output))

    def __repr__(self) -> str:
        residuals = self.to_dict()["residuals"]
        return f"<umbilic.Fit: {residuals['count']} points, rms {residuals['rms']:.3g} mm>"


def fit(
    points: Any,
    *,
    method: str = "scattered",
    degree: int = 3,
    net: Optional[Tuple[int, int]] = None,
    grid: Optional[Tuple[int, int]] = None,
    tolerance: Optional[float] = None,
    smooth: Optional[float] = None,
    most_poles: int = 64,
    most_points: int = 100_000,
    seed: int = 0,
    progress: Progress = None,
) -> Fit:
    """Fits a NURBS surface to points: anything that `points` takes, or a grid as an array (rows, columns, 3).

    method       "scattered" (least squares over a base surface) or "multilevel" (multilevel B-splines)
    degree       of the surface in u and v
    net          control points along u and v; None: grown until the residual is noise, or within `tolerance`
    grid         (rows, columns) in which the points stand row by row; taken from an array (rows, columns, 3)
    tolerance    greatest distance of a point from the surface, mm, at which the net grows no more
    smooth       standard deviation of a Gaussian low-pass filter before the fit, mm
    most_poles   control points along either direction at most
    most_points  points of a larger cloud that are used, chosen at random by `seed`

    Raises InvalidInput (too few points, numbers out of range), Unsupported (points that fold over their plane: cut them
    into pieces, or give a grid), NumericFailure, Cancelled.
    """
    if isinstance(points, np.ndarray) and points.ndim == 3:
        grid = points.shape[:2] if grid is None else grid
        points = points.reshape(-1, points.shape[2])
    cloud: Points = read_points(points, progress=part_of(progress, 0.0, 0.1))
    native = _native.fit(cloud.native, method, degree, net, grid, tolerance, smooth, most_poles, most_points, seed,
                         part_of(progress, 0.1, 1.0))
    options = {"method": method, "degree": degree, "net": net, "grid": grid, "tolerance": tolerance, "smooth": smooth}
    words = [repr(cloud.info()["path"])] + [f"{name}={value!r}" for name, value in options.items() if value is not None]
    return Fit(native, f"umbilic.fit({', '.join(words)})")
