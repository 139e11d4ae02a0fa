# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parameter domain of a face beside the 3D view: its loops, nodes and edges; nodes are added and joined here."""

from typing import Any, List, Optional, Tuple

import FreeCAD as App
import FreeCADGui as Gui

import umbilic

from .. import shapes
from ..compat import QtCore, QtGui, QtWidgets
from ..objects import add_node, join, make_nodes
from ..objects.nodes import polylines
from ..views.colors import CURVES, NODE

_SAMPLES = 40
"""Points of a trimming curve as it is drawn."""
_MARGIN = 24
_NODE_RADIUS = 5.0
_CATCH = 10.0
"""A click takes the node within so many pixels."""


def loop_polylines(face: Any) -> List[List[Tuple[float, float]]]:
    """The trimming curves of a face in its parameter plane."""
    lines = []
    for wire in face.Wires:
        for edge in wire.Edges:
            on_surface = face.curveOnSurface(edge)
            if on_surface is None:
                continue
            curve, first, last = on_surface
            points = [curve.value(first + (last - first) * i / _SAMPLES) for i in range(_SAMPLES + 1)]
            lines.append([(point.x, point.y) for point in points])
    return lines


class DomainView(QtWidgets.QWidget):
    """Draws the domain, u to the right and v upwards, and tells where it is clicked."""

    clicked = QtCore.Signal(float, float)
    node_clicked = QtCore.Signal(int)

    def __init__(self, parent: Optional[Any] = None):
        super().__init__(parent)
        self.setObjectName("domainView")
        self.setMinimumSize(260, 220)
        self.range = (0.0, 1.0, 0.0, 1.0)
        self.loops: List[List[Tuple[float, float]]] = []
        self.edges: List[List[Tuple[float, float]]] = []
        self.nodes: List[Tuple[float, float]] = []
        self.chosen: List[int] = []

    def to_pixel(self, u: float, v: float) -> Any:
        u0, u1, v0, v1 = self.range
        width, height = self.width() - 2 * _MARGIN, self.height() - 2 * _MARGIN
        return QtCore.QPointF(_MARGIN + width * (u - u0) / (u1 - u0), self.height() - _MARGIN - height * (v - v0) / (v1 - v0))

    def to_parameters(self, x: float, y: float) -> Tuple[float, float]:
        u0, u1, v0, v1 = self.range
        width, height = self.width() - 2 * _MARGIN, self.height() - 2 * _MARGIN
        return u0 + (u1 - u0) * (x - _MARGIN) / width, v0 + (v1 - v0) * (self.height() - _MARGIN - y) / height

    def mousePressEvent(self, event: Any) -> None:
        place = QtCore.QPointF(event.pos())
        for number, node in enumerate(self.nodes):
            offset = self.to_pixel(*node) - place
            if abs(offset.x()) <= _CATCH and abs(offset.y()) <= _CATCH:
                self.node_clicked.emit(number)
                return
        self.clicked.emit(*self.to_parameters(place.x(), place.y()))

    def paintEvent(self, event: Any) -> None:
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.Antialiasing)
        painter.fillRect(self.rect(), QtGui.QColor("white"))
        self._paint_lines(painter, self.loops, QtGui.QPen(QtGui.QColor(90, 95, 105), 1.5))
        self._paint_lines(painter, self.edges, QtGui.QPen(QtGui.QColor.fromRgbF(*CURVES["geodesic"]), 2.0))
        painter.setPen(QtGui.QPen(QtGui.QColor("white"), 1.5))
        for number, node in enumerate(self.nodes):
            color = CURVES["maximum"] if number in self.chosen else NODE
            painter.setBrush(QtGui.QColor.fromRgbF(*color))
            painter.drawEllipse(self.to_pixel(*node), _NODE_RADIUS, _NODE_RADIUS)
        painter.setPen(QtGui.QColor(90, 95, 105))
        u0, u1, v0, v1 = self.range
        for u, v, alignment in ((u0, v0, QtCore.Qt.AlignLeft), (u1, v0, QtCore.Qt.AlignRight)):
            place = self.to_pixel(u, v)
            box = QtCore.QRectF(place.x() - 80 * (u == u1), place.y() + 4, 80, 16)
            painter.drawText(box, alignment, f"u {u:.4g}" if u == u1 else f"{u:.4g}, {v:.4g}")
        painter.drawText(QtCore.QRectF(2, 4, 120, 16), QtCore.Qt.AlignLeft, f"v {v1:.4g}")
        painter.end()

    def _paint_lines(self, painter: Any, lines: List, pen: Any) -> None:
        painter.setBrush(QtCore.Qt.NoBrush)
        painter.setPen(pen)
        for line in lines:
            painter.drawPolyline(QtGui.QPolygonF([self.to_pixel(*point) for point in line]))


class DomainWindow(QtWidgets.QDockWidget):
    """The domain with buttons. Every action is one step that the document can undo."""

    def __init__(self, source: Any, face: int, nodes: Optional[Any]):
        super().__init__(f"Face {face} of {source.Label}", Gui.getMainWindow())
        self.setObjectName("UmbilicDomainWindow")
        self.document_name, self.source_name, self.face = source.Document.Name, source.Name, face
        self.nodes_name = nodes.Name if nodes is not None else ""
        self._model: Optional["umbilic.Model"] = None
        source.Document.UndoMode = 1
        self.view = DomainView()
        shape = shapes.global_shape(source).Faces[face - 1]
        self.view.range = shape.ParameterRange
        self.view.loops = loop_polylines(shape)
        self.view.clicked.connect(self.add)
        self.view.node_clicked.connect(self.choose)
        self.join_button = self._button("Join by geodesic", "joinNodes", self.join)
        self.undo_button = self._button("Undo", "undoNodes", self.undo)
        self.message = QtWidgets.QLabel("Click to add a node; click two nodes to join them.")
        self.message.setObjectName("domainMessage")
        self.message.setWordWrap(True)
        buttons = QtWidgets.QHBoxLayout()
        buttons.addWidget(self.join_button)
        buttons.addWidget(self.undo_button)
        body = QtWidgets.QWidget()
        layout = QtWidgets.QVBoxLayout(body)
        layout.addWidget(self.view, 1)
        layout.addLayout(buttons)
        layout.addWidget(self.message)
        self.setWidget(body)
        self.refresh()

    def _button(self, text: str, name: str, action: Any) -> Any:
        button = QtWidgets.QPushButton(text)
        button.setObjectName(name)
        button.clicked.connect(action)
        return button

    @property
    def document(self) -> Any:
        return App.getDocument(self.document_name)

    @property
    def nodes(self) -> Optional[Any]:
        """The document object, or None before the first node and after that was undone."""
        return self.document.getObject(self.nodes_name) if self.nodes_name else None

    def add(self, u: float, v: float) -> None:
        """Adds a node where the domain was clicked."""

        def action() -> str:
            nodes = self.nodes
            if nodes is None:
                nodes = make_nodes(self.document, self.document.getObject(self.source_name), self.face)
                self.nodes_name = nodes.Name
            return f"Node {add_node(nodes, u, v) + 1}: u = {u:.6g}, v = {v:.6g}"

        self._act("Add node", action)

    def choose(self, number: int) -> None:
        """Chooses a node, or leaves it out again; the last two chosen are joined."""
        chosen = self.view.chosen
        if number in chosen:
            chosen.remove(number)
        else:
            chosen.append(number)
            del chosen[:-2]
        self.refresh()

    def join(self) -> None:
        """Joins the two chosen nodes."""

        def action() -> str:
            if self._model is None:
                self._model = umbilic.read(shapes.snapshot(self.document.getObject(self.source_name)))
            length = join(self.nodes, self.view.chosen[0], self.view.chosen[1], self._model)
            self.view.chosen.clear()
            return f"Joined by a geodesic of {length:.6g} mm"

        self._act("Join nodes", action)

    def undo(self) -> None:
        """Takes back the last action."""
        self.document.undo()
        self.view.chosen.clear()
        self.message.setText("Undone.")
        self.refresh()

    def _act(self, title: str, action: Any) -> None:
        self.document.openTransaction(title)
        try:
            text = action()
        except umbilic.Error as error:
            self.document.abortTransaction()
            text = str(error)
        except Exception:
            self.document.abortTransaction()
            raise
        else:
            self.document.commitTransaction()
        self.message.setText(text[0].upper() + text[1:])
        self.refresh()

    def refresh(self) -> None:
        """Draws what the document holds."""
        nodes = self.nodes
        self.view.nodes = [(point.x, point.y) for point in nodes.Parameters] if nodes is not None else []
        lines = polylines(nodes.EdgeParameters, nodes.PointCounts) if nodes is not None else []
        self.view.edges = [[point[:2] for point in line] for line in lines]
        self.join_button.setEnabled(len(self.view.chosen) == 2)
        self.undo_button.setEnabled(self.document.UndoCount > 0)
        self.view.update()


def open_domain_window(obj: Any, face: int) -> DomainWindow:
    """Opens the window for a face of an object, or for a set of nodes; an open one is closed."""
    window = Gui.getMainWindow()
    for old in window.findChildren(QtWidgets.QDockWidget, "UmbilicDomainWindow"):
        old.setObjectName("")
        old.close()
        old.deleteLater()
    is_nodes = hasattr(obj, "EdgeParameters")
    dock = DomainWindow(obj.Source if is_nodes else obj, face, obj if is_nodes else None)
    window.addDockWidget(QtCore.Qt.RightDockWidgetArea, dock)
    dock.show()
    return dock
