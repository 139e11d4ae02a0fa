# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves on faces as coloured lines in front of the model."""

from typing import Any

from .colors import CURVES
from .line_nodes import add_lines, in_front
from .view_provider import StoredView, unpickable


class CurvesView(StoredView):
    """One line a curve, coloured by its family."""

    icon = "Umbilic_Geodesic.svg"
    redrawn_by = ("LineWidth",)

    def add_view_properties(self, vobj: Any) -> None:
        if "LineWidth" not in vobj.PropertiesList:
            vobj.addProperty("App::PropertyFloat", "LineWidth", "Curves", "Width of the lines, pixels")
            vobj.LineWidth = 3.0

    def getIcon(self) -> str:
        kind = getattr(self.Object, "Kind", "geodesic")
        self.icon = {"lines-of-curvature": "Umbilic_LinesOfCurvature.svg", "project": "Umbilic_ProjectCurve.svg"}.get(
            kind, "Umbilic_Geodesic.svg")
        return super().getIcon()

    def rebuild(self) -> None:
        obj, vobj = self.Object, self.Object.ViewObject
        self.root.removeAllChildren()
        if not hasattr(obj, "Result"):
            return  # not all properties are there yet
        self.root.addChild(unpickable())
        lines = in_front(vobj.LineWidth)
        add_lines(lines, obj.Points, obj.PointCounts, [CURVES[family] for family in obj.Families])
        self.root.addChild(lines)
