# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the proxies of all document objects share."""

from typing import Any

import FreeCAD as App

SCHEMA_VERSION = 1

_HIDDEN = 4
_READ_ONLY = 1


class StoredProxy:
    """Behaviour of an object whose results are stored: nothing of value is kept here."""

    view_provider = ""
    """Name of its class in `views`."""

    def __init__(self, obj: Any):
        obj.Proxy = self
        add(obj, "App::PropertyInteger", "SchemaVersion", "Umbilic", "Version of the set of properties", hidden=True)
        obj.SchemaVersion = SCHEMA_VERSION

    def execute(self, obj: Any) -> None:
        """Results are stored; opening or recomputing a document does not compute them again."""

    def onDocumentRestored(self, obj: Any) -> None:
        if not App.GuiUp:
            return
        from .. import views

        if views.attach(obj):
            # A document written without a window has no view providers, and FreeCAD hides what has none.
            obj.ViewObject.Visibility = True
        obj.ViewObject.Proxy.rebuild()

    def dumps(self) -> None:
        return None

    def loads(self, state: Any) -> None:
        return None

    __getstate__ = dumps
    __setstate__ = loads


def add(obj: Any, kind: str, name: str, group: str, text: str, hidden: bool = False, editable: bool = False) -> None:
    """Adds a property that the property editor shows but, unless `editable`, does not change."""
    if name not in obj.PropertiesList:
        obj.addProperty(kind, name, group, text, (_HIDDEN if hidden else 0) | (0 if editable or hidden else _READ_ONLY))


def put(obj: Any, kind: str, name: str, group: str, text: str, value: Any, hidden: bool = False) -> None:
    """Adds a property and sets it."""
    add(obj, kind, name, group, text, hidden)
    setattr(obj, name, value)


def finish(obj: Any) -> None:
    """Shows an object whose properties are complete."""
    if App.GuiUp:
        from .. import views

        views.attach(obj)
        obj.ViewObject.Proxy.rebuild()
