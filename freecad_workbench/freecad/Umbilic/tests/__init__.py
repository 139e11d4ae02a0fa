# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests that run inside FreeCAD: freecadcmd -t freecad.Umbilic.tests.test_documents -M <workbench folder>."""
