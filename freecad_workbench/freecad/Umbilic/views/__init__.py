# SPDX-License-Identifier: LGPL-2.1-or-later
"""How document objects are shown. Needs a window.

The paths of the classes here are written into documents: they never move.
"""

from typing import Any

from .comparison_view import ComparisonView
from .curves_view import CurvesView
from .deviation_view import DeviationView
from .nodes_view import NodesView
from .umbilics_view import UmbilicsView
from .wireframe_view import WireframeView

_VIEWS = {view.__name__: view for view in (ComparisonView, CurvesView, DeviationView, NodesView, UmbilicsView, WireframeView)}


def attach(obj: Any) -> bool:
    """Gives an object its view provider if it has none, and tells whether it had none."""
    view = _VIEWS[obj.Proxy.view_provider]
    if isinstance(obj.ViewObject.Proxy, view):
        return False
    view(obj.ViewObject)
    return True
