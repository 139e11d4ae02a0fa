# SPDX-License-Identifier: LGPL-2.1-or-later
"""A comparison in the tree: its pictures below it, its verdict on a double click."""

from typing import Any

import FreeCADGui as Gui

from .view_provider import StoredView


class ComparisonView(StoredView):
    """Holds the pictures of a comparison together; has none of its own."""

    icon = "Umbilic_Compare.svg"

    def claimChildren(self) -> list:
        return list(getattr(self.Object, "Pictures", None) or [])

    def onChanged(self, vobj: Any, name: str) -> None:
        """Shows and hides the pictures with the comparison."""
        if name == "Visibility" and hasattr(self, "Object"):
            for picture in self.claimChildren():
                picture.ViewObject.Visibility = vobj.Visibility

    def doubleClicked(self, vobj: Any) -> bool:
        from ..panels.result_panel import ResultPanel

        Gui.Control.closeDialog()
        Gui.Control.showDialog(ResultPanel(self.Object))
        return True
