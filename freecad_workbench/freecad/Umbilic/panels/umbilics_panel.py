# SPDX-License-Identifier: LGPL-2.1-or-later
"""The panel that finds umbilical points."""

from typing import Any, Callable

import FreeCAD as App

import umbilic

from ..objects import make_umbilics
from .model_choice import ModelChoice
from .work_panel import WorkPanel, selected_objects


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


def summary(result: "umbilic.Umbilics", count: int) -> str:
    """What was found, in rich text."""
    words = {True: "Completeness was proved on every face.", False: "On some face umbilics are missing or undecided.",
             None: "Completeness could not be proved on every face."}
    whole = sum(bool(face["regions"]) for face in result.faces)
    lines = sum(len(face["lines"]) for face in result.faces)
    text = f"<p style='font-size:large'><b>{count} isolated umbilic{'' if count == 1 else 's'}</b></p>"
    if lines:
        text += f"<p>{lines} line{'' if lines == 1 else 's'} of umbilics.</p>"
    if whole:
        text += f"<p>{whole} face{'' if whole == 1 else 's'} with planar or spherical regions, umbilic everywhere.</p>"
    return text + f"<p>{words[result.complete]}</p>"
