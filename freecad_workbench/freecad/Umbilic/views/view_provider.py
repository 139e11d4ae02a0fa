# SPDX-License-Identifier: LGPL-2.1-or-later
"""What all view providers share: drawn anew from the properties of their object, with nothing stored in themselves."""

import os
from typing import Any

from pivy import coin

_ICONS = os.path.join(os.path.dirname(os.path.dirname(__file__)), "resources", "icons")


class StoredView:
    """View provider of an object whose picture is made from its properties by `rebuild`."""

    icon = ""
    """Name of a file in resources/icons."""

    def __init__(self, vobj: Any):
        vobj.Proxy = self

    def attach(self, vobj: Any) -> None:
        self.Object = vobj.Object
        self.add_view_properties(vobj)
        self.root = coin.SoSeparator()
        vobj.addDisplayMode(self.root, "Overlay")

    def add_view_properties(self, vobj: Any) -> None:
        """Adds what the user may change of the picture."""

    def rebuild(self) -> None:
        """Draws the picture from the object's properties."""

    def onChanged(self, vobj: Any, name: str) -> None:
        if hasattr(self, "root") and name in self.redrawn_by and set(self.redrawn_by) <= set(vobj.PropertiesList):
            self.rebuild()

    redrawn_by: tuple = ()
    """View properties that change the picture."""

    def getDisplayModes(self, vobj: Any) -> list:
        return ["Overlay"]

    def getDefaultDisplayMode(self) -> str:
        return "Overlay"

    def setDisplayMode(self, mode: str) -> str:
        return mode

    def getIcon(self) -> str:
        return os.path.join(_ICONS, self.icon)

    def dumps(self) -> None:
        return None

    def loads(self, state: Any) -> None:
        return None

    __getstate__ = dumps
    __setstate__ = loads


def unpickable() -> coin.SoNode:
    """Node that leaves what lies below the picture selectable."""
    style = coin.SoPickStyle()
    style.style = coin.SoPickStyle.UNPICKABLE
    return style


def colored(rgb: tuple) -> coin.SoNode:
    """Node for lines in exactly this colour."""
    color = coin.SoBaseColor()
    color.rgb = rgb
    return color
