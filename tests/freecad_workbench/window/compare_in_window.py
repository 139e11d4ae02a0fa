# SPDX-License-Identifier: LGPL-2.1-or-later
"""A person's way through the window: open two models, compare them by clicking, read, save, reopen, report, cancel."""

import os
import sys
import time

import FreeCAD as App
import FreeCADGui as Gui
import Part
from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from freecad.Umbilic.panels import compare_panel
from steps import (MODELS, OUTPUT, child, click, click_command, close_panel, colors_in, finished, panel, run,
                   screenshot, wait)


def picture(name):
    """The 3D view alone, from a fixed place."""
    view = Gui.activeDocument().activeView()
    view.setCameraType("Orthographic")
    view.viewIsometric()
    view.setCamera("OrthographicCamera { position 290 -290 390 orientation 0.7429 0.3077 0.5945 1.217 "
                   "nearDistance 1 farDistance 2000 focalDistance 500 height 280 }")
    path = os.path.join(OUTPUT, name + ".png")
    view.saveImage(path, 900, 700, "White")
    return QtGui.QImage(path)


def check_commands_are_there():
    Gui.activateWorkbench("UmbilicWorkbench")
    wait(300)
    assert Gui.activeWorkbench().name() == "UmbilicWorkbench"
    for name in ("Umbilic_Compare", "Umbilic_Umbilics", "Umbilic_Report"):
        assert name in Gui.listCommands(), name


def open_models():
    document = App.newDocument("Bottles")
    for name, file in (("Original", "bottle.step"), ("Suspect", "bottle_suspect.igs")):
        document.addObject("Part::Feature", name).Shape = Part.read(os.path.join(MODELS, file))
    document.recompute()
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    return document


def check_comparison(document):
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Original)
    Gui.Selection.addSelection(document.Suspect)
    click_command("Umbilic_Compare")
    form = panel("UmbilicComparePanel")
    assert child(form, QtGui.QComboBox, "original").currentText() == "Original"
    assert child(form, QtGui.QComboBox, "suspect").currentText() == "Suspect"
    # What is chosen by its place in a list stands there in both places.
    for name, words in (("method", compare_panel._METHODS), ("scale", compare_panel._SCALES),
                        ("scope", compare_panel._SCOPES)):
        assert child(form, QtGui.QComboBox, name).count() == len(words), name
    screenshot("1_panel")
    click(form, "run")
    assert finished(form) == "Done.", finished(form)
    comparison = document.Comparison
    text = child(form, QtGui.QLabel, "answer").text()
    assert comparison.Answer[1:] in text, text
    assert text.index(comparison.Answer[1:]) < text.index(comparison.Explanation[1:10]), "the answer comes first"
    Gui.SendMsgToActiveView("ViewFit")
    screenshot("2_result")
    close_panel()
    assert comparison.AnswerClass == "scaled", comparison.AnswerClass
    assert comparison.VerdictLevel == "strong", comparison.VerdictLevel
    assert comparison.ViewObject.Proxy.claimChildren() == comparison.Pictures
    assert len(comparison.Pictures) == 3
    assert not document.Original.ViewObject.Visibility
    return comparison


def check_saving(document):
    before = picture("3_before_saving")
    assert colors_in(before) > 500, "the deviation is not shown in colours"
    document.saveAs(os.path.join(OUTPUT, "bottles.FCStd"))
    App.closeDocument(document.Name)
    document = App.openDocument(os.path.join(OUTPUT, "bottles.FCStd"))
    wait(300)
    after = picture("4_after_reopening")
    assert before == after, "the picture changed by saving and reopening"
    comparison = document.Comparison
    Gui.activeDocument().getObject(comparison.Name).Proxy.doubleClicked(comparison.ViewObject)
    form = panel("UmbilicResultPanel")
    assert comparison.Answer[1:] in child(form, QtGui.QLabel, "answer").text()
    screenshot("5_reopened")
    close_panel()
    return document


def check_view_options(document):
    deviation = document.Comparison.Pictures[0]
    plain = picture("6_size")
    deviation.ViewObject.ColorBy = "Sign"
    assert picture("7_sign") != plain
    deviation.ViewObject.ColorBy = "Size"
    assert picture("8_size_again") == plain
    document.Comparison.ViewObject.Visibility = False
    assert colors_in(picture("9_hidden")) == 0, "hiding the comparison hides its pictures"
    document.Comparison.ViewObject.Visibility = True


def check_report(document):
    from freecad.Umbilic.commands import report

    opened = []

    class Desktop:  # a browser has no place in a test
        @staticmethod
        def openUrl(url):
            opened.append(url.toLocalFile())

    class Replaced:
        QDesktopServices = Desktop

    real, report.QtGui = report.QtGui, Replaced
    try:
        Gui.Selection.clearSelection()
        Gui.Selection.addSelection(document.Comparison)
        wait(500)
        click_command("Umbilic_Report")
    finally:
        report.QtGui = real
    with open(opened[0], encoding="utf-8") as page:
        assert document.Comparison.Answer in page.read()
    assert os.path.exists(os.path.join(os.path.dirname(opened[0]), "result.json"))


def check_undo(document):
    count = len(document.Objects)
    document.UndoMode = 1
    Gui.Selection.clearSelection()
    click_command("Umbilic_Umbilics")
    form = panel("UmbilicUmbilicsPanel")
    combo = child(form, QtGui.QComboBox, "model")
    combo.setCurrentIndex(combo.findText("Original"))
    click(form, "run")
    assert finished(form) == "Done.", finished(form)
    screenshot("10_umbilics")
    assert "6 isolated umbilics" in child(form, QtGui.QLabel, "answer").text()
    close_panel()
    assert len(document.Objects) == count + 1
    document.undo()
    assert len(document.Objects) == count, "one undo takes back one action"


def check_cancel_and_errors(document):
    count = len(document.Objects)
    Gui.Selection.clearSelection()
    click_command("Umbilic_Compare")
    form = panel("UmbilicComparePanel")
    click(form, "run")
    assert "Original: nothing is chosen" in child(form, QtGui.QLabel, "stage").text()
    real = QtGui.QFileDialog.getOpenFileName
    files = iter(["bottle_reapproximated.step", "bottle_redesigned.igs", "malformed/empty.step"])
    QtGui.QFileDialog.getOpenFileName = lambda *arguments: (os.path.join(MODELS, next(files)), "")
    try:
        click(form, "originalFile", QtGui.QToolButton)
        click(form, "suspectFile", QtGui.QToolButton)
        click(form, "run")
        wait(100)
        start = time.time()
        click(form, "cancel")
        assert finished(form) == "Cancelled.", finished(form)
        print(f"cancelled after {time.time() - start:.2f} s")
        click(form, "suspectFile", QtGui.QToolButton)
        click(form, "run")
        assert "empty.step" in finished(form), finished(form)
        screenshot("11_error")
    finally:
        QtGui.QFileDialog.getOpenFileName = real
    close_panel()
    assert len(document.Objects) == count, "nothing is added by what was cancelled or failed"


def check_document_written_without_a_window():
    """Objects without a view provider get theirs when the file is opened."""
    import subprocess

    path = os.path.join(OUTPUT, "headless.FCStd")
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "write_without_window.py")
    workbench = os.environ["UMBILIC_WORKBENCH_DIR"]
    done = subprocess.run(["freecadcmd", script, "-M", workbench], stdin=subprocess.DEVNULL, timeout=240,
                          env={**os.environ, "UMBILIC_OUTPUT": path}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert os.path.exists(path), done.stdout.decode()
    document = App.openDocument(path)
    wait(300)
    assert colors_in(picture("12_written_without_window")) > 500
    App.closeDocument(document.Name)


def way(_):
    check_commands_are_there()
    document = open_models()
    check_comparison(document)
    document = check_saving(document)
    check_view_options(document)
    check_report(document)
    check_undo(document)
    check_cancel_and_errors(document)
    check_document_written_without_a_window()


run(way)
