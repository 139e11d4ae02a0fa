# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coin nodes for lines and points in front of a model."""

from itertools import groupby
from typing import Any, Sequence

from pivy import coin

from .view_provider import colored


def in_front(width: float) -> Any:
    """Separator for lines of this width (pixels) in exact colours: the model's triangles do not cut through them."""
    node = coin.SoAnnotation()
    light = coin.SoLightModel()
    light.model = coin.SoLightModel.BASE_COLOR
    style = coin.SoDrawStyle()
    style.lineWidth = width
    style.pointSize = 3 * width
    node.addChild(light)
    node.addChild(style)
    return node


def add_lines(node: Any, points: Sequence, counts: Sequence, colors: Sequence[tuple]) -> None:
    """Adds polylines that share a list of points, one after the other, each with its colour."""
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(points), [tuple(point) for point in points])
    node.addChild(coordinates)
    first = 0
    for color, group in groupby(zip(colors, counts), key=lambda one: one[0]):
        lengths = [int(count) for _, count in group]
        lines = coin.SoLineSet()
        lines.startIndex = first
        lines.numVertices.setValues(0, len(lengths), lengths)
        node.addChild(colored(color))
        node.addChild(lines)
        first += sum(lengths)


def add_points(node: Any, points: Sequence, color: tuple) -> None:
    """Adds points of one colour."""
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(points), [tuple(point) for point in points])
    dots = coin.SoPointSet()
    dots.numPoints = len(points)
    for child in (coordinates, colored(color), dots):
        node.addChild(child)
