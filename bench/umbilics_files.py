# SPDX-License-Identifier: LGPL-2.1-or-later
"""Umbilics of whole real files on two threads: seconds, what was found, what was left open, what has no certificate.

Usage: umbilics_files.py UMBILIC_COMMAND CAD_FOLDER. Files that are absent are left out.
"""

import collections
import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

FILES = [
    "freeform/ucrm9_wing_metres_flagged_inch.igs",
    "mechanical/nist_mbe_pmi_2.stp",
    "pairs/b777_openvsp.stp",
    "pairs/b777_onshape.step",
    "freeform/nacelle_quintic.stp",
    "freeform/kvlcc2m_tanker_hull.iges",
]


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def measure(command, path, result):
    start, cpu = time.monotonic(), cpu_seconds()
    subprocess.run(
        [command, "umbilics", str(path), "--threads", "2", "--quiet", "--json", str(result)], check=True
    )
    seconds, cpu = time.monotonic() - start, cpu_seconds() - cpu
    faces = json.loads(result.read_text())["faces"]

    def count(key):
        return sum(len(face.get(key) or []) for face in faces)

    without = [face["certificate"] for face in faces if face["certificate"].get("complete") is None]
    false = sum(face["certificate"].get("complete") is False for face in faces)
    print(
        f"{path.name}: {seconds:.2f} s ({cpu:.2f} s of CPU), {len(faces)} faces, {count('umbilics')} umbilics, "
        f"{count('undecided')} undecided, {count('lines')} lines, {count('regions')} regions, "
        f"{len(without)} faces without certificate, {false} incomplete"
    )
    for why, number in collections.Counter(c.get("why") for c in without).most_common():
        print(f"    {number} x {why}")


def main():
    command, folder = sys.argv[1], Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as scratch:
        for name in FILES:
            if (folder / name).exists():
                measure(command, folder / name, Path(scratch) / "result.json")


if __name__ == "__main__":
    main()
