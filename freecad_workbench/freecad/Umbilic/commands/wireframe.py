# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command that draws the shape-intrinsic wireframe."""

import FreeCADGui as Gui
from PySide.QtCore import QT_TRANSLATE_NOOP

from ..panels.wireframe_panel import WireframePanel


class WireframeCommand:
    def GetResources(self) -> dict:
        return {
            "Pixmap": "Umbilic_Wireframe",
            "MenuText": QT_TRANSLATE_NOOP("Umbilic_Wireframe", "Wireframe…"),
            "ToolTip": QT_TRANSLATE_NOOP(
                "Umbilic_Wireframe", "Draws nodes and lines that depend on the shape alone, not on how it is described"),
        }

    def IsActive(self) -> bool:
        return not Gui.Control.activeDialog()

    def Activated(self) -> None:
        Gui.Control.showDialog(WireframePanel())
