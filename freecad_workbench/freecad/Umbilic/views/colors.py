# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours of deviations and of umbilics: perceptually uniform, and told apart by people who do not see all colours."""

import numpy as np

_VIRIDIS = "440154 482878 3e4989 31688e 26828e 1f9e89 35b779 6ece58 b5de2b fde725"
_BLUE_WHITE_RED = "2166ac 4393c3 92c5de d1e5f0 f7f7f7 fddbc7 f4a582 d6604d b2182b"


def _table(text: str) -> np.ndarray:
    return np.array([[int(word[i : i + 2], 16) / 255.0 for i in (0, 2, 4)] for word in text.split()])


_TABLES = {False: _table(_VIRIDIS), True: _table(_BLUE_WHITE_RED)}

PLAIN_SUSPECT = (0.85, 0.62, 0.33)
"""Of a suspect without deviations."""
ORIGINAL = (0.62, 0.65, 0.70)
EDGE = (0.12, 0.13, 0.15)

UMBILICS = {
    "star": (0.835, 0.369, 0.000),
    "monstar": (0.000, 0.620, 0.451),
    "lemon": (0.000, 0.447, 0.698),
    "non-generic": (0.45, 0.45, 0.45),
}


CURVES = {
    "maximum": (0.835, 0.369, 0.000),
    "minimum": (0.000, 0.447, 0.698),
    "geodesic": (0.000, 0.620, 0.451),
    "projection": (0.800, 0.300, 0.655),
    "boundary": (0.30, 0.32, 0.36),
}


NODE = (0.10, 0.10, 0.12)
"""Of nodes set by hand."""


def deviation_colors(deviation: np.ndarray, end: float, signed: bool) -> np.ndarray:
    """Colours (n, 3): viridis from 0 to `end` for the size, blue-white-red from -end to end with the sign."""
    deviation = np.nan_to_num(np.asarray(deviation, dtype=float), nan=end, posinf=end, neginf=-end)
    fraction = 0.5 + 0.5 * deviation / end if signed else np.abs(deviation) / end
    table = _TABLES[signed]
    place = np.clip(fraction, 0.0, 1.0) * (len(table) - 1)
    steps = np.arange(len(table))
    return np.stack([np.interp(place, steps, table[:, k]) for k in range(3)], axis=1).astype(np.float32)
