# SPDX-License-Identifier: LGPL-2.1-or-later
"""Umbilic tells whether a CAD model, or a piece of it, is a copy of another one.

    import umbilic
    result = umbilic.compare("bottle.step", "suspect.igs")
    print(result.answer.text)

Models are paths (STEP, IGES, BREP), FreeCAD shapes (`Part.Shape`) or models read before (`umbilic.read`); measured points
are paths (xyz, csv, ply, stl, obj), arrays (n, 3), or `Mesh.Mesh` and `Points.Points` of FreeCAD. Lengths are
millimetres, angles radians, curvatures 1/mm with the sign kappa = -II/I. Long calls release the GIL and take
`progress=callable(fraction, text)`; they stop with `umbilic.Cancelled` when it returns False. The package needs neither
FreeCAD nor a window.
"""

try:
    from . import _native
except ImportError as error:
    raise ImportError(
        f"The compiled part of Umbilic cannot be loaded ({error}). Build it for this Python with ./dev build, "
        "or install it with ./dev install."
    ) from error

from ._native import Cancelled, Error, InvalidInput, NumericFailure, Unsupported
from .comparisons import Alignment, Answer, Comparison, Match, Mesh, Overlay, Verdict, compare, match, report
from .curves import Curve, Curves, geodesic, line_of_curvature, project
from .fits import Fit, fit
from .models import Model, Points, ShapeData, info, points, read
from .umbilical_points import UmbilicMarks, Umbilics, certificate_words, type_words, umbilics
from .wireframes import Wireframe, wireframe

__all__ = [
    "Alignment",
    "Answer",
    "Cancelled",
    "Comparison",
    "Curve",
    "Curves",
    "Error",
    "Fit",
    "InvalidInput",
    "Match",
    "Mesh",
    "Model",
    "NumericFailure",
    "Overlay",
    "Points",
    "ShapeData",
    "UmbilicMarks",
    "Umbilics",
    "Unsupported",
    "Verdict",
    "Wireframe",
    "certificate_words",
    "compare",
    "fit",
    "geodesic",
    "info",
    "line_of_curvature",
    "match",
    "points",
    "project",
    "read",
    "report",
    "type_words",
    "umbilics",
    "wireframe",
]
