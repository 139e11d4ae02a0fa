# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a person does in the window: click, wait, look. Shared by the scripts of this folder."""

import os
import sys
import time
import traceback

import FreeCADGui as Gui
from PySide import QtCore, QtGui
from PySide2.QtTest import QTest

OUTPUT = os.environ["UMBILIC_OUTPUT"]
MODELS = os.environ["UMBILIC_MODELS_DIR"]


def wait(milliseconds):
    loop = QtCore.QEventLoop()
    QtCore.QTimer.singleShot(milliseconds, loop.quit)
    loop.exec_()


def until(condition, what, seconds=240):
    start = time.time()
    while not condition():
        wait(20)
        if time.time() - start > seconds:
            raise AssertionError(f"waited {seconds} s for: {what}")


def screenshot(name):
    wait(600)
    QtGui.QApplication.primaryScreen().grabWindow(0).save(os.path.join(OUTPUT, name + ".png"))


def click_command(name):
    """Clicks the command's button in the toolbar."""
    window = Gui.getMainWindow()
    for bar in window.findChildren(QtGui.QToolBar):
        for action in bar.actions():
            if action.objectName() == name or action.data() == name:
                until(action.isEnabled, f"{name} to be enabled", 10)
                QTest.mouseClick(bar.widgetForAction(action), QtCore.Qt.LeftButton)
                return
    raise AssertionError(f"no button for {name}")


def shown(condition):
    """Visible widgets for which the condition holds.

    Not by the main window's findChild: it makes what it finds a child of the window's Python object, which keeps the
    wrappers of closed panels for ever; new widgets that get the address of a dead one are then reported as deleted.
    """
    return [widget for widget in QtGui.QApplication.allWidgets() if widget.isVisible() and condition(widget)]


def panel(name):
    until(lambda: shown(lambda widget: widget.objectName() == name), f"panel {name}", 10)
    return shown(lambda widget: widget.objectName() == name)[0]


def child(form, kind, name):
    found = form.findChild(kind, name)
    assert found is not None, f"{name} is not in the panel"
    return found


def click(form, name, kind=QtGui.QPushButton):
    QTest.mouseClick(child(form, kind, name), QtCore.Qt.LeftButton)


def close_panel():
    box = shown(lambda widget: isinstance(widget, QtGui.QDialogButtonBox))[0]
    QTest.mouseClick(box.button(QtGui.QDialogButtonBox.Close), QtCore.Qt.LeftButton)
    until(lambda: not Gui.Control.activeDialog(), "the panel to close", 10)


def finished(form):
    run = child(form, QtGui.QPushButton, "run")
    until(run.isEnabled, "the work to end")
    return child(form, QtGui.QLabel, "stage").text()


def colors_in(image):
    """Number of pixels that are neither grey nor white."""
    count = 0
    for x in range(0, image.width(), 3):
        for y in range(0, image.height(), 3):
            color = image.pixelColor(x, y)
            count += max(color.red(), color.green(), color.blue()) - min(color.red(), color.green(), color.blue()) > 60
    return count


def run(*actions):
    """Runs a script's actions once the window is up, each with what the one before returned, and ends FreeCAD."""

    def go():
        status = 1
        try:
            value = None
            for action in actions:
                value = action(value)
            open(os.path.join(OUTPUT, "passed"), "w").close()
            status = 0
        except BaseException:
            traceback.print_exc()
            try:
                screenshot("failed")
            except BaseException:
                traceback.print_exc()
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)

    QtCore.QTimer.singleShot(0, go)
