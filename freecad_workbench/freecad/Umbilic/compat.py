# SPDX-License-Identifier: LGPL-2.1-or-later
"""What differs between versions of FreeCAD and Qt, told by capability and not by number."""

from PySide import QtCore, QtGui

try:
    from PySide import QtWidgets  # newer FreeCAD
except ImportError:
    QtWidgets = QtGui  # older FreeCAD's alias holds the widgets too

__all__ = ["QtCore", "QtGui", "QtWidgets", "standard_buttons"]


def standard_buttons(*buttons) -> int:
    """Buttons of a task panel as the plain number that FreeCAD asks for."""
    total = 0
    for button in buttons:
        total |= getattr(button, "value", None) or int(button)
    return total
