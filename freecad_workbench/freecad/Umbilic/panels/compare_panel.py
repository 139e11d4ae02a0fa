# SPDX-License-Identifier: LGPL-2.1-or-later
"""The panel that compares two models."""

import math
import os
import tempfile
from typing import Any, Callable

import FreeCAD as App

import umbilic
from umbilic.models import part_of

from ..objects import make_comparison
from .model_choice import ModelChoice
from .result_text import result_html
from .work_panel import WorkPanel, selected_objects

# In the order of the entries in compare.ui.
_METHODS = ("auto", "analytic", "umbilics", "umbilics-lines", "umbilics-kh", "moments", "curvature", "kh")
_SCALES = ("auto", "fixed")
_SCOPES = ("auto", "global", "partial")


class ComparePanel(WorkPanel):
    """Choose an original and a suspect, compare, read the answer."""

    ui_file = "compare.ui"

    def __init__(self):
        super().__init__()
        chosen = selected_objects(measured=True) + [None, None]
        self.original = ModelChoice(self.form.original, self.form.originalFile, chosen[0], measured=True)
        self.suspect = ModelChoice(self.form.suspect, self.form.suspectFile, chosen[1], measured=True)
        self.form.answer.hide()

    def prepare(self) -> Callable[[Callable[[float, str], bool]], Any]:
        original, suspect = self.original.source("Original"), self.suspect.source("Suspect")
        options = self._options()

        def work(progress: Callable[[float, str], bool]) -> Any:
            result = umbilic.compare(original, suspect, progress=part_of(progress, 0.0, 0.9), **options)
            overlay = result.overlay(part_of(progress, 0.9, 0.95))
            with tempfile.TemporaryDirectory(prefix="umbilic-") as folder:
                path = umbilic.report(result, folder, progress=part_of(progress, 0.95, 1.0))
                with open(path, "rb") as page:
                    return result, overlay, page.read()

        return work

    def show(self, result: Any) -> None:
        comparison, overlay, page = result
        originals = [self.original.document_object, self.suspect.document_object]
        document = App.ActiveDocument or App.newDocument("Comparison")
        document.openTransaction("Compare models")
        try:
            with tempfile.TemporaryDirectory(prefix="umbilic-") as folder:
                path = os.path.join(folder, "report.html")
                with open(path, "wb") as report:
                    report.write(page)
                obj = make_comparison(document, comparison, overlay, path, *originals)
            for shown in originals:
                if shown is not None:
                    shown.ViewObject.Visibility = False  # it would hide the coloured surface at the same place
        except Exception:
            document.abortTransaction()
            raise
        document.commitTransaction()
        document.recompute()
        self.form.answer.setText(result_html(obj))
        self.form.answer.show()

    def _options(self) -> dict:
        form = self.form
        options = {
            "method": _METHODS[form.method.currentIndex()],
            "scale": _SCALES[form.scale.currentIndex()],
            "scope": _SCOPES[form.scope.currentIndex()],
            "mirror": "auto" if form.mirror.isChecked() else "never",
        }
        # 0 reads "automatic" in the panel: the tolerance is derived from the models.
        for name, field, factor in (
            ("distance", form.distance, 1.0),
            ("kappa", form.kappa, 1.0),
            ("direction", form.direction, math.pi / 180.0),
        ):
            if field.value() > 0.0:
                options[name] = field.value() * factor
        return options
