# SPDX-License-Identifier: LGPL-2.1-or-later
"""The panel that shows a stored comparison."""

from typing import Any

import FreeCADGui as Gui

from ..compat import QtCore, QtWidgets, standard_buttons
from .result_text import result_html


class ResultPanel:
    """The answer and the numbers of a comparison, and a way to its report."""

    def __init__(self, obj: Any):
        self.form = QtWidgets.QWidget()
        self.form.setObjectName("UmbilicResultPanel")
        self.form.setWindowTitle(obj.Label)
        layout = QtWidgets.QVBoxLayout(self.form)
        text = QtWidgets.QLabel(result_html(obj))
        text.setObjectName("answer")
        text.setWordWrap(True)
        text.setSizePolicy(QtWidgets.QSizePolicy.Ignored, QtWidgets.QSizePolicy.Preferred)
        text.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        layout.addWidget(text)
        report = QtWidgets.QPushButton("Open report")
        report.setObjectName("report")
        report.setEnabled(bool(obj.Report))
        report.clicked.connect(lambda: self._open_report(obj))
        layout.addWidget(report)
        layout.addStretch()

    def _open_report(self, obj: Any) -> None:
        from ..commands.report import open_report

        open_report(obj)

    def getStandardButtons(self) -> int:
        return standard_buttons(QtWidgets.QDialogButtonBox.Close)

    def reject(self) -> bool:
        Gui.Control.closeDialog()
        return True
