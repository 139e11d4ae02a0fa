# SPDX-License-Identifier: LGPL-2.1-or-later
"""Painted images in the 3D view: legends in a corner, marks at points. They keep their size in pixels."""

from typing import Callable

from pivy import coin

from ..compat import QtCore, QtGui


def painted(width: int, height: int, paint: Callable[[QtGui.QPainter], None]) -> QtGui.QImage:
    """A transparent image, painted by `paint`."""
    image = QtGui.QImage(width, height, QtGui.QImage.Format_RGBA8888)
    image.fill(QtCore.Qt.transparent)
    painter = QtGui.QPainter(image)
    painter.setRenderHint(QtGui.QPainter.Antialiasing)
    paint(painter)
    painter.end()
    return image


def image_node(image: QtGui.QImage, horizontal: int, vertical: int) -> coin.SoNode:
    """Node that shows an image at the current point, aligned to it by SoImage's constants."""
    upward = image.mirrored(False, True)
    node = coin.SoImage()
    node.image.setValue(coin.SbVec2s(image.width(), image.height()), 4, bytes(upward.constBits()))
    node.horAlignment = horizontal
    node.vertAlignment = vertical
    return node


def in_corner(node: coin.SoNode, x: float, y: float) -> coin.SoNode:
    """The node at (x, y) of the viewport, both from -1 to 1, in front of everything."""
    camera = coin.SoOrthographicCamera()
    camera.viewportMapping = coin.SoCamera.LEAVE_ALONE
    camera.height = 2
    camera.aspectRatio = 1
    camera.position = (0, 0, 1)
    camera.nearDistance = 0
    camera.farDistance = 2
    place = coin.SoTranslation()
    place.translation = (x, y, 0)
    front = coin.SoAnnotation()
    for child in (camera, place, node):
        front.addChild(child)
    return without_extent(front)


def without_extent(node: coin.SoNode) -> coin.SoNode:
    """The node in a group that does not count when the view is fitted to what it shows."""
    kind = coin.SoType.fromName("SoSkipBoundingGroup")  # FreeCAD's own
    if kind.isBad():
        return node
    group = kind.createInstance()
    group.addChild(node)
    return group
