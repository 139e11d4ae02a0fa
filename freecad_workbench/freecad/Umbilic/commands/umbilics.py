# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command that finds umbilical points."""

import FreeCADGui as Gui
from PySide.QtCore import QT_TRANSLATE_NOOP

from ..panels.umbilics_panel import UmbilicsPanel


class UmbilicsCommand:
    def GetResources(self) -> dict:
        return {
            "Pixmap": "Umbilic_Umbilics",
            "MenuText": QT_TRANSLATE_NOOP("Umbilic_Umbilics", "Find umbilics…"),
            "ToolTip": QT_TRANSLATE_NOOP(
                "Umbilic_Umbilics", "Finds the points at which a surface bends equally in all directions"),
        }

    def IsActive(self) -> bool:
        return not Gui.Control.activeDialog()

    def Activated(self) -> None:
        Gui.Control.showDialog(UmbilicsPanel())
