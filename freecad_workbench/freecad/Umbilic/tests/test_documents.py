# SPDX-License-Identifier: LGPL-2.1-or-later
"""Comparisons as document objects, without a window."""

import json
import os
import tempfile
import unittest

import FreeCAD as App
import Part

import umbilic
from freecad.Umbilic.objects import compare_objects, make_umbilics
from freecad.Umbilic.objects.comparison import CURRENT, make_comparison
from freecad.Umbilic.objects.deviation import stored


def wavy_face() -> "Part.Face":
    """A bicubic face without symmetry, with umbilics."""
    heights = [[0, 3, 1, -2, 0], [2, 9, 4, 1, -1], [1, 6, 12, 7, 2], [-2, 3, 8, 4, 0], [0, -1, 2, 3, -3]]
    surface = Part.BSplineSurface()
    poles = [[App.Vector(12 * i, 10 * j, heights[i][j]) for j in range(5)] for i in range(5)]
    surface.buildFromPolesMultsKnots(poles, [4, 1, 4], [4, 1, 4], [0, 1, 2], [0, 1, 2], False, False, 3, 3)
    return surface.toShape()


def values(obj, names) -> dict:
    """Values of properties, those with a unit as plain numbers."""
    found = {name: getattr(getattr(obj, name), "Value", getattr(obj, name)) for name in names}
    return {name: value if isinstance(value, float) else str(value) for name, value in found.items()}


class DocumentTest(unittest.TestCase):
    def setUp(self):
        self.document = App.newDocument("UmbilicTest")
        self.folder = tempfile.TemporaryDirectory(prefix="umbilic-test-")
        self.original = self.document.addObject("Part::Feature", "Original")
        self.original.Shape = wavy_face()
        self.suspect = self.document.addObject("Part::Feature", "Suspect")
        self.suspect.Shape = wavy_face()
        self.suspect.Placement = App.Placement(App.Vector(5, 6, 7), App.Rotation(App.Vector(1, 1, 0), 50))
        self.document.recompute()

    def tearDown(self):
        App.closeDocument(self.document.Name)
        self.folder.cleanup()

    def reopen(self) -> None:
        path = os.path.join(self.folder.name, "test.FCStd")
        self.document.saveAs(path)
        App.closeDocument(self.document.Name)
        self.document = App.openDocument(path)

    def assert_same(self, found: dict, expected: dict) -> None:
        self.assertEqual(found.keys(), expected.keys())
        for name, value in expected.items():
            if isinstance(value, float):  # FreeCAD writes 16 decimals
                self.assertAlmostEqual(found[name], value, delta=1e-16, msg=name)
            else:
                self.assertEqual(found[name], value, name)

    def test_comparison_has_the_numbers_of_the_result(self):
        result = umbilic.compare(umbilic.ShapeData(self.original.Shape, "Original"),
                                 umbilic.ShapeData(self.suspect.Shape, "Suspect"))
        obj = make_comparison(self.document, result, original=self.original, suspect=self.suspect)
        self.assertEqual(obj.AnswerClass, "moved")
        self.assertEqual(obj.Answer, result.answer.text)
        self.assertEqual(obj.VerdictLevel, result.verdict.level)
        self.assertEqual(obj.DistanceMax.Value, result.tests["weak"]["distance"]["max"])
        self.assertEqual(obj.Scale, result.alignment.scale)
        self.assertEqual(json.loads(obj.Result), result.to_dict())
        back = obj.SuspectPlacement.multiply(self.suspect.Placement)
        self.assertLess(back.Base.Length, 1e-6)

    def test_results_survive_saving_without_being_computed_again(self):
        obj = compare_objects(self.original, self.suspect)
        without_text = ("Proxy", "Pictures", "Original", "Suspect", "Report")
        names = [name for name in obj.PropertiesList if name not in without_text]
        before = values(obj, names)
        result, deviation = obj.Result, list(obj.Pictures[0].Deviation)
        self.reopen()
        obj = self.document.getObject("Comparison")
        self.assert_same(values(obj, names), before)
        self.assertEqual(obj.Result, result)
        self.assertEqual(list(obj.Pictures[0].Deviation), deviation)
        self.assertEqual(obj.Proxy.view_provider, "ComparisonView")
        self.assertEqual(obj.Original.Name, "Original")
        self.document.recompute()
        self.assert_same(values(obj, names), before)

    def test_report_page_is_kept_in_the_document(self):
        result = umbilic.compare(umbilic.ShapeData(self.original.Shape), umbilic.ShapeData(self.suspect.Shape))
        page = umbilic.report(result, os.path.join(self.folder.name, "report"))
        make_comparison(self.document, result, report=page)
        with open(page, "rb") as file:
            contents = file.read()
        self.reopen()
        with open(self.document.getObject("Comparison").Report, "rb") as file:
            self.assertEqual(file.read(), contents)

    def test_state_tells_that_a_model_was_changed(self):
        obj = compare_objects(self.original, self.suspect)
        self.document.recompute()
        self.assertEqual(obj.State, CURRENT)
        changed = wavy_face()
        changed.scale(1.1)
        self.original.Shape = changed
        self.document.recompute()
        self.assertIn("original changed", obj.State)

    def test_placement_of_a_parent_counts(self):
        part = self.document.addObject("App::Part", "Part")
        part.addObject(self.original)
        part.Placement = App.Placement(App.Vector(0, 0, 100), App.Rotation())
        self.document.recompute()
        obj = compare_objects(self.original, self.original)
        points = stored(obj.Pictures[0].OriginalPoints, 3)
        self.assertGreater(points[:, 2].min(), 90.0)

    def test_no_pose_is_shown_side_by_side(self):
        box = self.document.addObject("Part::Box", "Box")
        self.document.recompute()
        obj = compare_objects(self.original, box)
        self.assertEqual(obj.AnswerClass, "different")
        self.assertFalse(obj.Derived)

    def test_object_without_faces_is_an_error_and_leaves_nothing(self):
        line = self.document.addObject("Part::Feature", "Line")
        line.Shape = Part.makeLine((0, 0, 0), (1, 0, 0))
        before = len(self.document.Objects)
        with self.assertRaisesRegex(umbilic.InvalidInput, "Line"):
            compare_objects(self.original, line)
        self.assertEqual(len(self.document.Objects), before)

    def test_umbilics_survive_saving(self):
        result = umbilic.umbilics(umbilic.ShapeData(self.original.Shape, "Wavy"))
        self.assertTrue(result.overlay().types)
        make_umbilics(self.document, result, self.original)
        self.reopen()
        obj = self.document.getObject("Umbilics")
        self.assertEqual(list(obj.Types), result.overlay().types)
        expected = [tuple(row) for row in result.overlay().points.tolist()]
        self.assertEqual([tuple(point) for point in obj.Points], expected)
        self.assertEqual(json.loads(obj.Result), result.to_dict())
