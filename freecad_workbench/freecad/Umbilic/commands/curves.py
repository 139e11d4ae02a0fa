# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands that draw single curves on faces."""

import FreeCADGui as Gui
from PySide.QtCore import QT_TRANSLATE_NOOP

from ..panels.curves_panel import GeodesicPanel, LinesOfCurvaturePanel, ProjectCurvePanel


class _CurveCommand:
    panel = None

    def IsActive(self) -> bool:
        return not Gui.Control.activeDialog()

    def Activated(self) -> None:
        Gui.Control.showDialog(self.panel())


class LinesOfCurvatureCommand(_CurveCommand):
    panel = LinesOfCurvaturePanel

    def GetResources(self) -> dict:
        return {
            "Pixmap": "Umbilic_LinesOfCurvature",
            "MenuText": QT_TRANSLATE_NOOP("Umbilic_LinesOfCurvature", "Lines of curvature…"),
            "ToolTip": QT_TRANSLATE_NOOP(
                "Umbilic_LinesOfCurvature", "Draws the lines of greatest and least curvature through a point"),
        }


class GeodesicCommand(_CurveCommand):
    panel = GeodesicPanel

    def GetResources(self) -> dict:
        return {
            "Pixmap": "Umbilic_Geodesic",
            "MenuText": QT_TRANSLATE_NOOP("Umbilic_Geodesic", "Geodesic…"),
            "ToolTip": QT_TRANSLATE_NOOP("Umbilic_Geodesic", "Draws the shortest curves between two points of a surface"),
        }


class ProjectCurveCommand(_CurveCommand):
    panel = ProjectCurvePanel

    def GetResources(self) -> dict:
        return {
            "Pixmap": "Umbilic_ProjectCurve",
            "MenuText": QT_TRANSLATE_NOOP("Umbilic_ProjectCurve", "Project curve…"),
            "ToolTip": QT_TRANSLATE_NOOP(
                "Umbilic_ProjectCurve", "Projects selected curves at right angles onto a face"),
        }
