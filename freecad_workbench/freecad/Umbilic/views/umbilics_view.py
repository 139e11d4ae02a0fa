# SPDX-License-Identifier: LGPL-2.1-or-later
"""Umbilical points as marks by type, with a legend."""

from collections import Counter
from typing import Any

from pivy import coin

from .. import preferences
from .colors import UMBILICS
from .image_node import image_node, in_corner
from .legend import umbilics_legend
from .marks import mark_image
from .view_provider import StoredView, unpickable


def _legend_place(obj: Any) -> int:
    """Place from the left: legends of a comparison stand beside each other, that of a single model beside them."""
    if obj.Role != "model":
        return 1 if obj.Role == "suspect" else 0
    others = [other for other in obj.Document.Objects if getattr(other, "Role", "model") != "model"]
    return 2 if any(other.ViewObject.Visibility for other in others) else 0


class UmbilicsView(StoredView):
    """Filled marks for the umbilics of an original or a single model, rings for those of a suspect."""

    icon = "Umbilic_Umbilics.svg"
    redrawn_by = ("GlyphSize", "ShowLegend")

    def add_view_properties(self, vobj: Any) -> None:
        if "GlyphSize" not in vobj.PropertiesList:
            vobj.addProperty("App::PropertyInteger", "GlyphSize", "Umbilics", "Size of the marks, pixels")
            vobj.GlyphSize = preferences.glyph_size()
            vobj.addProperty("App::PropertyBool", "ShowLegend", "Umbilics", "Show the legend")
            vobj.ShowLegend = True

    def rebuild(self) -> None:
        obj, vobj = self.Object, self.Object.ViewObject
        self.root.removeAllChildren()
        if not hasattr(obj, "Descriptions"):
            return  # not all properties are there yet
        self.root.addChild(unpickable())
        filled = obj.Role != "suspect"
        images = {
            kind: image_node(mark_image(kind, filled, vobj.GlyphSize), coin.SoImage.CENTER, coin.SoImage.HALF)
            for kind in set(obj.Types)
        }
        marks = coin.SoAnnotation()  # in front, or the surface would cut the marks in half
        for point, kind in zip(obj.Points, obj.Types):
            place = coin.SoTranslation()
            place.translation = (point.x, point.y, point.z)
            mark = coin.SoSeparator()
            mark.addChild(place)
            mark.addChild(images[kind])
            marks.addChild(mark)
        self.root.addChild(marks)
        if vobj.ShowLegend and obj.Types:
            counts = Counter(obj.Types)
            title = "Umbilics" if obj.Role == "model" else f"Umbilics of the {obj.Role}"
            image = umbilics_legend(title, [(kind, counts[kind]) for kind in UMBILICS if counts[kind]], filled,
                                    _legend_place(obj))
            self.root.addChild(in_corner(image_node(image, coin.SoImage.LEFT, coin.SoImage.BOTTOM), -0.98, -0.96))
