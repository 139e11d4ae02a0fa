# SPDX-License-Identifier: LGPL-2.1-or-later
"""A comparison in words, from the properties of its object: plain answer first, numbers after it."""

from html import escape
from typing import Any

from ..numbers import readable
from ..objects.comparison import CURRENT

_LEVELS = {
    "none": "no test was passed",
    "weak": "the weak test was passed (distances)",
    "intermediate": "the intermediate test was passed (distances and curvatures)",
    "strong": "the strong test was passed (distances, curvatures and umbilical points)",
}


def _number(value: Any, unit: str = "") -> str:
    """A property as text; of one that has a unit, its number."""
    return readable(float(getattr(value, "Value", value)), unit, 4)


def result_html(obj: Any) -> str:
    """Rich text for a label."""
    parts = [f"<p style='font-size:large'><b>{escape(obj.Answer[:1].upper() + obj.Answer[1:])}</b></p>"]
    if obj.State != CURRENT:
        parts.append(f"<p style='color:#b00020'>{escape(obj.State)}.</p>")
    parts.append(f"<p>{escape(obj.Explanation)}</p>")
    parts.append(f"<p>Verdict: <b>{escape(obj.VerdictLevel)}</b> \u2013 {_LEVELS[obj.VerdictLevel]}.</p>")
    rows = []
    if obj.AlignmentStatus != "not found":
        rows += [
            ("Largest distance", _number(obj.DistanceMax, "mm")),
            ("Mean distance", _number(obj.DistanceMean, "mm")),
            ("Tolerance", _number(obj.DistanceTolerance, "mm")),
            ("Suspect on original", f"{100 * obj.SuspectCoverage:.1f} %"),
            ("Original on suspect", f"{100 * obj.OriginalCoverage:.1f} %"),
            ("Scale", _number(obj.Scale) + (", mirrored" if obj.Mirrored else "")),
        ]
    rows += [(f"{name} test", getattr(obj, f"{name}Test")) for name in ("Weak", "Intermediate", "Strong")]
    if obj.UmbilicPairs:
        rows.append(("Coinciding umbilics", str(obj.UmbilicPairs)))
    cells = "".join(f"<tr><td>{escape(name)}\u2002</td><td>{escape(text)}</td></tr>" for name, text in rows)
    return "".join(parts) + f"<table cellspacing='2'>{cells}</table>"
