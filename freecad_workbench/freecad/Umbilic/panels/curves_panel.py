# SPDX-License-Identifier: LGPL-2.1-or-later
"""The panels that draw on faces: what they share, and single curves."""

from typing import Any, Callable, List

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

import umbilic

from ..objects import make_curves
from .face_point import FacePoint, picked_points, set_middle
from .model_choice import ModelChoice
from .work_panel import WorkPanel, selected_objects

_ENDS = {
    "length": "the length asked for",
    "boundary": "the border",
    "trim": "a trimming loop",
    "umbilic": "an umbilic",
    "closed": "its start: it is closed",
    "evolute": "a centre of curvature",
    "point": "the point given",
}


def summary(result: "umbilic.Curves") -> str:
    """What was found, in rich text."""
    if not len(result):
        return f"<p><b>No curve.</b> {result.why[0].upper() + result.why[1:]}.</p>"
    rows = "".join(
        f"<tr><td>{curve.family or 'projection'}&nbsp;</td><td align='right'>{curve.length:.6g}&nbsp;mm&nbsp;</td>"
        f"<td>ends at {_end(result.kind, curve)}</td></tr>"
        for curve in result)
    return f"<table>{rows}</table>"


def _end(kind: str, curve: "umbilic.Curve") -> str:
    if curve.left_target:
        return "the border of the target"
    if kind == "project" and curve.ended in ("length", "point"):
        return "the end of the curve"
    return _ENDS[curve.ended]


class DrawingPanel(WorkPanel):
    """Choose a model and what shall be drawn on it; each result becomes one object."""

    ui_file = "curves.ui"
    title = ""
    shown = ()
    """Groups of fields this kind of drawing needs."""

    def __init__(self):
        super().__init__()
        form = self.form
        form.setWindowTitle(self.title)
        form.run.setText(self.title)
        for group in (form.startGroup, form.endGroup, form.familyGroup, form.targetGroup, form.stepGroup):
            group.setVisible(group.objectName() in self.shown)
        self.model = ModelChoice(form.model, form.modelFile, (selected_objects() + [None])[0])
        form.answer.hide()

    def work(self, source: Any) -> Callable[[Callable[[float, str], bool]], Any]:
        """What the thread shall do with a model."""
        raise NotImplementedError

    def found(self, result: Any) -> bool:
        """Whether there is anything to draw."""
        raise NotImplementedError

    def make(self, document: Any, result: Any, source: Any, title: str) -> Any:
        """Adds the object."""
        raise NotImplementedError

    def summary(self, result: Any) -> str:
        """What was found, in rich text."""
        raise NotImplementedError

    def prepare(self) -> Callable[[Callable[[float, str], bool]], Any]:
        return self.work(self.model.source("Model"))

    def show(self, result: Any) -> None:
        self.form.answer.setText(self.summary(result))
        self.form.answer.show()
        if not self.found(result):
            return
        source = self.model.document_object
        document = App.ActiveDocument or App.newDocument("Umbilic")
        document.openTransaction(self.title)
        try:
            self.make(document, result, source, source.Label if source is not None else "")
        except Exception:
            document.abortTransaction()
            raise
        document.commitTransaction()
        document.recompute()


class _CurvesPanel(DrawingPanel):
    """A model and what starts a curve."""

    def __init__(self):
        super().__init__()
        form = self.form
        chosen = (selected_objects() + [None])[0]
        self.start = FacePoint(form.startFace, form.startU, form.startV)
        self.end = FacePoint(form.endFace, form.endU, form.endV)
        set_middle(self.start, chosen)
        set_middle(self.end, chosen)
        form.fromSelection.clicked.connect(self.take_selection)
        form.toPoint.toggled.connect(self._end_changed)
        self._end_changed()
        self.take_selection()

    def take_selection(self) -> None:
        """Takes the points that were picked on faces: the first as start, the second as end."""
        for point, picked in zip((self.start, self.end), picked_points()):
            index = self.form.model.findText(picked[0].Label)
            if index > 0:
                self.form.model.setCurrentIndex(index)
            point.set(*picked[1:])

    def _end_changed(self) -> None:
        to_point = self.form.toPoint.isChecked()
        self.form.endPoint.setEnabled(to_point)
        self.form.endDirection.setEnabled(not to_point)

    def found(self, result: "umbilic.Curves") -> bool:
        return bool(len(result))

    def make(self, document: Any, result: "umbilic.Curves", source: Any, title: str) -> Any:
        return make_curves(document, result, source, title)

    def summary(self, result: "umbilic.Curves") -> str:
        return summary(result)


class LinesOfCurvaturePanel(_CurvesPanel):
    """Lines of curvature through a point."""

    title = "Lines of curvature"
    shown = ("startGroup", "familyGroup")

    def work(self, source: Any) -> Callable[[Callable[[float, str], bool]], "umbilic.Curves"]:
        face, start = self.start.face, self.start.parameters
        family = ("both", "maximum", "minimum")[self.form.family.currentIndex()]
        length = self.form.lineLength.value() or None
        return lambda progress: umbilic.line_of_curvature(
            source, start, face=face, family=family, length=length, progress=progress)


class GeodesicPanel(_CurvesPanel):
    """Geodesics between two points, or one by its direction."""

    title = "Geodesic"
    shown = ("startGroup", "endGroup")

    def work(self, source: Any) -> Callable[[Callable[[float, str], bool]], "umbilic.Curves"]:
        form, face, start = self.form, self.start.face, self.start.parameters
        if form.toPoint.isChecked():
            end, end_face, most = self.end.parameters, self.end.face, form.most.value()
            return lambda progress: umbilic.geodesic(
                source, start, face=face, to=end, to_face=end_face, most=most, progress=progress)
        direction = tuple(field.value() for field in (form.directionX, form.directionY, form.directionZ))
        length = form.length.value()
        return lambda progress: umbilic.geodesic(
            source, start, face=face, direction=direction, length=length, progress=progress)


def _edge_points(selected: List[Any]) -> List[np.ndarray]:
    """Points along the selected edges and the curves of selected curve objects."""
    curves = []
    for one in selected:
        obj = one.Object
        if hasattr(obj, "PointCounts"):
            points = np.array([tuple(point) for point in obj.Points])
            ends = np.cumsum([int(count) for count in obj.PointCounts])
            curves += np.split(points, ends[:-1])
            continue
        shape = getattr(obj, "Shape", None)
        if shape is None or shape.isNull():
            continue
        shape = shape.copy()
        shape.Placement = obj.getGlobalPlacement()
        names = [name for name in one.SubElementNames if name.startswith("Edge")]
        edges = [shape.Edges[int(name[len("Edge"):]) - 1] for name in names]
        if not names and not shape.Faces:
            edges = shape.Edges
        for edge in edges:
            points = edge.discretize(Deflection=1e-4 * max(edge.Length, 1e-9))
            curves.append(np.array([tuple(point) for point in points]))
    return curves


class ProjectCurvePanel(_CurvesPanel):
    """Selected edges or curves, projected onto a face."""

    title = "Project curve"
    shown = ("targetGroup",)

    def __init__(self):
        self.curves = _edge_points(Gui.Selection.getSelectionEx())
        super().__init__()
        chosen = selected_objects()
        faces = [picked[1] for picked in picked_points()]
        if faces:
            self.form.targetFace.setValue(faces[0])
        if chosen:
            self.form.model.setCurrentIndex(max(0, self.form.model.findText(chosen[0].Label)))
        count = len(self.curves)
        self.form.curveCount.setText(f"{count} curve{'' if count == 1 else 's'} selected")

    def take_selection(self) -> None:
        """The selection is read once, before the panel covers it."""

    def work(self, source: Any) -> Callable[[Callable[[float, str], bool]], "umbilic.Curves"]:
        if not self.curves:
            raise umbilic.InvalidInput("Curve: nothing is selected; select edges or curves and start again")
        curves, face = self.curves, self.form.targetFace.value()

        def work(progress: Callable[[float, str], bool]) -> "umbilic.Curves":
            model = umbilic.read(source)
            results = [umbilic.project(points, model, onto_face=face, progress=progress) for points in curves]
            data = results[0].to_dict()
            data["curves"] = [entry for result in results for entry in result.to_dict()["curves"]]
            return umbilic.Curves(data)

        return work
