# SPDX-License-Identifier: LGPL-2.1-or-later
"""The suspect on the original, coloured by distance, with a legend."""

from typing import Any

import numpy as np
from pivy import coin

from ..objects.deviation import stored
from .colors import EDGE, ORIGINAL, PLAIN_SUSPECT, deviation_colors
from .image_node import image_node, in_corner
from .legend import deviation_legend, text_legend
from .view_provider import StoredView, colored, unpickable


# Offset in steps of a depth buffer of 24 bits: 0.4 % of the depth of what is shown. Both models are drawn with chords
# up to 0.2 % of the diagonal inside their surfaces; so where they coincide the suspect's colour is in front.
_BEHIND_CHORDS = 0.004 * 2**24


class DeviationView(StoredView):
    """Coloured triangles of the suspect, the original around it as glass, and the legend."""

    icon = "Umbilic_Deviation.svg"
    redrawn_by = ("ColorBy", "ShowOriginal", "ShowLegend")

    def add_view_properties(self, vobj: Any) -> None:
        if "ColorBy" not in vobj.PropertiesList:
            vobj.addProperty("App::PropertyEnumeration", "ColorBy", "Deviation", "Distance, or with its sign")
            vobj.ColorBy = ["Size", "Sign"]
            vobj.addProperty("App::PropertyBool", "ShowOriginal", "Deviation", "Show the original as glass")
            vobj.ShowOriginal = True
            vobj.addProperty("App::PropertyBool", "ShowLegend", "Deviation", "Show the legend")
            vobj.ShowLegend = True

    def rebuild(self) -> None:
        obj, vobj = self.Object, self.Object.ViewObject
        self.root.removeAllChildren()
        if not hasattr(obj, "Tolerance"):
            return  # not all properties are there yet
        self.root.addChild(unpickable())
        for direction in ((-1, -1, -1), (1, 1, 0.5)):
            # Beside the light at the eye, so that colours stay bright where the surface turns away.
            light = coin.SoDirectionalLight()
            light.direction = direction
            light.intensity = 0.45
            self.root.addChild(light)
        signed = vobj.ColorBy == "Sign"
        colors = np.array([PLAIN_SUSPECT], dtype=np.float32)
        deviation = np.asarray(obj.Deviation, dtype=float)
        if obj.Posed and deviation.size:
            colors = deviation_colors(deviation, float(obj.Range), signed)
        self.root.addChild(_mesh(obj.SuspectPoints, obj.SuspectTriangles, obj.SuspectEdges, colors, 0.0, 1.0))
        if vobj.ShowOriginal or not obj.Posed:
            grey = np.array([ORIGINAL], dtype=np.float32)
            self.root.addChild(_mesh(obj.OriginalPoints, obj.OriginalTriangles, obj.OriginalEdges, grey,
                                     0.75 if obj.Posed else 0.0, _BEHIND_CHORDS if obj.Posed else 1.0))
        if vobj.ShowLegend:
            if obj.Posed:
                image = deviation_legend(float(obj.Range), float(obj.Largest), float(obj.Tolerance), signed)
            else:
                image = text_legend(["No pose was found", "grey: original", "ochre: suspect, brought to its size"])
            self.root.addChild(in_corner(image_node(image, coin.SoImage.LEFT, coin.SoImage.TOP), -0.98, 0.96))


def _mesh(points: Any, triangles: Any, edges: Any, colors: np.ndarray, transparency: float, back: float) -> coin.SoNode:
    """Lit triangles with the borders of their faces. One colour, or one a point."""
    mesh = coin.SoSeparator()
    hints = coin.SoShapeHints()
    hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE  # with an unknown shape type: lit from both sides
    hints.creaseAngle = 0.7
    coordinates = coin.SoCoordinate3()
    places = stored(points, 3)
    coordinates.point.setValues(0, len(places), places)
    mesh.addChild(hints)
    mesh.addChild(coordinates)

    faces = coin.SoSeparator()
    offset = coin.SoPolygonOffset()
    offset.factor = 1.0  # borders are drawn in front of their faces
    offset.units = back
    material = coin.SoMaterial()
    material.diffuseColor.setValues(0, len(colors), colors)
    material.specularColor = (0.08, 0.08, 0.08)
    material.ambientColor = (0.25, 0.25, 0.25)
    material.transparency = transparency
    binding = coin.SoMaterialBinding()
    per_point = len(colors) > 1 and len(colors) == len(places)
    binding.value = coin.SoMaterialBinding.PER_VERTEX_INDEXED if per_point else coin.SoMaterialBinding.OVERALL
    corners = stored(triangles, 3, np.int32)
    if len(corners):
        surface = coin.SoIndexedFaceSet()
        _set_indices(surface.coordIndex, corners)
    else:  # a cloud of points
        if per_point:
            binding.value = coin.SoMaterialBinding.PER_VERTEX
        dots, plain = coin.SoDrawStyle(), coin.SoLightModel()
        dots.pointSize = 3
        plain.model = coin.SoLightModel.BASE_COLOR
        faces.addChild(dots)
        faces.addChild(plain)
        surface = coin.SoPointSet()
        surface.numPoints = len(places)
    for node in (offset, material, binding, surface):
        faces.addChild(node)
    mesh.addChild(faces)

    lines = coin.SoSeparator()
    light = coin.SoLightModel()
    light.model = coin.SoLightModel.BASE_COLOR
    style = coin.SoDrawStyle()
    style.lineWidth = 1
    borders = coin.SoIndexedLineSet()
    _set_indices(borders.coordIndex, stored(edges, 2, np.int32))
    for node in (light, colored(EDGE), style, borders):
        lines.addChild(node)
    mesh.addChild(lines)
    return mesh


def _set_indices(field: Any, rows: np.ndarray) -> None:
    """Polygons or lines by their rows of indices, each ended by -1."""
    ended = np.hstack([rows, np.full((len(rows), 1), -1, dtype=np.int32)]).astype(np.int32).ravel()
    field.setNum(0)
    field.setValues(0, len(ended), ended)
