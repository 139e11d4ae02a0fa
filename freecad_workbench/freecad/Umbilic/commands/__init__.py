# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands of the workbench. Needs a window."""

import FreeCADGui as Gui

from .compare import CompareCommand
from .report import ReportCommand
from .umbilics import UmbilicsCommand

NAMES = ["Umbilic_Compare", "Umbilic_Umbilics", "Umbilic_Report"]

for _name, _command in zip(NAMES, (CompareCommand, UmbilicsCommand, ReportCommand)):
    Gui.addCommand(_name, _command())
