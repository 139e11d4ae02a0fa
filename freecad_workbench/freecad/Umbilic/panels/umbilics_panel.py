# SPDX-License-Identifier: LGPL-2.1-or-later
"""The panel that finds umbilical points."""

from collections import Counter
from html import escape
from typing import Any, Callable, List

import FreeCAD as App

import umbilic

from ..objects import make_umbilics
from .model_choice import ModelChoice
from .work_panel import WorkPanel, selected_objects


TYPES = ("star", "monstar", "lemon", "non-generic")


class UmbilicsPanel(WorkPanel):
    """Choose a model, find its umbilics."""

    ui_file = "umbilics.ui"

    def __init__(self):
        super().__init__()
        chosen = selected_objects() + [None]
        self.model = ModelChoice(self.form.model, self.form.modelFile, chosen[0])
        self.form.answer.hide()

    def prepare(self) -> Callable[[Callable[[float, str], bool]], Any]:
        source = self.model.source("Model")
        return lambda progress: umbilic.umbilics(source, progress=progress)

    def show(self, result: "umbilic.Umbilics") -> None:
        source = self.model.document_object
        document = App.ActiveDocument or App.newDocument("Umbilics")
        document.openTransaction("Find umbilics")
        try:
            obj = make_umbilics(document, result, source, source.Label if source is not None else "")
        except Exception:
            document.abortTransaction()
            raise
        document.commitTransaction()
        document.recompute()
        self.form.answer.setText(summary(result, obj.Count))
        self.form.answer.show()


MOST_LINES = 8
"""Faces and non-generic umbilics that are named one by one; all are in the object's result."""


def summary(result: "umbilic.Umbilics", count: int) -> str:
    """What was found and how far it is proved, in rich text."""
    words = {True: "Completeness was proved on every face.", False: "On some face umbilics are missing or undecided.",
             None: "Completeness could not be proved on every face."}
    inside = [entry for entry in result.isolated if entry["inside"]]
    whole = sum(bool(face["regions"]) for face in result.faces)
    lines = sum(len(face["lines"]) for face in result.faces)
    text = f"<p style='font-size:large'><b>{count} isolated umbilic{'' if count == 1 else 's'}</b></p>"
    types = Counter(entry["type"] for entry in inside)
    if types:
        text += "<p>" + escape(", ".join(f"{types[kind]} {kind}" for kind in TYPES if types[kind])) + ".</p>"
    text += _list([f"Face {entry['face']}: {umbilic.type_words(entry)}" for entry in inside
                   if entry["type"] == "non-generic"])
    if lines:
        text += f"<p>{lines} line{'' if lines == 1 else 's'} of umbilics.</p>"
    if whole:
        text += f"<p>{whole} face{'' if whole == 1 else 's'} with planar or spherical regions, umbilic everywhere.</p>"
    text += f"<p>{words[result.complete]}</p>"
    return text + _list([f"Face {face['face']}: {umbilic.certificate_words(face)}" for face in result.faces
                         if face["umbilics"] or face["undecided"] or face["lines"]])


def _list(entries: List[str]) -> str:
    """At most MOST_LINES entries as rich text, and how many more there are."""
    shown = "".join(f"<li>{escape(entry)}</li>" for entry in entries[:MOST_LINES])
    more = len(entries) - MOST_LINES
    return (f"<ul>{shown}</ul>" if shown else "") + (f"<p>and {more} more.</p>" if more > 0 else "")
