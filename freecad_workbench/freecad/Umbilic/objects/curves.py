# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves on the faces of a model: lines of curvature, geodesics, projections."""

import json
from typing import Any, Optional

import FreeCAD as App

import umbilic

from .. import shapes
from .proxy import StoredProxy, finish, put

_TITLES = {"lines-of-curvature": "Lines of curvature", "geodesic": "Geodesics", "project": "Projection"}


class CurvesProxy(StoredProxy):
    """Points of one or more curves, one after the other."""

    view_provider = "CurvesView"


def make_curves(document: Any, result: "umbilic.Curves", source: Optional[Any] = None, title: str = "") -> Any:
    """Adds curves to a document, with the whole result as JSON. `source` is the object they lie on."""
    obj = document.addObject("App::FeaturePython", "Curves")
    obj.Label = _TITLES[result.kind] + (" of " + title if title else "")
    CurvesProxy(obj)
    put(obj, "App::PropertyString", "Kind", "Curves", "lines-of-curvature, geodesic or project", result.kind)
    put(obj, "App::PropertyInteger", "Count", "Curves", "Number of curves", len(result))
    put(obj, "App::PropertyStringList", "Families", "Curves", "maximum, minimum, geodesic or projection",
        [curve.family if curve.family and result.kind != "project" else "projection" for curve in result])
    put(obj, "App::PropertyFloatList", "Lengths", "Curves", "Arc lengths, mm", [curve.length for curve in result])
    put(obj, "App::PropertyStringList", "Ends", "Curves", "Why each curve ends", [curve.ended for curve in result])
    points = [App.Vector(*point) for curve in result for point in curve.points.tolist()]
    put(obj, "App::PropertyFloatList", "PointCounts", "Curves", "", [len(curve.points) for curve in result], hidden=True)
    put(obj, "App::PropertyVectorList", "Points", "Curves", "", points, hidden=True)
    put(obj, "App::PropertyString", "Result", "Curves", "The whole result, JSON", json.dumps(result.to_dict()),
        hidden=True)
    put(obj, "App::PropertyLink", "Source", "Curves", "Object on which the curves lie", source)
    if source is not None:
        put(obj, "App::PropertyString", "SourceFingerprint", "Curves", "", shapes.fingerprint(source), hidden=True)
    finish(obj)
    return obj
