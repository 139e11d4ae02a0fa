# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run by freecadcmd: compares the two bottles and saves a document."""

import os
import sys
import traceback

status = 1
try:
    import FreeCAD as App

    import umbilic
    from freecad.Umbilic.objects import make_comparison

    models = os.environ["UMBILIC_MODELS_DIR"]
    result = umbilic.compare(os.path.join(models, "bottle.step"), os.path.join(models, "bottle_suspect.igs"))
    document = App.newDocument("Headless")
    make_comparison(document, result)
    document.saveAs(os.environ["UMBILIC_OUTPUT"])
    status = 0
except BaseException:
    traceback.print_exc()
sys.stdout.flush()
sys.stderr.flush()
os._exit(status)
