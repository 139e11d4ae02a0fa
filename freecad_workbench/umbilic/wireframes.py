# SPDX-License-Identifier: LGPL-2.1-or-later
"""The shape-intrinsic wireframe of a model: nodes, edges and cells that depend on the shape alone."""

from __future__ import annotations

import copy
import json
import os
from typing import Any, Dict, List, Optional

import numpy as np

from . import _native
from .models import READING_SECONDS, ModelLike, Progress, part_of, read_model

EDGE_KINDS = ("maximum", "minimum", "geodesic", "boundary")
""""maximum" and "minimum" are parts of lines of curvature, "geodesic" joins nodes they leave alone."""


class Wireframe:
    """Nodes, edges and cells of a model, face by face."""

    def __init__(self, result: Dict[str, Any]):
        self._result = result

    @property
    def step(self) -> float:
        """Distance of neighbouring lines, mm."""
        return self._result["step"]

    @property
    def faces(self) -> List[Dict[str, Any]]:
        """One entry a face, as in the JSON result: nodes, edges, cells, coverage."""
        return self._result["faces"]

    @property
    def points(self) -> np.ndarray:
        """The nodes of all faces, (n, 3), mm. Faces share the nodes on their common edges, which stand once for each."""
        points = [node["point"] for face in self.faces for node in face["nodes"]]
        return np.array(points, dtype=float).reshape(-1, 3)

    @property
    def coverage(self) -> float:
        """The least share of a face's area that lies within a step of a node."""
        return min((face["coverage"] for face in self.faces), default=0.0)

    @property
    def source_name(self) -> str:
        """Name of the file or shape, without its folder."""
        return os.path.basename(self._result["input"]["path"])

    def lines(self, kind: str) -> List[np.ndarray]:
        """The edges of a kind ("maximum", "minimum", "geodesic" or "boundary"), each as points (k, 3) in mm, to be
        drawn."""
        if kind not in EDGE_KINDS:
            raise ValueError(f"no kind of edge: {kind!r}; there are {', '.join(EDGE_KINDS)}")
        result = []
        for face in self.faces:
            points = [node["point"] for node in face["nodes"]]
            for edge in face["edges"]:
                if edge["kind"] == kind:
                    result.append(np.array([points[edge["from"]], *edge["between"], points[edge["to"]]], dtype=float))
        return result

    def to_dict(self) -> Dict[str, Any]:
        """The result with schema "umbilic.wireframe/1", the same as the command `umbilic wireframe` gives."""
        return copy.deepcopy(self._result)

    def __repr__(self) -> str:
        return f"<umbilic.Wireframe: {len(self.points)} nodes on {len(self.faces)} faces, step {self.step:.6g} mm>"


def wireframe(
    source: ModelLike,
    *,
    face: Optional[int] = None,
    step: Optional[float] = None,
    relative_step: Optional[float] = None,
    seconds: float = READING_SECONDS,
    progress: Progress = None,
) -> Wireframe:
    """Meshes the faces of a model, or its face with the number `face` (from 1), by lines of curvature and geodesics.

    `step` is the distance of neighbouring lines in mm; `relative_step` the same relative to the square root of the
    model's area (default 0.05). A face that cannot be meshed says "why". Raises InvalidInput if the model cannot be
    read, has no such face, or a length is not finite and positive, and Cancelled.
    """
    model = read_model(source, seconds=seconds, progress=part_of(progress, 0.0, 0.1))
    found = _native.wireframe_json(model.native, face, step, relative_step, part_of(progress, 0.1, 1.0))
    return Wireframe(json.loads(found))
