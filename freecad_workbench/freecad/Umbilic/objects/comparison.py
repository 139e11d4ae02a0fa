# SPDX-License-Identifier: LGPL-2.1-or-later
"""A comparison: every number of its result as a property, and the pictures that belong to it."""

import json
import math
from typing import Any, Optional

import FreeCAD as App

import umbilic

from .. import shapes
from .deviation import make_deviation
from .proxy import StoredProxy, add, finish, put
from .umbilics import make_marks

CURRENT = "Belongs to the models as they are"


class ComparisonProxy(StoredProxy):
    """Result of comparing a suspect with an original."""

    view_provider = "ComparisonView"

    def execute(self, obj: Any) -> None:
        """Tells in `State` whether the models were changed since."""
        changed = [
            name
            for name in ("Original", "Suspect")
            if getattr(obj, name, None) is not None and (shapes.has_faces(getattr(obj, name)) or shapes.is_measured(getattr(obj, name)))
            and shapes.fingerprint(getattr(obj, name)) != getattr(obj, name + "Fingerprint")
        ]
        state = f"Out of date: {' and '.join(changed).lower()} changed; compare again" if changed else CURRENT
        if obj.State != state:
            obj.State = state


def make_comparison(
    document: Any,
    result: "umbilic.Comparison",
    overlay: Optional["umbilic.Overlay"] = None,
    report: Optional[str] = None,
    original: Optional[Any] = None,
    suspect: Optional[Any] = None,
) -> Any:
    """Adds a result to a document, with its pictures below it.

    `overlay` is computed if it is not given. `report` is a report.html to be kept in the document; `original` and
    `suspect` are the document's objects that were compared, if they are such.
    """
    overlay = overlay or result.overlay()
    data = result.to_dict()
    obj = document.addObject("App::FeaturePython", "Comparison")
    obj.Label = f"Comparison: {result.answer.kind}"
    ComparisonProxy(obj)
    _put_answer(obj, data)
    _put_inputs(obj, data, original, suspect)
    _put_alignment(obj, result.alignment)
    _put_tests(obj, data)
    put(obj, "App::PropertyString", "Result", "Result", "The whole result, JSON", json.dumps(data), hidden=True)
    add(obj, "App::PropertyFileIncluded", "Report", "Result", "The report, one page complete in itself")
    if report is not None:
        obj.Report = report
    add(obj, "App::PropertyLinkListHidden", "Pictures", "Result", "Deviation and umbilics", hidden=True)
    obj.Pictures = [make_deviation(document, overlay)] + [
        make_marks(document, marks, role, f"Umbilics of the {role}")
        for role, marks in (("original", overlay.original_umbilics), ("suspect", overlay.suspect_umbilics))
        if marks.types
    ]
    for picture in obj.Pictures:
        finish(picture)
    finish(obj)
    return obj


def compare_objects(original: Any, suspect: Any, **options: Any) -> Any:
    """Compares two objects of a document and adds the result to it; options as for `umbilic.compare`."""
    result = umbilic.compare(shapes.snapshot(original), shapes.snapshot(suspect), **options)
    return make_comparison(original.Document, result, original=original, suspect=suspect)


def _put_answer(obj: Any, data: dict) -> None:
    answer, verdict = data["answer"], data["verdict"]
    put(obj, "App::PropertyString", "Answer", "Answer", "What was found, in plain words", answer["text"])
    put(obj, "App::PropertyString", "AnswerClass", "Answer", "The same as one word", answer["class"])
    put(obj, "App::PropertyString", "VerdictLevel", "Answer", "Highest test passed", verdict["level"])
    put(obj, "App::PropertyBool", "Derived", "Answer", "Whether any test was passed", verdict["derived"])
    put(obj, "App::PropertyString", "Explanation", "Answer", "The verdict in one sentence", verdict["explanation"])
    put(obj, "App::PropertyString", "State", "Answer", "Whether the models were changed since", CURRENT)


def _put_inputs(obj: Any, data: dict, original: Optional[Any], suspect: Optional[Any]) -> None:
    for name, model in (("Original", original), ("Suspect", suspect)):
        entry = data["inputs"][name.lower()]
        put(obj, "App::PropertyString", f"{name}Name", "Models", "File or object", entry["path"])
        put(obj, "App::PropertyString", f"{name}Checksum", "Models", "SHA-256", entry["sha256"])
        put(obj, "App::PropertyArea", f"{name}Area", "Models", "Area of all faces", entry["area"] or 0.0)
        put(obj, "App::PropertyLink", name, "Models", f"The {name.lower()} in this document", model)
        put(obj, "App::PropertyString", f"{name}Fingerprint", "Models", "",
            "" if model is None else shapes.fingerprint(model), hidden=True)


def _put_alignment(obj: Any, alignment: "umbilic.Alignment") -> None:
    group = "Alignment"
    put(obj, "App::PropertyString", "AlignmentStatus", group, "found, ambiguous, compatible or not found",
        alignment.status)
    put(obj, "App::PropertyString", "AlignmentWhy", group, "What was tried and how it ended", alignment.why)
    put(obj, "App::PropertyString", "Method", group, "Method that found the pose", alignment.method or "")
    put(obj, "App::PropertyString", "Scope", group, "global or partial", alignment.scope or "")
    add(obj, "App::PropertyBool", "Mirrored", group, "The suspect's x is reversed before scale and placement")
    add(obj, "App::PropertyFloat", "Scale", group, "Factor from suspect to original, before the placement")
    add(obj, "App::PropertyPlacement", "SuspectPlacement", group, "Rotation and translation onto the original")
    if alignment.rotation is not None and alignment.translation is not None:
        obj.Mirrored = bool(alignment.mirrored)
        obj.Scale = alignment.scale
        matrix = [list(row) + [shift] for row, shift in zip(alignment.rotation, alignment.translation)]
        obj.SuspectPlacement = App.Placement(App.Matrix(*(float(x) for row in matrix for x in row), 0, 0, 0, 1))
    for name, value, text in (
        ("RootMeanSquare", alignment.rms, "Root mean square distance of what lies on the original"),
        ("Maximum", alignment.max, "Largest distance of what lies on the original"),
    ):
        put(obj, "App::PropertyLength", name, group, text, value or 0.0)
    put(obj, "App::PropertyFloat", "RelativeMaximum", group, "Maximum / sqrt(area of the original)",
        alignment.relative_max or 0.0)


# Property, its kind, factor from the result's unit to FreeCAD's, key of the statistics, what it is.
_QUANTITIES = (
    ("Distance", "App::PropertyLength", 1.0, ("weak", "distance"), "distance"),
    ("KappaMax", "App::PropertyFloat", 1.0, ("intermediate", "kappa_max"), "difference of kappa max, 1/mm"),
    ("KappaMin", "App::PropertyFloat", 1.0, ("intermediate", "kappa_min"), "difference of kappa min, 1/mm"),
    ("Direction", "App::PropertyAngle", 180.0 / math.pi, ("intermediate", "direction"),
     "angle between principal directions"),
)


def _put_tests(obj: Any, data: dict) -> None:
    tests, similarity, coverage = data["tests"], data["similarity"], data["coverage"]
    for name in ("weak", "intermediate", "strong"):
        passed = {True: "passed", False: "not passed", None: "not applicable"}[tests[name]["passed"]]
        put(obj, "App::PropertyString", name.capitalize() + "Test", "Tests", f"The {name} test", passed)
    put(obj, "App::PropertyInteger", "UmbilicPairs", "Tests", "Umbilics that lie on one of the same type",
        len(tests["strong"]["pairs"]))
    for name, kind, factor, (test, key), text in _QUANTITIES:
        statistics = tests[test][key]
        group = "Differences"
        put(obj, "App::PropertyInteger", name + "Count", group, f"Points at which the {text} was measured",
            statistics["count"])
        for word, entry in (("Max", "max"), ("Mean", "mean"), ("Deviation", "std")):
            value = math.nan if statistics[entry] is None else statistics[entry] * factor
            # A length cannot be "not a number": the count says whether there is one.
            put(obj, kind, name + word, group, f"{entry} of the {text}", 0.0 if math.isnan(value) else value)
        local = similarity[key]
        tolerance = (local["tolerance"] or 0.0) * factor
        put(obj, kind, name + "Tolerance", "Tolerances", f"Tolerance of the {text}", tolerance)
        put(obj, "App::PropertyFloat", name + "Percent", "Similarity",
            f"Percent of the area on which the {text} is within tolerance", local["percent"] or 0.0)
    put(obj, "App::PropertyFloat", "SuspectCoverage", "Similarity", "Share of the suspect's area on the original",
        coverage["suspect_area"] or 0.0)
    put(obj, "App::PropertyFloat", "OriginalCoverage", "Similarity", "Share of the original's area on the suspect",
        coverage["original_area"] or 0.0)
