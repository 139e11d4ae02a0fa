# SPDX-License-Identifier: LGPL-2.1-or-later
"""A point of a face: picked in the 3D view, or written as numbers."""

from typing import Any, List, Optional, Tuple

import FreeCADGui as Gui

from .. import shapes


def picked_points() -> List[Tuple[Any, int, float, float]]:
    """Object, face number, u and v of every point at which a selected face was picked, in the order of picking."""
    found = []
    for selected in Gui.Selection.getSelectionEx():
        if not shapes.has_faces(selected.Object):
            continue
        shape = shapes.global_shape(selected.Object)
        for name, point in zip(selected.SubElementNames, selected.PickedPoints):
            if name.startswith("Face"):
                number = int(name[len("Face"):])
                u, v = shape.Faces[number - 1].Surface.parameter(point)
                found.append((selected.Object, number, u, v))
    return found


class FacePoint:
    """The fields face, u and v of one point."""

    def __init__(self, face: Any, u: Any, v: Any):
        self._face, self._u, self._v = face, u, v

    def set(self, face: int, u: float, v: float) -> None:
        self._face.setValue(face)
        self._u.setValue(u)
        self._v.setValue(v)

    @property
    def face(self) -> int:
        return self._face.value()

    @property
    def parameters(self) -> Tuple[float, float]:
        return self._u.value(), self._v.value()


def set_middle(point: FacePoint, obj: Optional[Any], face: int = 1) -> None:
    """The middle of a face's parameter range, as a place to begin from."""
    if obj is None or not shapes.has_faces(obj):
        return
    u0, u1, v0, v1 = obj.Shape.Faces[face - 1].ParameterRange
    point.set(face, 0.5 * (u0 + u1), 0.5 * (v0 + v1))
