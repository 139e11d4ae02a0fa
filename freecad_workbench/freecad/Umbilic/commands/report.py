# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command that writes and opens the report of a comparison."""

import os
import shutil
from typing import Any, Optional

import FreeCAD as App
import FreeCADGui as Gui
from PySide.QtCore import QT_TRANSLATE_NOOP

from ..compat import QtCore, QtGui, QtWidgets


def write_report(obj: Any, folder: str) -> str:
    """Writes report.html and result.json of a stored comparison into a folder and returns the page's path."""
    os.makedirs(folder, exist_ok=True)
    page = os.path.join(folder, "report.html")
    for name, write in (("report.html", lambda path: shutil.copyfile(obj.Report, path)),
                        ("result.json", lambda path: _write_text(path, obj.Result))):
        unfinished = os.path.join(folder, f".{name}.part")
        write(unfinished)
        os.replace(unfinished, os.path.join(folder, name))
    return page


def _write_text(path: str, text: str) -> None:
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def open_report(obj: Any) -> Optional[str]:
    """Writes the report beside the document, or where the user says if that was never saved, and opens it."""
    if obj.Document.FileName:
        folder = f"{os.path.splitext(obj.Document.FileName)[0]}-{obj.Name}-report"
    else:
        chosen = QtWidgets.QFileDialog.getExistingDirectory(Gui.getMainWindow(), "Folder for the report")
        if not chosen:
            return None
        folder = os.path.join(chosen, f"{obj.Name}-report")
    try:
        page = write_report(obj, folder)
    except OSError as error:
        QtWidgets.QMessageBox.warning(Gui.getMainWindow(), "Report", f"{folder}: cannot be written ({error.strerror}).")
        return None
    App.Console.PrintMessage(f"Umbilic: report written to {page}\n")
    QtGui.QDesktopServices.openUrl(QtCore.QUrl.fromLocalFile(page))
    return page


def _selected_comparison() -> Optional[Any]:
    selected = Gui.Selection.getSelection()
    if len(selected) == 1 and getattr(getattr(selected[0], "Proxy", None), "view_provider", "") == "ComparisonView":
        return selected[0]
    return None


class ReportCommand:
    def GetResources(self) -> dict:
        return {
            "Pixmap": "Umbilic_Report",
            "MenuText": QT_TRANSLATE_NOOP("Umbilic_Report", "Open report"),
            "ToolTip": QT_TRANSLATE_NOOP("Umbilic_Report", "Writes and opens the report of the selected comparison"),
        }

    def IsActive(self) -> bool:
        comparison = _selected_comparison()
        return comparison is not None and bool(comparison.Report)

    def Activated(self) -> None:
        open_report(_selected_comparison())
