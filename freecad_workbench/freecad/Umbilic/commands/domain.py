# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command that opens the window of a face's parameter domain."""

import FreeCAD as App
import FreeCADGui as Gui
from PySide.QtCore import QT_TRANSLATE_NOOP

from .. import shapes
from ..panels.domain_window import open_domain_window


class DomainCommand:
    def GetResources(self) -> dict:
        return {
            "Pixmap": "Umbilic_Domain",
            "MenuText": QT_TRANSLATE_NOOP("Umbilic_Domain", "Parameter domain"),
            "ToolTip": QT_TRANSLATE_NOOP(
                "Umbilic_Domain", "Shows the parameter domain of the selected face, to set nodes and join them by geodesics"),
        }

    def IsActive(self) -> bool:
        return self._chosen() is not None

    def Activated(self) -> None:
        obj, face = self._chosen()
        open_domain_window(obj, face)

    @staticmethod
    def _chosen():
        """Selected object and face; nodes stand for their own."""
        if App.ActiveDocument is None:
            return None
        for selected in Gui.Selection.getSelectionEx():
            obj = selected.Object
            if hasattr(obj, "EdgeParameters") and obj.Source is not None:
                return obj, obj.Face
            if shapes.has_faces(obj):
                faces = [int(name[4:]) for name in selected.SubElementNames if name.startswith("Face")]
                return obj, faces[0] if faces else 1
        return None
