# SPDX-License-Identifier: LGPL-2.1-or-later
"""A wireframe as coloured lines and dots in front of the model."""

from typing import Any

from .colors import CURVES, NODE
from .line_nodes import add_lines, add_points, in_front
from .view_provider import StoredView, unpickable


class WireframeView(StoredView):
    """Lines coloured by their kind, and a dot for each node."""

    icon = "Umbilic_Wireframe.svg"
    redrawn_by = ("LineWidth", "ShowNodes")

    def add_view_properties(self, vobj: Any) -> None:
        if "LineWidth" not in vobj.PropertiesList:
            vobj.addProperty("App::PropertyFloat", "LineWidth", "Wireframe", "Width of the lines, pixels")
            vobj.LineWidth = 1.5
            vobj.addProperty("App::PropertyBool", "ShowNodes", "Wireframe", "Show the nodes")
            vobj.ShowNodes = True

    def rebuild(self) -> None:
        obj, vobj = self.Object, self.Object.ViewObject
        self.root.removeAllChildren()
        if not hasattr(obj, "Result"):
            return  # not all properties are there yet
        self.root.addChild(unpickable())
        node = in_front(vobj.LineWidth)
        add_lines(node, obj.EdgePoints, obj.PointCounts, [CURVES[kind] for kind in obj.Kinds])
        if vobj.ShowNodes and obj.Points:
            add_points(node, obj.Points, NODE)
        self.root.addChild(node)
