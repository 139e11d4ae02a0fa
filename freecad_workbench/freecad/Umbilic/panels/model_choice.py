# SPDX-License-Identifier: LGPL-2.1-or-later
"""Choosing a model: an object of the document or a file."""

import os
from typing import Any, Optional

import umbilic

from .. import preferences, shapes
from ..compat import QtWidgets
from .work_panel import measured_objects, shown_objects

_CAD_FILES = "CAD files (*.step *.stp *.iges *.igs *.brep *.brp);;All files (*)"
_SHAPE_FILES = ("CAD files, points and meshes (*.step *.stp *.iges *.igs *.brep *.brp *.xyz *.asc *.csv *.ply *.stl *.obj)"
                ";;All files (*)")


class ModelChoice:
    """A list of the document's objects that a file can be added to."""

    def __init__(self, combo: Any, button: Any, chosen: Optional[Any] = None, measured: bool = False):
        """`measured`: meshes and clouds of points can be chosen too."""
        self._combo = combo
        self._files = _SHAPE_FILES if measured else _CAD_FILES
        combo.addItem("Choose an object or a file", None)
        for obj in shown_objects() + (measured_objects() if measured else []):
            combo.addItem(obj.Label, obj)
            if obj is chosen:
                combo.setCurrentIndex(combo.count() - 1)
        button.clicked.connect(self._ask)

    def choose_file(self, path: str) -> None:
        """Adds a file to the list and selects it."""
        self._combo.addItem(os.path.basename(path), path)
        self._combo.setItemData(self._combo.count() - 1, path, 3)  # Qt.ToolTipRole
        self._combo.setCurrentIndex(self._combo.count() - 1)

    def _ask(self) -> None:
        ask = QtWidgets.QFileDialog.getOpenFileName
        path = ask(self._combo, "Choose a model", preferences.last_folder(), self._files)[0]
        if path:
            preferences.set_last_folder(os.path.dirname(path))
            self.choose_file(path)

    @property
    def document_object(self) -> Optional[Any]:
        """The chosen object, or None if a file or nothing is chosen."""
        chosen = self._combo.currentData()
        return None if chosen is None or isinstance(chosen, str) else chosen

    def source(self, what: str) -> "umbilic.ShapeData | umbilic.Points | str":
        """What `umbilic.read` takes: a path, or a snapshot that a thread may read. Raises InvalidInput if empty."""
        chosen = self._combo.currentData()
        if chosen is None:
            raise umbilic.InvalidInput(f"{what}: nothing is chosen; choose an object or a file")
        return chosen if isinstance(chosen, str) else shapes.snapshot(chosen)
