# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document objects. All results are kept in properties, so that a saved document shows them without computing again.

The paths of the classes here are written into documents: they never move.
"""

from .comparison import ComparisonProxy, compare_objects, make_comparison
from .curves import CurvesProxy, make_curves
from .deviation import DeviationProxy
from .nodes import NodesProxy, add_node, join, make_nodes
from .umbilics import UmbilicsProxy, make_umbilics
from .wireframe import WireframeProxy, make_wireframe

__all__ = [
    "ComparisonProxy",
    "CurvesProxy",
    "DeviationProxy",
    "NodesProxy",
    "UmbilicsProxy",
    "WireframeProxy",
    "add_node",
    "compare_objects",
    "join",
    "make_comparison",
    "make_curves",
    "make_nodes",
    "make_umbilics",
    "make_wireframe",
]
