# SPDX-License-Identifier: LGPL-2.1-or-later
"""The package gives the numbers of the command."""

import json
import os
import subprocess

import umbilic


def run(*words):
    done = subprocess.run([os.environ["UMBILIC_COMMAND"], *map(str, words), "--json", "-", "--quiet"], check=True,
                          stdout=subprocess.PIPE, timeout=300)
    return json.loads(done.stdout)


def without_times(result):
    return {key: value for key, value in result.items() if key != "timing"}


def test_info(models):
    assert umbilic.info(models / "bracket.step") == run("info", models / "bracket.step")


def test_umbilics(models):
    assert umbilic.umbilics(models / "bottle.step").to_dict() == run("umbilics", models / "bottle.step")


def test_match(models):
    pair = (models / "bottle.step", models / "bottle_cut.step")
    assert without_times(umbilic.match(*pair).to_dict()) == without_times(run("match", *pair))


def test_compare_with_options(models):
    pair = (models / "bottle.step", models / "bottle_mirrored.step")
    expected = run("compare", *pair, "--distance", "0.05", "--algorithm", "1", "--seed", "7")
    found = umbilic.compare(*pair, distance=0.05, algorithm=1, seed=7).to_dict()
    assert without_times(found) == without_times(expected)
