# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands of the workbench. Needs a window."""

import FreeCADGui as Gui

from .compare import CompareCommand
from .curves import GeodesicCommand, LinesOfCurvatureCommand, ProjectCurveCommand
from .domain import DomainCommand
from .report import ReportCommand
from .umbilics import UmbilicsCommand
from .wireframe import WireframeCommand

_COMMANDS = {
    "Umbilic_Compare": CompareCommand,
    "Umbilic_Umbilics": UmbilicsCommand,
    "Umbilic_LinesOfCurvature": LinesOfCurvatureCommand,
    "Umbilic_Geodesic": GeodesicCommand,
    "Umbilic_ProjectCurve": ProjectCurveCommand,
    "Umbilic_Wireframe": WireframeCommand,
    "Umbilic_Domain": DomainCommand,
    "Umbilic_Report": ReportCommand,
}
NAMES = list(_COMMANDS)

for _name, _command in _COMMANDS.items():
    Gui.addCommand(_name, _command())
