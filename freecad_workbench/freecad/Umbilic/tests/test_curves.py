# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves and nodes as document objects, without a window."""

import json
import math
import os
import tempfile
import unittest

import FreeCAD as App
import Part

import umbilic
from freecad.Umbilic.objects import add_node, join, make_curves, make_nodes


class CurvesTest(unittest.TestCase):
    def setUp(self):
        self.document = App.newDocument("UmbilicCurvesTest")
        self.folder = tempfile.TemporaryDirectory(prefix="umbilic-test-")
        self.cylinder = self.document.addObject("Part::Feature", "Cylinder")
        self.cylinder.Shape = Part.makeCylinder(10, 40)
        self.cylinder.Placement.Base = App.Vector(100, 0, 0)
        self.document.recompute()
        faces = self.cylinder.Shape.Faces
        self.side = 1 + next(i for i, face in enumerate(faces) if isinstance(face.Surface, Part.Cylinder))

    def tearDown(self):
        App.closeDocument(self.document.Name)
        self.folder.cleanup()

    def reopen(self) -> None:
        path = os.path.join(self.folder.name, "test.FCStd")
        self.document.saveAs(path)
        App.closeDocument(self.document.Name)
        self.document = App.openDocument(path)

    def test_curves_survive_saving(self):
        data = umbilic.ShapeData(self.cylinder.Shape, "Cylinder")
        result = umbilic.geodesic(data, (0.5, 5.0), face=self.side, to=(1.5, 20.0), most=2)
        obj = make_curves(self.document, result, self.cylinder)
        # A helix, developed.
        self.assertAlmostEqual(obj.Lengths[0], math.hypot(10.0, 15.0), delta=1e-6)
        points = [tuple(point) for point in obj.Points]
        self.reopen()
        obj = self.document.getObject("Curves")
        self.assertEqual([tuple(point) for point in obj.Points], points)
        self.assertEqual(obj.Count, 2)
        self.assertEqual(json.loads(obj.Result), result.to_dict())
        self.assertEqual(obj.Proxy.view_provider, "CurvesView")

    def test_nodes_are_joined_by_geodesics_in_place(self):
        nodes = make_nodes(self.document, self.cylinder, self.side)
        first, second = add_node(nodes, 0.5, 5.0), add_node(nodes, 1.5, 20.0)
        length = join(nodes, first, second)
        self.assertAlmostEqual(length, math.hypot(10.0, 15.0), delta=1e-6)
        self.assertLess((nodes.Points[0] - nodes.EdgePoints[0]).Length, 1e-9)
        self.assertLess((nodes.Points[1] - nodes.EdgePoints[-1]).Length, 1e-6)
        self.assertGreater(nodes.Points[0].x, 80.0)
        with self.assertRaisesRegex(umbilic.InvalidInput, "not joined"):
            join(nodes, second, first)
        with self.assertRaisesRegex(umbilic.InvalidInput, "outside"):
            add_node(nodes, 0.5, 99.0)
        self.reopen()
        nodes = self.document.getObject("Nodes")
        self.assertEqual(list(nodes.Ends), [0, 1])
        self.assertEqual(nodes.Source.Name, "Cylinder")
