# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compares two files and writes the result as JSON.

    freecadcmd examples/compare_two_files.py original=A.step suspect=B.igs output=result.json -M WORKBENCH

or, with WORKBENCH (the folder that holds the package umbilic) in PYTHONPATH, the same with /usr/bin/python3 and without
-M. The names may also stand in the environment: UMBILIC_ORIGINAL, UMBILIC_SUSPECT, UMBILIC_OUTPUT. `report=FOLDER` also
writes the report. The exit status is 0 if the result was written, whatever it says, and 1 otherwise.
"""

import json
import os
import sys
import traceback


def parameters():
    """Words `name=value` of the command line; what is missing is looked for in the environment."""
    words = dict(word.split("=", 1) for word in sys.argv[1:] if "=" in word and not word.startswith("-"))
    names = ("original", "suspect", "output", "report")
    found = {name: words.get(name) or os.environ.get(f"UMBILIC_{name.upper()}") for name in names}
    missing = [name for name in names[:3] if not found[name]]
    if missing:
        raise SystemExit(f"missing: {', '.join(missing)}; give them as name=value")
    return found


def main():
    import umbilic

    given = parameters()
    result = umbilic.compare(given["original"], given["suspect"])
    unfinished = given["output"] + ".part"
    with open(unfinished, "w", encoding="utf-8") as file:
        json.dump(result.to_dict(), file, indent=2)
    os.replace(unfinished, given["output"])
    if given["report"]:
        umbilic.report(result, given["report"])
    print(result.answer.text)


# freecadcmd imports a script as a module (so nothing is __main__), runs one that raises a second time, and returns 0
# all the same: hence the call here, and the end by os._exit.
status = 1
try:
    main()
    status = 0
except SystemExit as stop:
    print(stop, file=sys.stderr)
except BaseException:
    traceback.print_exc()
sys.stdout.flush()
sys.stderr.flush()
os._exit(status)
