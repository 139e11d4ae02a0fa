# SPDX-License-Identifier: LGPL-2.1-or-later
"""A person's way with measured points: a scan and a mesh in the document, each compared with a design."""

import os
import sys

import FreeCAD as App
import FreeCADGui as Gui
import Mesh
import numpy as np
import Part
import Points
from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from steps import (MODELS, OUTPUT, child, click, click_command, close_panel, colors_in, finished, panel, run,
                   screenshot, wait)

SCALE = 0.8  # of the scan, against the design
NOISE = 0.05  # mm, of the design


def surface_points(shape, count):
    """Points of a design, uniform in its faces' parameters."""
    random = np.random.default_rng(5)
    points = []
    for face in shape.Faces:
        low_u, high_u, low_v, high_v = face.ParameterRange
        for u, v in random.uniform((low_u, low_v), (high_u, high_v), (int(count * face.Area / shape.Area), 2)):
            points.append(tuple(face.valueAt(u, v)))
    points = np.array(points)
    return points + NOISE * random.standard_normal(points.shape)


def picture(name):
    """The 3D view alone, all in it."""
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    wait(200)
    path = os.path.join(OUTPUT, name + ".png")
    Gui.activeDocument().activeView().saveImage(path, 900, 700, "White")
    return QtGui.QImage(path)


def open_scan():
    Gui.activateWorkbench("UmbilicWorkbench")
    document = App.newDocument("Scan")
    design = document.addObject("Part::Feature", "Design")
    design.Shape = Part.read(os.path.join(MODELS, "bottle.step"))
    placement = App.Placement(App.Vector(150, -40, 30), App.Rotation(App.Vector(1, 2, 3), 70))
    moved = [placement.multVec(App.Vector(*(SCALE * point))) for point in surface_points(design.Shape, 4000)]
    scan = document.addObject("Points::Feature", "Scan")
    scan.Points = Points.Points(moved)
    mesh = document.addObject("Mesh::Feature", "Mesh")
    mesh.Mesh = Mesh.Mesh(design.Shape.tessellate(0.02))
    mesh.Placement = App.Placement(App.Vector(-150, 20, 0), App.Rotation(App.Vector(0, 1, 1), 35))
    document.recompute()
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    return document


def compare(document, suspect, name):
    document.Design.ViewObject.Visibility = True
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Design)
    Gui.Selection.addSelection(document.getObject(suspect))
    click_command("Umbilic_Compare")
    form = panel("UmbilicComparePanel")
    assert child(form, QtGui.QComboBox, "suspect").currentText() == suspect
    screenshot(name + "_panel")
    click(form, "run")
    assert finished(form) == "Done.", finished(form)
    Gui.SendMsgToActiveView("ViewFit")
    screenshot(name + "_result")
    close_panel()
    comparison = document.Objects[-1] if hasattr(document.Objects[-1], "Answer") else next(
        obj for obj in reversed(document.Objects) if hasattr(obj, "Answer"))
    assert colors_in(picture(name + "_picture")) > 300, "the deviation is not shown in colours"
    return comparison


def way(_):
    document = open_scan()
    screenshot("1_document")
    scan = compare(document, "Scan", "2_scan")
    assert scan.AlignmentStatus == "found", scan.AlignmentStatus
    assert abs(scan.Scale * SCALE - 1.0) < 0.02, scan.Scale
    assert scan.StrongTest.startswith("not applicable"), scan.StrongTest
    scan.ViewObject.Visibility = False
    mesh = compare(document, "Mesh", "3_mesh")
    assert mesh.AlignmentStatus == "found", mesh.AlignmentStatus
    assert abs(mesh.Scale - 1.0) < 0.01, mesh.Scale


run(way)
