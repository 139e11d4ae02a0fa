# SPDX-License-Identifier: LGPL-2.1-or-later
"""What panels that start long work share: the buttons, the progress, the end."""

import os
from typing import Any, Callable, Optional

import FreeCAD as App
import FreeCADGui as Gui

import umbilic

from .. import shapes
from ..compat import QtWidgets, standard_buttons
from .worker import Worker

_FOLDER = os.path.dirname(__file__)


class WorkPanel:
    """A panel with `run`, `cancel`, `progress` and `stage`. A subclass says what to do in `prepare` and `show`."""

    ui_file = ""

    def __init__(self):
        self.form = Gui.PySideUic.loadUi(os.path.join(_FOLDER, self.ui_file))
        self.worker: Optional[Worker] = None
        self.form.run.clicked.connect(self.run)
        self.form.cancel.clicked.connect(self.stop)
        self._set_working(False)

    def prepare(self) -> Callable[[Callable[[float, str], bool]], Any]:
        """Reads the panel and the document, and returns what the thread shall do. May raise umbilic.Error."""
        raise NotImplementedError

    def show(self, result: Any) -> None:
        """Puts a result into the document and the panel, in the window's thread."""
        raise NotImplementedError

    def run(self) -> None:
        try:
            work = self.prepare()
        except umbilic.Error as error:
            self._say(str(error), is_error=True)
            return
        self.worker = Worker(work)
        self.worker.progressed.connect(self._progressed)
        self.worker.done.connect(self._done)
        self.worker.cancelled.connect(lambda: self._ended("Cancelled."))
        self.worker.failed.connect(lambda text: self._ended(text, is_error=True))
        self._set_working(True)
        self.worker.start()

    def stop(self) -> None:
        if self.worker is not None:
            self.worker.stop()
            self._say("Cancelling …")

    def reject(self) -> bool:
        """Closes the panel; work that runs is stopped first."""
        if self.worker is not None:
            self.worker.stop()
            self.worker.wait()
        Gui.Control.closeDialog()
        return True

    def getStandardButtons(self) -> int:
        return standard_buttons(QtWidgets.QDialogButtonBox.Close)

    def _progressed(self, fraction: float, text: str) -> None:
        self.form.progress.setValue(round(self.form.progress.maximum() * fraction))
        if text and not self.worker._stopped:
            self._say(text[0].upper() + text[1:] + " …")

    def _done(self, result: Any) -> None:
        try:
            self.show(result)
        except Exception as error:
            self._ended(f"The result could not be added to the document: {error}", is_error=True)
            raise
        self._ended("Done.")

    def _ended(self, text: str, is_error: bool = False) -> None:
        self.worker.wait()
        self._set_working(False)
        self._say(text, is_error)

    def _say(self, text: str, is_error: bool = False) -> None:
        self.form.stage.setStyleSheet("color: #b00020;" if is_error else "")
        self.form.stage.setText(text)

    def _set_working(self, working: bool) -> None:
        self.form.run.setEnabled(not working)
        self.form.cancel.setEnabled(working)
        self.form.progress.setVisible(working)
        self.form.inputs.setEnabled(not working)


def shown_objects() -> list:
    """Objects of the active document that have faces, in the order of the tree; those inside bodies are left out."""
    document = App.ActiveDocument
    if document is None:
        return []
    inside = {child.Name for obj in document.Objects if obj.isDerivedFrom("PartDesign::Body") for child in obj.Group}
    return [obj for obj in document.Objects if shapes.has_faces(obj) and obj.Name not in inside]


def measured_objects() -> list:
    """Meshes and clouds of points of the active document, in the order of the tree."""
    document = App.ActiveDocument
    return [] if document is None else [obj for obj in document.Objects if shapes.is_measured(obj)]


def selected_objects(measured: bool = False) -> list:
    """Selected objects that have faces, or are `measured`, in the order of the selection."""
    return [obj for obj in Gui.Selection.getSelection()
            if shapes.has_faces(obj) or (measured and shapes.is_measured(obj))]
