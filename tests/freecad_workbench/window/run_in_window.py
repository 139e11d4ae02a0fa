# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a script inside FreeCAD's window on a virtual display, with settings of its own, and passes on its exit status.

    run_in_window.py SCRIPT WORKBENCH_FOLDER OUTPUT_FOLDER
"""

import os
import shutil
import subprocess
import sys
import tempfile

SECONDS = 500


def main() -> int:
    script, workbench, output = sys.argv[1:]
    shutil.rmtree(output, ignore_errors=True)
    os.makedirs(output)
    settings = os.path.join(os.path.dirname(os.path.abspath(__file__)), "user.cfg")
    with tempfile.TemporaryDirectory(prefix="umbilic-home-") as home:
        shutil.copy(settings, os.path.join(home, "user.cfg"))  # FreeCAD writes to it
        command = ["xvfb-run", "-a", "-s", "-screen 0 1600x1100x24", "freecad", "-u", os.path.join(home, "user.cfg"),
                   "-M", workbench, script]
        environment = {**os.environ, "FREECAD_USER_HOME": home, "UMBILIC_OUTPUT": output, "LIBGL_ALWAYS_SOFTWARE": "1"}
        log_path = os.path.join(output, "freecad.log")
        with open(log_path, "w") as log:
            status = subprocess.run(["timeout", "--kill-after=10", str(SECONDS), *command], env=environment,
                                    stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT).returncode
    with open(log_path) as log:
        sys.stdout.write(log.read())
    # FreeCAD may end with 0 without having run the script to its end.
    return status or (0 if os.path.exists(os.path.join(output, "passed")) else 1)


sys.exit(main())
