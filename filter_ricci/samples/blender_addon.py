# SPDX-License-Identifier: GPL-3.0-or-later
"""UV > Unwrap (Ricci flow) in Blender 4.2 and later, in edit mode: the selected faces of all meshes that
are edited, cut at the seams that are marked and, where the map needs it, elsewhere. Angles are kept,
polygons stay. Install it by Edit > Preferences > Add-ons > Install from Disk. It needs the Python package
ricciflow in Blender's own Python; where that is missing, the menu entry says how to get it."""

import sys

import bmesh
import bpy
import numpy

bl_info = {
    "name": "Unwrap (Ricci flow)", "author": "Generalized Ricci Flow", "version": (1, 0, 0),
    "blender": (4, 2, 0), "category": "UV", "location": "UV > Unwrap (Ricci flow)",
    "description": "Conformal unwrap into few charts that do not overlap"}


class Selection:
    """The selected faces of one mesh as triangles. New vertices are counted from `first`."""

    def __init__(self, mesh, matrix, first):
        self.mesh = mesh
        self.bmesh = bmesh.from_edit_mesh(mesh)
        self.layer = self.bmesh.loops.layers.uv.verify()  # first: it makes other references invalid
        self.triangles = [loops for loops in self.bmesh.calc_loop_triangles()
                          if loops[0].face.select and not loops[0].face.hide]
        number = {}
        self.corners = [[first + number.setdefault(loop.vert, len(number)) for loop in loops]
                        for loops in self.triangles]
        self.points = [matrix @ vertex.co for vertex in number]
        self.diagonals = [[loop.link_loop_next is not after for loop, after in self.sides(loops)]
                          for loops in self.triangles]
        self.seams = [[loop.link_loop_next is after and loop.edge.seam
                       for loop, after in self.sides(loops)] for loops in self.triangles]

    @staticmethod
    def sides(loops):
        return zip(loops, (*loops[1:], loops[0]))

    def write(self, uv):
        """Returns the number of polygons that had to be divided, because the map cuts them."""
        polygons = {}
        for loops, points in zip(self.triangles, uv):
            polygons.setdefault(loops[0].face, []).append(
                dict(zip([loop.vert for loop in loops], points.tolist())))
        divided = 0
        for face, triangles in polygons.items():
            cuts = self.cuts(face, triangles)
            divided += bool(cuts)
            pieces = [face]
            for ends in cuts:
                piece = next(p for p in pieces if ends <= set(p.verts))
                pieces.append(bmesh.utils.face_split(piece, *ends)[0])
            for triangle in triangles:
                piece = next(p for p in pieces if triangle.keys() <= set(p.verts))
                for loop in piece.loops:
                    if loop.vert in triangle:
                        loop[self.layer].uv = triangle[loop.vert]
        bmesh.update_edit_mesh(self.mesh, loop_triangles=divided > 0, destructive=divided > 0)
        return divided

    @staticmethod
    def cuts(face, triangles):
        """The diagonals, pairs of vertices, whose two sides the map puts into different places."""
        if len(triangles) == 1:
            return []
        borders, seen, found = {frozenset(edge.verts) for edge in face.edges}, {}, []
        for triangle in triangles:
            for left in triangle:
                ends = frozenset(triangle.keys() - {left})
                places = {end: triangle[end] for end in ends}
                if ends not in borders and seen.setdefault(ends, places) != places:
                    found.append(ends)
        return found


class UnwrapRicciFlow(bpy.types.Operator):
    """Unwrap the selected faces into charts that do not overlap, with little angle distortion"""
    bl_idname = "uv.unwrap_ricci_flow"
    bl_label = "Unwrap (Ricci flow)"
    bl_options = {"REGISTER", "UNDO"}

    padding: bpy.props.IntProperty(
        name="Padding", description="Empty pixels between charts, of a texture of 2048 pixels",
        default=2, min=0, max=512)
    seam_hiding: bpy.props.FloatProperty(
        name="Hide seams", description="How much rather seams that are added run through hollows",
        default=0.0, min=0.0, max=1.0)

    @classmethod
    def poll(cls, context):
        return context.mode == "EDIT_MESH"

    def execute(self, context):
        try:
            import ricciflow
        except ImportError as problem:
            self.report({"ERROR"}, "The Python package ricciflow is not installed in Blender's Python. "
                        f"In a terminal: \"{sys.executable}\" -m pip install ricciflow ({problem})")
            return {"CANCELLED"}
        selections, first = [], 0
        for edited in context.objects_in_mode_unique_data:
            selections.append(Selection(edited.data, edited.matrix_world, first))
            first += len(selections[-1].points)

        def joined(name):
            return numpy.array([row for selection in selections for row in getattr(selection, name)])

        if not first:
            self.report({"WARNING"}, "No faces are selected")
            return {"CANCELLED"}
        seams, manager = joined("seams"), context.window_manager
        manager.progress_begin(0.0, 1.0)
        try:
            result = ricciflow.flatten(
                joined("points"), joined("corners"), diagonals=joined("diagonals"),
                selected_edges=seams if seams.any() else None, padding=self.padding,
                seam_hiding=self.seam_hiding, progress=lambda done, _: manager.progress_update(done))
        except (ricciflow.Refused, ValueError) as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        finally:
            manager.progress_end()
        ends = numpy.cumsum([len(selection.triangles) for selection in selections])
        divided = sum(selection.write(uv) for selection, uv in
                      zip(selections, numpy.split(result.uv, ends[:-1])))
        for message in result.messages:
            self.report({"WARNING"}, message)
        if divided:
            self.report({"WARNING"}, f"Polygons that are divided, because the map cuts them: {divided}")
        self.report({"INFO"}, f"Charts: {result.charts}, mean distortion: {result.qc_area_mean:.4f}")
        return {"FINISHED"}


def entry(menu, _):
    menu.layout.operator(UnwrapRicciFlow.bl_idname)


def register():
    bpy.utils.register_class(UnwrapRicciFlow)
    for menu in (bpy.types.VIEW3D_MT_uv_map, bpy.types.IMAGE_MT_uvs):
        menu.append(entry)


def unregister():
    for menu in (bpy.types.VIEW3D_MT_uv_map, bpy.types.IMAGE_MT_uvs):
        menu.remove(entry)
    bpy.utils.unregister_class(UnwrapRicciFlow)
