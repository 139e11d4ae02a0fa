# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import os
from pathlib import Path

import pytest

import umbilic

MODELS = Path(os.environ["UMBILIC_MODELS_DIR"])


@pytest.fixture(scope="session")
def models():
    return MODELS


@pytest.fixture(scope="session")
def ground_truth():
    return json.loads((MODELS / "ground_truth.json").read_text())


@pytest.fixture(scope="session")
def bottle():
    return umbilic.read(MODELS / "bottle.step")


@pytest.fixture(scope="session")
def comparison(bottle):
    return umbilic.compare(bottle, MODELS / "bottle_suspect.igs")
