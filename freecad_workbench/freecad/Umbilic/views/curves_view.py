# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves on faces as coloured lines in front of the model."""

from typing import Any

from pivy import coin

from .colors import CURVES
from .view_provider import StoredView, colored, unpickable


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
        lines = coin.SoAnnotation()  # in front: the triangles of the model cut through lines on its true surface
        light = coin.SoLightModel()
        light.model = coin.SoLightModel.BASE_COLOR
        style = coin.SoDrawStyle()
        style.lineWidth = vobj.LineWidth
        coordinates = coin.SoCoordinate3()
        coordinates.point.setValues(0, len(obj.Points), [tuple(point) for point in obj.Points])
        for node in (light, style, coordinates):
            lines.addChild(node)
        first = 0
        for family, count in zip(obj.Families, obj.PointCounts):
            line = coin.SoLineSet()
            line.startIndex = first
            line.numVertices.setValues(0, 1, [int(count)])
            lines.addChild(colored(CURVES[family]))
            lines.addChild(line)
            first += int(count)
        self.root.addChild(lines)
