# SPDX-License-Identifier: LGPL-2.1-or-later
"""The script in examples/ in plain Python and in FreeCAD's command line, against the command."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import umbilic

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "examples" / "compare_two_files.py"
WORKBENCH = Path(umbilic.__file__).absolute().parents[1]


def run(command, words, **environment):
    return subprocess.run(
        [str(word) for word in [*command, *words]],
        env={**os.environ, "PYTHONPATH": str(WORKBENCH), **environment},
        stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300,
    )


def without_times(result):
    return {key: value for key, value in result.items() if key != "timing"}


def hosts():
    yield pytest.param([sys.executable, SCRIPT], [], id="python")
    freecadcmd = shutil.which("freecadcmd") or shutil.which("FreeCADCmd")
    missing = pytest.mark.skipif(not freecadcmd, reason="FreeCAD's command line is not installed")
    yield pytest.param([freecadcmd, SCRIPT], ["-M", WORKBENCH], id="freecadcmd", marks=missing)


@pytest.mark.parametrize("command, last_words", hosts())
def test_writes_what_compare_gives(command, last_words, models, comparison, tmp_path):
    output = tmp_path / "result.json"
    words = [f"original={models / 'bottle.step'}", f"suspect={models / 'bottle_suspect.igs'}", f"output={output}"]
    done = run(command, words + last_words, FREECAD_USER_HOME=str(tmp_path))
    assert done.returncode == 0, done.stdout + done.stderr
    assert without_times(json.loads(output.read_text())) == without_times(comparison.to_dict())


@pytest.mark.parametrize("command, last_words", hosts())
def test_takes_names_from_the_environment_and_fails_with_a_status(command, last_words, models, tmp_path):
    done = run(command, last_words, FREECAD_USER_HOME=str(tmp_path), UMBILIC_ORIGINAL=str(models / "bottle.step"),
               UMBILIC_SUSPECT=str(tmp_path / "missing.step"), UMBILIC_OUTPUT=str(tmp_path / "result.json"))
    assert done.returncode == 1
    assert "missing.step" in done.stderr + done.stdout
    assert not (tmp_path / "result.json").exists()
