# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs at every start of FreeCAD, with or without a window."""

import FreeCAD as App

App.__unit_test__ += ["freecad.Umbilic.tests.test_documents"]
