# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs at every start of FreeCAD's window, so it only names the workbench; the rest is loaded when it is opened."""

import os

import FreeCADGui as Gui

_RESOURCES = os.path.join(os.path.dirname(__file__), "resources")


class UmbilicWorkbench(Gui.Workbench):
    """Tells whether a model, or a piece of it, is a copy of another one."""

    MenuText = "Umbilic"
    ToolTip = "Tells whether a model, or a piece of it, is a copy of another one"
    Icon = os.path.join(_RESOURCES, "icons", "Umbilic_Workbench.svg")

    def Initialize(self):
        Gui.addIconPath(os.path.join(_RESOURCES, "icons"))
        try:
            from . import commands
        except ImportError as error:
            import FreeCAD as App

            App.Console.PrintError(f"Umbilic: {error}\n")
            return
        self.appendToolbar("Umbilic", commands.NAMES)
        self.appendMenu("Umbilic", commands.NAMES)

    def GetClassName(self):
        return "Gui::PythonWorkbench"


Gui.addWorkbench(UmbilicWorkbench())
