# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whole pose-free comparison of the bottle pair against FreeCAD's Inspection, which only measures.

Run under FreeCADCmd with the environment variables UMBILIC_COMMAND (the built `umbilic`) and UMBILIC_MODELS (the folder
models/). Inspection gets 10,000 points of the suspect that are already in the original's pose; Umbilic gets the two files and
finds pose, scale and verdict itself. Prints seconds of both and their ratio.
"""
import os
import random
import subprocess
import sys
import time
import traceback

POINTS = 10000


def inspection_seconds(path):
    import FreeCAD
    import Inspection  # noqa: F401  (registers Inspection::Feature)
    import Part
    import Points

    document = FreeCAD.newDocument("inspection")
    shape = Part.Shape()
    shape.read(path)
    nominal = document.addObject("Part::Feature", "nominal")
    nominal.Shape = shape
    random.seed(1)
    points = []
    for i in range(POINTS):
        face = shape.Faces[i % len(shape.Faces)]
        u0, u1, v0, v1 = face.ParameterRange
        points.append(face.valueAt(u0 + (u1 - u0) * random.random(), v0 + (v1 - v0) * random.random()))
    actual = document.addObject("Points::Feature", "actual")
    actual.Points = Points.Points(points)
    feature = document.addObject("Inspection::Feature", "distances")
    feature.Actual = actual
    feature.Nominals = [nominal]
    feature.SearchRadius = 1.0
    start = time.perf_counter()
    document.recompute()
    seconds = time.perf_counter() - start
    assert len(feature.Distances) == POINTS
    return seconds


def comparison_seconds(command, original, suspect):
    start = time.perf_counter()
    subprocess.run([command, "compare", original, suspect, "--quiet", "--json", os.devnull], check=True)
    return time.perf_counter() - start


def main():
    models = os.environ["UMBILIC_MODELS"]
    original = os.path.join(models, "bottle.step")
    suspect = os.path.join(models, "bottle_suspect.igs")
    ours = min(comparison_seconds(os.environ["UMBILIC_COMMAND"], original, suspect) for _ in range(5))
    theirs = inspection_seconds(original)
    print("\nWhole comparison, pose and scale unknown, two files to verdict: %.3f s" % ours)
    print("FreeCAD Inspection, %d distances, pair already aligned:        %.3f s" % (POINTS, theirs))
    print("ratio %.3f" % (ours / theirs))


# FreeCADCmd imports a script and returns 0 whatever it raises.
status = 0
try:
    main()
except BaseException:
    traceback.print_exc()
    status = 1
sys.stdout.flush()
os._exit(status)
