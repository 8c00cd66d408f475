# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on for Blender in bpy, which is Blender without a window. Usage: test_blender.py BUILD_DIR
[TEST...], with a Python in which bpy and numpy are installed."""

import os
import sys
import unittest
from unittest import mock

import common

try:
    import bpy  # before bmesh, which it brings
    import bmesh
    import numpy
except ImportError as problem:
    common.skip(f"the add-on for Blender: bash tests/deep.sh blender tries it ({problem})")
sys.path.insert(0, os.path.join(common.BUILD, "python"))
try:
    import ricciflow
except ImportError as problem:
    common.skip(f"the Python package is not built: {problem}")
sys.path.insert(0, os.path.join(common.REPOSITORY, "filter_ricci", "samples"))
sys.dont_write_bytecode = True
import blender_addon


def area(corners):
    return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(corners, [*corners[1:], corners[0]]))


class Unwrap(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        blender_addon.register()
        self.addCleanup(blender_addon.unregister)

    def edit(self, build, seam=lambda edge: False, selected=lambda face: True, shift=0.0):
        """An object that is edited. build(bmesh) makes its faces."""
        mesh = bpy.data.meshes.new("mesh")
        new = bmesh.new()
        build(new)
        bmesh.ops.recalc_face_normals(new, faces=new.faces)
        for edge in new.edges:
            edge.seam = seam(edge)
        for element in (*new.verts, *new.edges):
            element.select = False
        for face in new.faces:
            face.select_set(selected(face))
        new.to_mesh(mesh)
        new.free()
        made = bpy.data.objects.new("object", mesh)
        made.location.x = shift
        bpy.context.collection.objects.link(made)
        made.select_set(True)
        bpy.context.view_layer.objects.active = made
        return made

    @staticmethod
    def unwrap(**options):
        bpy.ops.object.mode_set(mode="EDIT")
        try:
            return bpy.ops.uv.unwrap_ricci_flow(**options)
        finally:
            bpy.ops.object.mode_set(mode="OBJECT")

    @staticmethod
    def polygons(made):
        """Of each polygon its vertices and its texture coordinates."""
        mesh = made.data
        uv = mesh.uv_layers.active.data
        return [([mesh.loops[i].vertex_index for i in polygon.loop_indices],
                 [tuple(uv[i].uv) for i in polygon.loop_indices]) for polygon in mesh.polygons]

    @staticmethod
    def torn(polygons):
        """Pairs of vertices whose edge is at two places of the square."""
        places = {}
        for vertices, corners in polygons:
            for i, vertex in enumerate(vertices):
                after = (i + 1) % len(vertices)
                side = {vertex: corners[i], vertices[after]: corners[after]}
                places.setdefault(frozenset(side), []).append(side)
        return {edge for edge, sides in places.items() if any(side != sides[0] for side in sides)}

    def test_marked_seams(self):
        """A cube cut along a tree of edges that unfolds it is one chart, torn there and nowhere else."""
        def is_seam(edge):
            up, down = [vertex.co.z > 0 for vertex in edge.verts].count(True), edge.verts[0].co
            middle = (edge.verts[0].co + edge.verts[1].co) / 2
            if up == 1:
                return True  # the four upright edges
            return up == 2 and middle.x < 0.9 and down is not None  # the lid hangs on one side

        cube = self.edit(lambda b: bmesh.ops.create_cube(b, size=2.0), seam=is_seam)
        self.assertEqual(self.unwrap(), {"FINISHED"})
        polygons = self.polygons(cube)
        self.assertEqual([len(vertices) for vertices, _ in polygons], [4] * 6)
        marked = {frozenset(edge.vertices) for edge in cube.data.edges if edge.use_seam}
        self.assertEqual(len(marked), 7)
        self.assertEqual(self.torn(polygons), marked)
        # It unfolds: every square stays one, and all are of one size.
        areas = [area(corners) for _, corners in polygons]
        self.assertLess(max(areas) / min(areas), 1.0 + 1e-4)

    def test_selected_faces(self):
        """The faces that are not selected keep what they had."""
        sphere = self.edit(lambda b: bmesh.ops.create_icosphere(b, subdivisions=3, radius=1.0),
                           selected=lambda face: face.calc_center_median().z > 0.2)
        layer = sphere.data.uv_layers.new()
        for corner in layer.data:
            corner.uv = (7.0, 8.0)
        before = [polygon.select for polygon in sphere.data.polygons]
        self.assertTrue(any(before) and not all(before))
        self.unwrap()
        for selected, (_, corners) in zip(before, self.polygons(sphere)):
            self.assertEqual(all(corner == (7.0, 8.0) for corner in corners), not selected)
            if selected:
                self.assertGreater(area(corners), 0.0)
                self.assertTrue(all(0.0 <= x <= 1.0 for corner in corners for x in corner))

    def test_polygons(self):
        """A shallow bowl of quads with a bottom of 32 sides keeps its polygons, whole and not flipped."""
        def bowl(b):
            rings = [[b.verts.new((r * numpy.cos(a), r * numpy.sin(a), 0.2 * r * r))
                      for a in numpy.arange(32) * numpy.pi / 16] for r in (0.4, 0.6, 0.8, 1.0)]
            b.faces.new(rings[0])
            for inner, outer in zip(rings, rings[1:]):
                for i in range(32):
                    j = (i + 1) % 32
                    b.faces.new((inner[i], outer[i], outer[j], inner[j]))

        made = self.edit(bowl)
        self.unwrap()
        polygons = self.polygons(made)
        self.assertEqual(sorted(len(vertices) for vertices, _ in polygons), [4] * 96 + [32])
        signs = {area(corners) > 0.0 for _, corners in polygons}
        self.assertEqual(signs, {True})
        self.assertEqual(self.torn(polygons), set())

    def test_polygon_that_must_be_divided(self):
        """Where the two sides of a diagonal are apart, the polygon becomes two, each with its own."""
        made = self.edit(lambda b: bmesh.ops.create_grid(b, x_segments=1, y_segments=1, size=1.0))
        with mock.patch.object(ricciflow, "flatten") as flatten:
            flatten.return_value = mock.Mock(
                uv=numpy.arange(12.0).reshape(2, 3, 2) / 12.0, messages=[], charts=2, qc_area_mean=1.0)
            self.unwrap()
        self.assertEqual(numpy.array(flatten.call_args.kwargs["diagonals"]).sum(), 2)
        polygons = self.polygons(made)
        self.assertEqual([len(vertices) for vertices, _ in polygons], [3, 3])
        self.assertEqual(sorted(round(12 * x) for _, corners in polygons for c in corners for x in c),
                         list(range(12)))

    def test_several_objects(self):
        """All that are edited share the square."""
        def grid(b):
            bmesh.ops.create_grid(b, x_segments=4, y_segments=4, size=1.0)

        pair = [self.edit(grid), self.edit(grid, shift=5.0)]
        self.unwrap()
        boxes = []
        for made in pair:
            corners = numpy.array([corner for _, each in self.polygons(made) for corner in each])
            boxes.append((corners.min(axis=0), corners.max(axis=0)))
        (low, high), (other_low, other_high) = boxes
        self.assertTrue((high <= other_low).any() or (other_high <= low).any(), boxes)

    def test_progress(self):
        self.edit(lambda b: bmesh.ops.create_monkey(b))
        updates, flatten = [], ricciflow.flatten

        def told(*mesh, progress, **options):
            return flatten(*mesh, progress=lambda done, what: updates.append(done) or progress(done, what),
                           **options)

        with mock.patch.object(ricciflow, "flatten", told):
            self.unwrap()
        self.assertEqual(updates[-1], 1.0)

    def refused(self, pattern):
        with self.assertRaisesRegex(RuntimeError, pattern):
            self.unwrap()

    def test_without_the_package(self):
        cube = self.edit(lambda b: bmesh.ops.create_cube(b, size=2.0))
        with mock.patch.dict(sys.modules, {"ricciflow": None}):
            self.refused(r"not installed in Blender's Python\. In a terminal: .* -m pip install ricciflow")
        self.assertIsNone(cube.data.uv_layers.active)

    def test_refused_mesh(self):
        def line(b):
            b.faces.new([b.verts.new((x, 0.0, 0.0)) for x in (0.0, 1.0, float("nan"))])

        self.edit(line)
        self.refused("vert")

    def test_nothing_selected(self):
        self.edit(lambda b: bmesh.ops.create_cube(b, size=2.0), selected=lambda face: False)
        self.assertEqual(self.unwrap(), {"CANCELLED"})


if __name__ == "__main__":
    common.main()
