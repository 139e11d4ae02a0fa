# SPDX-License-Identifier: LGPL-2.1-or-later
"""A person's way with curves: lines of curvature, a geodesic, a projection, nodes in the domain window, undo."""

import os
import sys

import FreeCAD as App
import FreeCADGui as Gui
import Part
from PySide import QtCore, QtGui
from PySide2.QtTest import QTest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from steps import MODELS, OUTPUT, child, click, click_command, close_panel, finished, panel, run, screenshot, until, wait


def set_value(form, name, value):
    kind = QtGui.QSpinBox if isinstance(value, int) else QtGui.QDoubleSpinBox
    child(form, kind, name).setValue(value)


def open_model(_):
    Gui.activateWorkbench("UmbilicWorkbench")
    wait(300)
    document = App.newDocument("Curves")
    document.UndoMode = 1
    document.addObject("Part::Feature", "Bottle").Shape = Part.read(os.path.join(MODELS, "bottle.step"))
    document.recompute()
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    return document


def draw(document, command, values, name):
    """Opens the panel, fills it, runs it, and returns the new object."""
    count = len(document.Objects)
    click_command(command)
    form = panel("UmbilicCurvesPanel")
    for field, value in values.items():
        set_value(form, field, value)
    click(form, "run")
    assert finished(form) == "Done.", finished(form)
    screenshot(name)
    close_panel()
    wait(100)
    assert len(document.Objects) == count + 1, "one object is added"
    return document.Objects[-1]


def check_lines(document):
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Bottle, "Face1")
    lines = draw(document, "Umbilic_LinesOfCurvature", {"startFace": 1, "startU": 0.4, "startV": 0.4}, "1_lines")
    assert lines.Families == ["maximum", "minimum"], lines.Families
    assert lines.Source is document.Bottle
    document.undo()
    assert "Curves" not in [obj.Name for obj in document.Objects], "one undo takes back one action"
    return document


def check_geodesic(document):
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Bottle)
    ends = {"startFace": 1, "startU": 0.4, "startV": 0.4, "endFace": 2, "endU": 0.6, "endV": 0.6}
    geodesics = draw(document, "Umbilic_Geodesic", ends, "2_geodesic")
    assert 1 <= geodesics.Count <= 4
    assert list(geodesics.Lengths) == sorted(geodesics.Lengths), "the shortest comes first"
    return document


def check_projection(document):
    line = document.addObject("Part::Feature", "Line")
    face = document.Bottle.Shape.Faces[0]
    ends = [face.valueAt(u, v) + face.normalAt(u, v) * 6 for u, v in ((0.3, 0.3), (0.6, 0.5))]
    line.Shape = Part.makeLine(*ends)
    document.recompute()
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Bottle, "Face1")
    Gui.Selection.addSelection(line, "Edge1")
    projection = draw(document, "Umbilic_ProjectCurve", {"targetFace": 1}, "3_projection")
    assert projection.Families == ["projection"]
    for point in projection.Points:
        distance = face.distToShape(Part.Vertex(point))[0]
        assert distance < 1e-5, distance
    return document


def domain_click(view, u, v):
    place = view.to_pixel(u, v)
    QTest.mouseClick(view, QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, QtCore.QPoint(int(place.x()), int(place.y())))
    wait(50)


def check_domain(document):
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Bottle, "Face1")
    wait(500)
    click_command("Umbilic_Domain")
    window = panel("UmbilicDomainWindow")
    until(window.isVisible, "the domain window", 10)
    wait(200)
    view = window.view
    for u, v in ((0.2, 0.3), (0.8, 0.4), (0.5, 0.8)):
        domain_click(view, u, v)
    nodes = document.getObject("Nodes")
    assert len(nodes.Points) == 3, len(nodes.Points)
    assert abs(nodes.Parameters[1].x - 0.8) < 0.01, nodes.Parameters
    for first, second in ((0, 1), (1, 2)):
        for number in (first, second):
            domain_click(view, *view.nodes[number])
        assert view.chosen == [first, second], view.chosen
        click(window, "joinNodes")
        message = child(window, QtGui.QLabel, "domainMessage").text()
        assert message.startswith("Joined"), message
    assert list(nodes.Ends) == [0, 1, 1, 2], nodes.Ends
    assert len(view.edges) == 2
    screenshot("4_domain")
    click(window, "undoNodes")
    assert len(nodes.PointCounts) == 1, "undo takes back one join"
    assert len(view.edges) == 1
    domain_click(view, *view.nodes[0])
    domain_click(view, *view.nodes[1])
    click(window, "joinNodes")
    assert "not joined yet" in child(window, QtGui.QLabel, "domainMessage").text()
    assert len(nodes.PointCounts) == 1
    return document


def check_wireframe(document):
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Bottle)
    wireframe = draw(document, "Umbilic_Wireframe", {"step": 15.0}, "6_wireframe")
    assert wireframe.NodeCount == len(wireframe.Points) > 50, wireframe.NodeCount
    assert wireframe.CellCount > 0 and wireframe.Step.Value == 15.0
    return document


def check_saving(document):
    path = os.path.join(OUTPUT, "curves.FCStd")
    counts = {obj.Name: len(obj.Points) for obj in document.Objects if hasattr(obj, "PointCounts")}
    document.saveAs(path)
    App.closeDocument(document.Name)
    document = App.openDocument(path)
    wait(300)
    for name, count in counts.items():
        assert len(document.getObject(name).Points) == count, name
    screenshot("5_reopened")


run(open_model, check_lines, check_geodesic, check_projection, check_domain, check_wireframe, check_saving)
