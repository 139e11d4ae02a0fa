# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes as dots and their edges as lines in front of the model."""

from typing import Any

from .colors import CURVES, NODE
from .line_nodes import add_lines, add_points, in_front
from .view_provider import StoredView, unpickable


class NodesView(StoredView):
    """Dots and geodesics."""

    icon = "Umbilic_Domain.svg"
    redrawn_by = ("LineWidth",)

    def add_view_properties(self, vobj: Any) -> None:
        if "LineWidth" not in vobj.PropertiesList:
            vobj.addProperty("App::PropertyFloat", "LineWidth", "Nodes", "Width of the lines, pixels")
            vobj.LineWidth = 3.0

    def updateData(self, obj: Any, name: str) -> None:
        if name in ("Points", "Ends") and hasattr(self, "root"):
            self.rebuild()

    def rebuild(self) -> None:
        obj = self.Object
        self.root.removeAllChildren()
        if not hasattr(obj, "EdgeParameters"):
            return  # not all properties are there yet
        self.root.addChild(unpickable())
        node = in_front(obj.ViewObject.LineWidth)
        if obj.PointCounts:
            add_lines(node, obj.EdgePoints, obj.PointCounts, [CURVES["geodesic"]] * len(obj.PointCounts))
        if obj.Points:
            add_points(node, obj.Points, NODE)
        self.root.addChild(node)
