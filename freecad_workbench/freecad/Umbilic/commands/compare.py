# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command that compares two models."""

import FreeCADGui as Gui
from PySide.QtCore import QT_TRANSLATE_NOOP

from ..panels.compare_panel import ComparePanel


class CompareCommand:
    def GetResources(self) -> dict:
        return {
            "Pixmap": "Umbilic_Compare",
            "MenuText": QT_TRANSLATE_NOOP("Umbilic_Compare", "Compare models…"),
            "ToolTip": QT_TRANSLATE_NOOP(
                "Umbilic_Compare", "Tells whether a model, or a piece of it, is a copy of another one. "
                "Select the original, then the suspect, or choose files"),
        }

    def IsActive(self) -> bool:
        return not Gui.Control.activeDialog()

    def Activated(self) -> None:
        Gui.Control.showDialog(ComparePanel())
