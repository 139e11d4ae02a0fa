# SPDX-License-Identifier: LGPL-2.1-or-later
"""Umbilical points of a model, to be shown as marks by type."""

import json
from typing import Any, Optional

import FreeCAD as App

import umbilic

from .. import shapes
from .proxy import StoredProxy, finish, put


class UmbilicsProxy(StoredProxy):
    """Places, types and descriptions of umbilical points."""

    view_provider = "UmbilicsView"


def make_marks(document: Any, marks: "umbilic.UmbilicMarks", role: str, title: str) -> Any:
    """Adds marks to a document. `role` ("model", "original" or "suspect") tells how they are drawn."""
    obj = document.addObject("App::FeaturePython", "Umbilics")
    obj.Label = title
    UmbilicsProxy(obj)
    put(obj, "App::PropertyString", "Role", "Umbilics", "Whose umbilics these are: model, original or suspect", role)
    put(obj, "App::PropertyInteger", "Count", "Umbilics", "Number of isolated umbilics inside the faces",
        len(marks.types))
    points = [App.Vector(*point) for point in marks.points.tolist()]
    put(obj, "App::PropertyVectorList", "Points", "Umbilics", "Places, mm", points)
    put(obj, "App::PropertyStringList", "Types", "Umbilics", "star, monstar, lemon or non-generic", marks.types)
    put(obj, "App::PropertyStringList", "Descriptions", "Umbilics", "Face, parameters and curvature", marks.labels)
    return obj


def make_umbilics(document: Any, result: "umbilic.Umbilics", source: Optional[Any] = None, title: str = "") -> Any:
    """Adds the umbilics of a model to a document, with the whole result as JSON. `source` is the object they are of."""
    obj = make_marks(document, result.overlay(), "model", "Umbilics of " + (title or result.source_name))
    put(obj, "App::PropertyBool", "Complete", "Umbilics", "Whether completeness was proved on every face",
        result.complete is True)
    put(obj, "App::PropertyString", "Result", "Umbilics", "The whole result, JSON", json.dumps(result.to_dict()),
        hidden=True)
    put(obj, "App::PropertyLink", "Source", "Umbilics", "Object whose umbilics these are", source)
    if source is not None:
        put(obj, "App::PropertyString", "SourceFingerprint", "Umbilics", "", shapes.fingerprint(source), hidden=True)
    finish(obj)
    return obj
