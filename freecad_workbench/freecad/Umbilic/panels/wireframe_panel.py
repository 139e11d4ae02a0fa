# SPDX-License-Identifier: LGPL-2.1-or-later
"""The panel that draws the wireframe of a model."""

from typing import Any, Callable

import umbilic

from ..objects import make_wireframe
from .curves_panel import DrawingPanel


class WireframePanel(DrawingPanel):
    """Choose a model and a step."""

    title = "Wireframe"
    shown = ("stepGroup",)

    def work(self, source: Any) -> Callable[[Callable[[float, str], bool]], "umbilic.Wireframe"]:
        step = self.form.step.value() or None
        return lambda progress: umbilic.wireframe(source, step=step, progress=progress)

    def found(self, result: "umbilic.Wireframe") -> bool:
        return bool(len(result.points))

    def make(self, document: Any, result: "umbilic.Wireframe", source: Any, title: str) -> Any:
        return make_wireframe(document, result, source, title)

    def summary(self, result: "umbilic.Wireframe") -> str:
        missing = [face for face in result.faces if face.get("why")]
        text = f"<p><b>{len(result.points)} nodes</b>, {sum(len(face['cells']) for face in result.faces)} cells</p>"
        text += f"<p>Lines at {result.step:.4g} mm; at least {100 * result.coverage:.4g} % of every face within that.</p>"
        for face in missing:
            text += f"<p>Face {face['face']}: {face['why']}.</p>"
        return text
