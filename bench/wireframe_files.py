# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wireframes of whole files with the usual step: faces, nodes, quadrilaterals, coverage, processor time of the
wireframe, and faces that could not be meshed.

Usage: wireframe_files.py UMBILIC_COMMAND FILES_OR_FOLDERS... Folders are searched for STEP and IGES files, also in
folders below, but not in those named malformed or broken. The time is that of `umbilic wireframe` less that of
`umbilic info`, which reads the same file: on one thread, and the least of three runs.
"""

import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ENDINGS = {".step", ".stp", ".igs", ".iges", ".brep"}
LEFT_OUT = {"malformed", "broken"}
RUNS = 3


def cpu_seconds(words):
    """Processor time of a command and of the processes it starts."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(words, check=True, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def least(words):
    return min(cpu_seconds(words) for _ in range(RUNS))


def measure(command, path, result):
    common = [str(path), "--threads", "1", "--quiet", "--json", str(result)]
    reading = least([command, "info", *common])
    whole = least([command, "wireframe", *common])
    faces = json.loads(result.read_text())["faces"]
    cells = [cell for face in faces for cell in face["cells"]]
    quadrilaterals = sum(len(cell) == 4 for cell in cells)
    coverage = [face["coverage"] for face in faces]
    print(
        f"| {path.name} | {len(faces)} | {sum(len(face['nodes']) for face in faces)} "
        f"| {100 * quadrilaterals / max(len(cells), 1):.0f} % | {100 * min(coverage):.4g} % "
        f"| {1000 * max(whole - reading, 0):.0f} ms |"
    )
    for face in faces:
        if face["why"]:
            print(f"    face {face['face']}: {face['why']}")


def files(places):
    for place in map(Path, places):
        if place.is_dir():
            for path in sorted(place.rglob("*")):
                if path.suffix.lower() in ENDINGS and not LEFT_OUT & set(path.parts):
                    yield path
        elif place.exists():
            yield place


def main():
    command, places = sys.argv[1], sys.argv[2:]
    print("| file | faces | nodes | quadrilaterals | least coverage of a face | time, one thread |")
    print("| --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as scratch:
        for path in files(places):
            measure(command, path, Path(scratch) / "result.json")


if __name__ == "__main__":
    main()
