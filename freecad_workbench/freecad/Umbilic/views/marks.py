# SPDX-License-Identifier: LGPL-2.1-or-later
"""The mark of an umbilic: a shape and a colour for each type, filled or as an outline."""

import math

from ..compat import QtCore, QtGui
from .colors import UMBILICS
from .image_node import painted


def _regular(corners: int, inner: float = 1.0) -> QtGui.QPolygonF:
    """Polygon with radius 1 whose every second corner lies at radius `inner` if that is not 1."""
    count = corners if inner == 1.0 else 2 * corners
    points = []
    for i in range(count):
        radius = inner if inner != 1.0 and i % 2 else 1.0
        angle = 2 * math.pi * i / count - math.pi / 2
        points.append(QtCore.QPointF(radius * math.cos(angle), radius * math.sin(angle)))
    return QtGui.QPolygonF(points)


def _lens() -> QtGui.QPainterPath:
    path = QtGui.QPainterPath(QtCore.QPointF(-1.0, 0.0))
    path.quadTo(QtCore.QPointF(0.0, -1.3), QtCore.QPointF(1.0, 0.0))
    path.quadTo(QtCore.QPointF(0.0, 1.3), QtCore.QPointF(-1.0, 0.0))
    return path


def _outline(kind: str) -> QtGui.QPainterPath:
    path = QtGui.QPainterPath()
    if kind == "star":
        path.addPolygon(_regular(3, inner=0.3))
    elif kind == "monstar":
        path.addPolygon(_regular(3))
    elif kind == "lemon":
        return _lens()
    else:
        path.addPolygon(_regular(4))
    path.closeSubpath()
    return path


def paint_mark(painter: QtGui.QPainter, kind: str, filled: bool, x: float, y: float, size: float) -> None:
    """Paints the mark of a type around (x, y): filled with a dark border, or as a ring that leaves the middle free."""
    color = QtGui.QColor.fromRgbF(*UMBILICS.get(kind, UMBILICS["non-generic"]))
    painter.save()
    painter.translate(x, y)
    radius = 0.5 * size - 2.0
    if not filled:
        painter.setBrush(QtCore.Qt.NoBrush)
        for pen in (QtGui.QPen(QtGui.QColor("white"), 4.5), QtGui.QPen(color, 2.5)):
            painter.setPen(pen)
            painter.drawEllipse(QtCore.QPointF(0, 0), radius, radius)
    else:
        painter.scale(radius, radius)
        for pen in (QtGui.QPen(QtGui.QColor("white"), 3.0 / radius), QtGui.QPen(color.darker(160), 1.0 / radius)):
            pen.setJoinStyle(QtCore.Qt.RoundJoin)
            painter.setPen(pen)
            painter.setBrush(color)
            painter.drawPath(_outline(kind))
    painter.restore()


def mark_image(kind: str, filled: bool, size: int) -> QtGui.QImage:
    """The mark as an image; a ring is larger, so that it surrounds a filled mark at the same place."""
    edge = size if filled else int(1.6 * size)
    middle = edge / 2 + 1
    return painted(edge + 2, edge + 2, lambda painter: paint_mark(painter, kind, filled, middle, middle, edge))
