# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes on a face and the geodesics that join them, set by hand."""

from typing import Any, List, Optional, Tuple

import FreeCAD as App

import umbilic

from .. import shapes
from .proxy import StoredProxy, finish, put


class NodesProxy(StoredProxy):
    """Nodes and edges of one face."""

    view_provider = "NodesView"


def make_nodes(document: Any, source: Any, face: int) -> Any:
    """Adds an empty set of nodes on a face of an object to a document."""
    obj = document.addObject("App::FeaturePython", "Nodes")
    obj.Label = f"Nodes on face {face} of {source.Label}"
    NodesProxy(obj)
    put(obj, "App::PropertyLink", "Source", "Nodes", "Object on which the nodes lie", source)
    put(obj, "App::PropertyInteger", "Face", "Nodes", "Number of the face", face)
    put(obj, "App::PropertyVectorList", "Parameters", "Nodes", "u and v of every node", [])
    put(obj, "App::PropertyVectorList", "Points", "Nodes", "Places, mm", [])
    put(obj, "App::PropertyFloatList", "Ends", "Nodes", "Two nodes for every edge, from 0", [])
    put(obj, "App::PropertyFloatList", "Lengths", "Nodes", "Lengths of the edges, mm", [])
    put(obj, "App::PropertyFloatList", "PointCounts", "Nodes", "", [], hidden=True)
    put(obj, "App::PropertyVectorList", "EdgePoints", "Nodes", "", [], hidden=True)
    put(obj, "App::PropertyVectorList", "EdgeParameters", "Nodes", "", [], hidden=True)
    finish(obj)
    return obj


def add_node(obj: Any, u: float, v: float) -> int:
    """Adds a node at (u, v) and returns its number. Raises InvalidInput if the face has no such point."""
    face = shapes.global_shape(obj.Source).Faces[obj.Face - 1]
    if not face.isPartOfDomain(u, v):
        raise umbilic.InvalidInput(f"u = {u:.6g}, v = {v:.6g} is outside of face {obj.Face}; choose a point inside")
    obj.Parameters = list(obj.Parameters) + [App.Vector(u, v, 0)]
    obj.Points = list(obj.Points) + [face.valueAt(u, v)]
    return len(obj.Points) - 1


def join(obj: Any, first: int, second: int, model: Optional["umbilic.Model"] = None) -> float:
    """Joins two nodes by the shortest geodesic on their face and returns its length, mm.

    `model` is the source as it was read before, to save reading it again. Raises InvalidInput if the nodes are joined
    already, or no geodesic between them stays on the face.
    """
    if first == second or {first, second} in edges(obj):
        raise umbilic.InvalidInput("choose two nodes that are not joined yet")
    (u0, v0, _), (u1, v1, _) = obj.Parameters[first], obj.Parameters[second]
    source = model if model is not None else shapes.snapshot(obj.Source)
    found = umbilic.geodesic(source, (u0, v0), face=obj.Face, to=(u1, v1), most=1, one_face=True)
    if not len(found):
        raise umbilic.InvalidInput(found.why)
    curve = found[0]
    obj.EdgePoints = list(obj.EdgePoints) + [App.Vector(*point) for point in curve.points.tolist()]
    obj.EdgeParameters = list(obj.EdgeParameters) + [App.Vector(u, v, 0) for u, v in curve.parameters.tolist()]
    obj.PointCounts = list(obj.PointCounts) + [len(curve.points)]
    obj.Lengths = list(obj.Lengths) + [curve.length]
    obj.Ends = list(obj.Ends) + [first, second]
    return curve.length


def edges(obj: Any) -> List[set]:
    """The pair of nodes of every edge."""
    return [{int(a), int(b)} for a, b in zip(obj.Ends[::2], obj.Ends[1::2])]


def polylines(points: Any, counts: Any) -> List[List[Tuple[float, float, float]]]:
    """A list of points cut into the parts with the given numbers of points."""
    result, first = [], 0
    for count in counts:
        result.append([tuple(point) for point in points[first : first + int(count)]])
        first += int(count)
    return result
