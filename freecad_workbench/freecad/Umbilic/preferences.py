# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every preference of the workbench, with its default."""

import FreeCAD as App

_PATH = "User parameter:BaseApp/Preferences/Mod/Umbilic"


def last_folder() -> str:
    """Folder from which a file was last chosen."""
    return App.ParamGet(_PATH).GetString("LastFolder", "")


def set_last_folder(folder: str) -> None:
    App.ParamGet(_PATH).SetString("LastFolder", folder)


def glyph_size() -> int:
    """Size of the mark of an umbilic, pixels."""
    return App.ParamGet(_PATH).GetInt("GlyphSize", 17)
