# SPDX-License-Identifier: LGPL-2.1-or-later
"""The suspect on the original, coloured by its distance: data for the picture."""

from typing import Any, Optional

import numpy as np

import umbilic

from .proxy import StoredProxy, finish, put


class DeviationProxy(StoredProxy):
    """Triangles of both models in the place of the original, with signed distances of the suspect's points (mm)."""

    view_provider = "DeviationView"


def make_deviation(document: Any, overlay: "umbilic.Overlay", title: Optional[str] = None) -> Any:
    """Adds the picture of a comparison to a document. Numbers are stored in binary, without loss."""
    obj = document.addObject("App::FeaturePython", "Deviation")
    obj.Label = title or "Deviation"
    DeviationProxy(obj)
    for name, mesh in (("Original", overlay.original), ("Suspect", overlay.suspect)):
        text = f"Picture of the {name.lower()}"
        # Lists of floats go into binary side files; lists of integers would be XML text.
        put(obj, "App::PropertyFloatList", f"{name}Points", "Data", text, flat(mesh.points), hidden=True)
        put(obj, "App::PropertyFloatList", f"{name}Triangles", "Data", text, flat(mesh.triangles), hidden=True)
        put(obj, "App::PropertyFloatList", f"{name}Edges", "Data", text, flat(mesh.edges), hidden=True)
    put(obj, "App::PropertyFloatList", "Deviation", "Data", "Signed distance of each point of the suspect to the "
        "original, mm", flat(overlay.suspect.deviation), hidden=True)
    put(obj, "App::PropertyBool", "Posed", "Deviation", "Whether a pose was found; if not, the models stand apart",
        overlay.posed)
    put(obj, "App::PropertyLength", "Range", "Deviation", "Deviation at the end of the colour scale", overlay.range)
    put(obj, "App::PropertyLength", "Largest", "Deviation", "Largest deviation shown", overlay.largest)
    put(obj, "App::PropertyLength", "Tolerance", "Deviation", "Tolerance of the weak test", overlay.tolerance)
    finish(obj)
    return obj


def flat(array: np.ndarray) -> list:
    """Numbers row by row, as a property takes them."""
    return np.asarray(array, dtype=float).ravel().tolist()


def stored(values: Any, columns: int, kind: type = np.float32) -> np.ndarray:
    """Array of shape (n, columns) from such a property; empty if it is not completely restored."""
    array = np.asarray(values, dtype=float)
    if columns == 0 or array.size % columns:
        return np.empty((0, columns), dtype=kind)
    return array.reshape(-1, columns).astype(kind)
