# SPDX-License-Identifier: LGPL-2.1-or-later
"""The FreeCAD workbench of Umbilic: commands, panels, document objects and their pictures.

`objects` works without a window; `views`, `panels` and `commands` are imported only where there is one. The computing
is done by the package `umbilic`, which knows nothing of FreeCAD's documents.
"""
