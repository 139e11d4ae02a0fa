# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shapes of document objects, in the coordinates of the document."""

from typing import Any, List

import umbilic


def has_faces(obj: Any) -> bool:
    """Whether an object has a shape with faces."""
    shape = getattr(obj, "Shape", None)
    return shape is not None and hasattr(shape, "exportBinary") and not shape.isNull() and bool(shape.Faces)


def is_measured(obj: Any) -> bool:
    """Whether an object is a mesh or a cloud of points."""
    return obj.isDerivedFrom("Mesh::Feature") or obj.isDerivedFrom("Points::Feature")


def global_shape(obj: Any) -> Any:
    """The object's shape where the view shows it, placements of its parents included."""
    if not has_faces(obj):
        raise umbilic.InvalidInput(f"{obj.Label}: has no faces; choose a body, a part or a surface")
    shape = obj.Shape.copy()
    if hasattr(obj, "getGlobalPlacement"):
        shape.Placement = obj.getGlobalPlacement()
    return shape


def snapshot(obj: Any) -> "umbilic.ShapeData | umbilic.Points":
    """The shape, or the measured points with the object's own placement, as data that a thread may read."""
    if is_measured(obj):
        kernel = obj.Mesh if obj.isDerivedFrom("Mesh::Feature") else obj.Points
        return umbilic.points(kernel, label=obj.Label)
    return umbilic.ShapeData(global_shape(obj), obj.Label)


def fingerprint(obj: Any) -> str:
    """Text that changes when the shape does: to tell whether a stored result still belongs to it."""
    if is_measured(obj):
        kernel = obj.Mesh if obj.isDerivedFrom("Mesh::Feature") else obj.Points
        box = kernel.BoundBox
        return f"{kernel.CountPoints} points; {box.DiagonalLength:.9g} {box.Center}"
    shape = global_shape(obj)
    numbers: List[float] = [shape.Area, shape.Volume, shape.BoundBox.DiagonalLength]
    numbers += list(shape.BoundBox.Center)
    return f"{len(shape.Faces)} faces; " + " ".join(f"{number:.9g}" for number in numbers)
