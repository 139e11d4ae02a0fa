# SPDX-License-Identifier: LGPL-2.1-or-later
"""The shape-intrinsic wireframe of a model."""

import json
from typing import Any, Optional

import FreeCAD as App

import umbilic
from umbilic.wireframes import EDGE_KINDS

from .. import shapes
from .proxy import StoredProxy, finish, put


class WireframeProxy(StoredProxy):
    """Nodes and the edges between them, kind by kind."""

    view_provider = "WireframeView"


def make_wireframe(document: Any, result: "umbilic.Wireframe", source: Optional[Any] = None, title: str = "") -> Any:
    """Adds a wireframe to a document, with the whole result as JSON. `source` is the object it lies on."""
    obj = document.addObject("App::FeaturePython", "Wireframe")
    obj.Label = "Wireframe of " + (title or result.source_name)
    WireframeProxy(obj)
    lines = [(kind, line) for kind in EDGE_KINDS for line in result.lines(kind)]
    put(obj, "App::PropertyLength", "Step", "Wireframe", "Distance of neighbouring lines", result.step)
    put(obj, "App::PropertyInteger", "NodeCount", "Wireframe", "Number of nodes", len(result.points))
    put(obj, "App::PropertyInteger", "CellCount", "Wireframe", "Number of cells",
        sum(len(face["cells"]) for face in result.faces))
    put(obj, "App::PropertyFloat", "Coverage", "Wireframe", "Least share of a face's area within a step of a node",
        result.coverage)
    put(obj, "App::PropertyVectorList", "Points", "Wireframe", "Nodes, mm",
        [App.Vector(*point) for point in result.points.tolist()])
    put(obj, "App::PropertyStringList", "Kinds", "Wireframe", "", [kind for kind, _ in lines], hidden=True)
    put(obj, "App::PropertyFloatList", "PointCounts", "Wireframe", "", [len(line) for _, line in lines], hidden=True)
    put(obj, "App::PropertyVectorList", "EdgePoints", "Wireframe", "",
        [App.Vector(*point) for _, line in lines for point in line.tolist()], hidden=True)
    put(obj, "App::PropertyString", "Result", "Wireframe", "The whole result, JSON", json.dumps(result.to_dict()),
        hidden=True)
    put(obj, "App::PropertyLink", "Source", "Wireframe", "Object on which it lies", source)
    if source is not None:
        put(obj, "App::PropertyString", "SourceFingerprint", "Wireframe", "", shapes.fingerprint(source), hidden=True)
    finish(obj)
    return obj
